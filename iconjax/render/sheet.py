"""A coloured picture of a segmentation with the ids drawn on it, for people to read."""

from __future__ import annotations

import colorsys

import numpy as np
from jaxtyping import Bool, UInt8
from PIL import Image, ImageDraw, ImageFont
from scipy import ndimage

from iconjax.scene.types import Scene

_GOLDEN = 0.618033988749895


def palette(count: int) -> UInt8[np.ndarray, "n 3"]:
    """`count` colours, neighbours far apart in hue."""
    colours = [
        colorsys.hsv_to_rgb((0.02 + k * _GOLDEN) % 1.0, (0.55, 0.75)[k % 2], (0.95, 0.78)[k // 2 % 2])
        for k in range(count)
    ]
    return np.asarray(np.rint(np.array(colours).reshape(-1, 3) * 255), np.uint8)


def segment_sheet(scene: Scene) -> UInt8[np.ndarray, "H W 3"]:
    """Draw the scene's segments each in its own colour over a faint picture, its id at its thickest place."""
    faint = 255 - (255 - scene.image.astype(np.float32)) * 0.2
    canvas = np.rint(faint).astype(np.uint8)
    colours = palette(len(scene.segments))
    for segment, colour in zip(scene.segments, colours, strict=True):
        canvas[segment.mask] = colour
    picture = Image.fromarray(canvas)
    draw = ImageDraw.Draw(picture)
    font = ImageFont.load_default(size=max(9, scene.size // 28))
    for segment in scene.segments:
        if segment.mask.any():
            draw.text(
                _thickest(segment.mask), str(segment.id), fill="black", font=font, anchor="mm",
                stroke_width=max(1, scene.size // 256), stroke_fill="white",
            )  # fmt: skip
    return np.asarray(picture)


def _thickest(mask: Bool[np.ndarray, "H W"]) -> tuple[float, float]:
    """(x, y) of a pixel that is deepest inside the mask."""
    depth = ndimage.distance_transform_cdt(np.pad(mask, 1), "chessboard")[1:-1, 1:-1]
    row, col = np.unravel_index(int(depth.argmax()), depth.shape)
    return float(col), float(row)
