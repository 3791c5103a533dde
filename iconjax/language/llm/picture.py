"""The coloured segmentation with its labels, as a model is shown it (paper: the "V" of GPT-4V)."""

from __future__ import annotations

import colorsys
import hashlib
import io

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from iconjax.language.llm.exchange import Picture
from iconjax.scene.types import Scene, Segment

SIDE = 768
"""Larger side of the picture, px: small icons are enlarged so that labels are legible."""
Box = tuple[float, float, float, float]
RECIPE = "2"
"""Part of the key: a change of how the picture is drawn makes it another picture."""


def segmentation_picture(scene: Scene) -> Picture:
    """Every segment in a colour of its own on white, its number and label drawn on it."""
    factor = SIDE / scene.size
    size = (round(scene.width * factor), round(scene.height * factor))
    index = scene.position_map() + 1
    colours = np.vstack([[255, 255, 255], [_colour(k) for k in range(len(scene.segments))]]).astype(np.uint8)
    image = Image.fromarray(colours[index]).resize(size, Image.Resampling.NEAREST)
    draw = ImageDraw.Draw(image)
    font = ImageFont.load_default(size=15)
    taken: list[Box] = []
    for segment in sorted(scene.segments, key=lambda s: s.area):
        _label(draw, segment, font, factor, size, taken)
    stream = io.BytesIO()
    image.save(stream, "PNG")
    return Picture(stream.getvalue(), _key(scene, index))


def _key(scene: Scene, index: np.ndarray) -> str:
    digest = hashlib.sha256()
    digest.update(repr((RECIPE, scene.names, index.shape)).encode())
    digest.update(index.astype("<i4").tobytes())
    return digest.hexdigest()


def _colour(k: int) -> tuple[int, int, int]:
    """Hues a golden section apart, so that neighbours in the list differ."""
    r, g, b = colorsys.hsv_to_rgb((0.61 * k) % 1.0, (0.45, 0.7)[k % 2], (0.95, 0.85)[k // 2 % 2])
    return round(255 * r), round(255 * g), round(255 * b)


def _label(
    draw: ImageDraw.ImageDraw,
    segment: Segment,
    font: ImageFont.FreeTypeFont | ImageFont.ImageFont,
    factor: float,
    size: tuple[int, int],
    taken: list[Box],
) -> None:
    """Write the label on its segment, or beside a segment that it would hide, with a line to it."""
    x, y = (factor * v for v in _inner_point(segment))
    left, upper, right, lower = draw.textbbox((0, 0), segment.name, font=font)
    w, h = right - left + 6, lower - upper + 6
    own: Box = tuple(factor * v for v in segment.box)  # type: ignore[assignment]
    roomy = own[2] - own[0] > 1.1 * w and own[3] - own[1] > 2 * h
    around = _places(x, y, w, h, own, roomy)
    places = [p for p in around if min(p) >= 0 and p[2] <= size[0] and p[3] <= size[1]]
    free = [p for p in places if not any(_cross(p, t) for t in taken)]
    spot = next(iter(free or places), (1.0, 1.0, 1.0 + w, 1.0 + h))
    taken.append(spot)
    if not (spot[0] <= x <= spot[2] and spot[1] <= y <= spot[3]):
        taken.append((x - 2, y - 2, x + 2, y + 2))
        end = (min(max(x, spot[0]), spot[2]), min(max(y, spot[1]), spot[3]))
        draw.line(((x, y), end), fill=(0, 0, 0), width=1)
    draw.rectangle(spot, fill=(255, 255, 255), outline=(90, 90, 90))
    draw.text((spot[0] + 3 - left, spot[1] + 3 - upper), segment.name, fill=(0, 0, 0), font=font)


def _places(x: float, y: float, w: float, h: float, own: Box, roomy: bool) -> list[Box]:
    """Where a label of size w x h may stand, best first: on its point if the segment has room, else around its box."""
    inside = [(x - w / 2, y - h / 2 + k * (h + 1)) for k in (0, 1, -1, 2, -2)]
    around = []
    for gap in (4, 4 + h, 4 + 2 * h, 4 + 4 * h, 4 + 7 * h):
        around += [(x - w / 2, own[3] + gap), (x - w / 2, own[1] - gap - h)]
        around += [(own[2] + gap, y - h / 2), (own[0] - gap - w, y - h / 2)]
        around += [(x, own[3] + gap), (x - w, own[3] + gap), (x, own[1] - gap - h), (x - w, own[1] - gap - h)]
    return [(a, b, a + w, b + h) for a, b in (inside + around if roomy else around + inside)]


def _inner_point(segment: Segment) -> tuple[float, float]:
    """The point of the segment that lies deepest in it."""
    from scipy.ndimage import distance_transform_edt

    depth = distance_transform_edt(np.pad(segment.mask, 1))[1:-1, 1:-1]
    row, column = np.unravel_index(int(np.argmax(depth)), depth.shape)
    return float(column) + 0.5, float(row) + 0.5


def _cross(a: Box, b: Box) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]
