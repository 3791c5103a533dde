"""The numbered sheet: every segment tinted, its number on it or led out to the margin, and a list of the names."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Int, UInt8
from PIL import Image, ImageDraw, ImageFont
from scipy import ndimage

from iconjax.render.sheet import palette
from iconjax.scene.types import Scene

SIDE = 880
"""Larger side of the picture on the sheet, in pixels."""
GAP, LIST = 84, 330
"""Width of a margin, and of a column of the list."""
NUMBER, TEXT, ROW = 24, 18, 28
"""Sizes of numbers and names, and the height of a line, in pixels."""
LONGEST = 34
"""Characters of a name that the list shows."""
TINT = 0.62


@dataclass(frozen=True)
class _Place:
    """Where a segment's number points: its deepest visible pixel, and whether the number fits there."""

    id: int
    x: float
    y: float
    fits: bool


def numbered_sheet(scene: Scene) -> UInt8[np.ndarray, "H W 3"]:
    """Draw a scene for a person who is to name its segments; numbers are segment ids."""
    owner = scene.position_map() + 1
    scale = SIDE / scene.size
    width, height = max(1, round(scene.width * scale)), max(1, round(scene.height * scale))
    big = _enlarged(owner, height, width)
    colours = palette(len(scene.segments))
    board = _Board.new(max(height, 12 * ROW), width, len(scene.segments))
    board.picture.paste(Image.fromarray(_tinted(scene, big, colours)), (GAP, GAP))
    places = _places(big, [s.id for s in scene.segments])
    board.number(places, width, height)
    board.list(scene.names, [s.id for s in scene.segments], colours, 2 * GAP + width)
    return np.asarray(board.picture)


def _enlarged(owner: Int[np.ndarray, "H W"], height: int, width: int) -> Int[np.ndarray, "h w"]:
    rows = ((np.arange(height) + 0.5) * owner.shape[0] / height).astype(int)
    cols = ((np.arange(width) + 0.5) * owner.shape[1] / width).astype(int)
    return np.asarray(owner[rows][:, cols])


def _tinted(
    scene: Scene, owner: Int[np.ndarray, "h w"], colours: UInt8[np.ndarray, "n 3"]
) -> UInt8[np.ndarray, "h w 3"]:
    height, width = owner.shape
    picture = np.asarray(Image.fromarray(scene.image).resize((width, height)).convert("L"), np.float32)[..., None]
    tints = np.vstack([np.full((1, 3), 255.0), colours])[owner]
    strength = np.where(owner > 0, TINT, 0.8)[..., None]
    out = tints * strength + picture * (1 - strength)
    out[_edges(owner)] = 40
    return np.asarray(np.rint(out), np.uint8)


def _edges(owner: Int[np.ndarray, "h w"]) -> Bool[np.ndarray, "h w"]:
    edge = np.zeros(owner.shape, dtype=bool)
    edge[:, 1:] |= owner[:, 1:] != owner[:, :-1]
    edge[1:] |= owner[1:] != owner[:-1]
    return edge


def _places(owner: Int[np.ndarray, "h w"], ids: Sequence[int]) -> list[_Place]:
    """A place for every segment that shows."""
    places = []
    for k, window in enumerate(ndimage.find_objects(owner, len(ids)), 1):
        if window is None:
            continue
        depth = ndimage.distance_transform_edt(np.pad(owner[window] == k, 1))[1:-1, 1:-1]
        row, col = np.unravel_index(int(depth.argmax()), depth.shape)
        wide = NUMBER * (0.62 + 0.18 * (len(str(ids[k - 1])) - 1))
        places.append(
            _Place(ids[k - 1], float(window[1].start + col), float(window[0].start + row), float(depth.max()) > wide)
        )
    return places


@dataclass(frozen=True)
class _Board:
    """The sheet while it is drawn."""

    picture: Image.Image
    draw: ImageDraw.ImageDraw

    @classmethod
    def new(cls, height: int, width: int, count: int) -> _Board:
        tall = 2 * GAP + height
        columns = max(1, -(-count * ROW // (tall - 2 * ROW)))
        picture = Image.new("RGB", (2 * GAP + width + columns * LIST, tall), "white")
        return cls(picture, ImageDraw.Draw(picture))

    def number(self, places: Sequence[_Place], width: int, height: int) -> None:
        """Numbers on the segments that have room, the others in the nearer margin with a line to the segment."""
        outside = [p for p in places if not p.fits]
        for side, x in (("left", GAP * 0.45), ("right", GAP * 1.55 + width)):
            there = sorted((p for p in outside if (p.x < width / 2) == (side == "left")), key=lambda p: p.y)
            for place, y in zip(there, _spread([p.y + GAP for p in there], 2 * GAP + height), strict=True):
                start = (x + (NUMBER * 0.8 if side == "left" else -NUMBER * 0.8), y)
                end = (place.x + GAP, place.y + GAP)
                self.draw.line([start, end], fill="white", width=4)
                self.draw.line([start, end], fill="black", width=2)
                self.draw.ellipse([end[0] - 4, end[1] - 4, end[0] + 4, end[1] + 4], fill="black", outline="white")
                self._text(x, y, str(place.id), NUMBER)
        for place in places:
            if place.fits:
                self._text(place.x + GAP, place.y + GAP, str(place.id), NUMBER, halo=3)

    def list(self, names: Sequence[str], ids: Sequence[int], colours: UInt8[np.ndarray, "n 3"], left: int) -> None:
        """The names, each behind its number on its colour."""
        rows = (self.picture.height - 2 * ROW) // ROW
        for k, (number, name) in enumerate(zip(ids, names, strict=True)):
            x, y = left + k // rows * LIST, ROW + k % rows * ROW
            red, green, blue = (int(c) for c in colours[k])
            self.draw.rectangle([x, y + 3, x + 38, y + ROW - 3], fill=(red, green, blue), outline="black")
            self._text(x + 19, y + ROW / 2, str(number), TEXT, halo=2)
            short = name if len(name) <= LONGEST else name[: LONGEST - 1] + "…"
            self._text(x + 48, y + ROW / 2, short, TEXT, anchor="lm")

    def _text(self, x: float, y: float, text: str, size: int, halo: int = 0, anchor: str = "mm") -> None:
        font = ImageFont.load_default(size=size)
        self.draw.text((x, y), text, "black", font, anchor, stroke_width=halo, stroke_fill="white")


def _spread(wanted: Sequence[float], height: float) -> list[float]:
    """Heights near the wanted ones, in their order, a line apart (closer where there is no room)."""
    step = min(ROW, (height - ROW) / max(1, len(wanted)))
    out: list[float] = []
    for y in wanted:
        out.append(max(y, out[-1] + step if out else ROW / 2))
    limit = height - ROW / 2
    for k in range(len(out) - 1, -1, -1):
        out[k] = min(out[k], limit)
        limit = out[k] - step
    return out
