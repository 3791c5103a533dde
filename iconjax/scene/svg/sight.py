"""What each item of an SVG shows: its own picture, hidden parts included, and how much of it is seen."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, UInt8

from iconjax.errors import InputError
from iconjax.scene.svg.draw import Painter, Patch
from iconjax.scene.svg.items import Item

COARSE = 64
"""An item is looked for on a grid of so many cells along the larger side."""
AROUND = 0.5
"""How far beyond the picture, in sides, items are drawn, so that they can be moved in."""
FAINT = 8
"""Of 255: what covers less than this everywhere is not seen."""
MAX_KEPT = 100_000_000
MAX_PICTURES = 120
"""Most pixels of all items' pictures together: so many, and as many as so many full pictures have."""

FAR = 32
STRAY = 0.002
"""Of the pixels may be off by more than `FAR` of 255 when items drawn alone are laid on each other."""


@dataclass(frozen=True, eq=False)
class Sight:
    """An item with its picture.

    Attributes:
        item: the element.
        patch: its picture alone.
        seen: (h, w) share of every pixel of the patch's part within the picture that shows it, 0 to 1.
        peak: its greatest coverage, 0 to 1.
        colour: mean colour, 0..255.
    """

    item: Item
    patch: Patch
    seen: Float[np.ndarray, "h w"]
    peak: float
    colour: Float[np.ndarray, " 3"]


def look(painter: Painter, items: Sequence[Item]) -> list[Sight]:
    """Draw every item alone; those that show nothing are left out.

    Raises:
        InputError: the drawing is too much work.
    """
    found: list[tuple[Item, Patch]] = []
    kept, most = 0, min(MAX_KEPT, MAX_PICTURES * painter.view.raster[0] * painter.view.raster[1])
    for item in items:
        patch = draw_item(painter, item)
        if patch is not None:
            kept += patch.data.shape[0] * patch.data.shape[1]
            found.append((item, patch))
        if kept > most:
            raise InputError(f"{painter.source.what} is too complex to take apart: simplify it or group its elements")
    height, width = painter.view.raster[1], painter.view.raster[0]
    light = np.ones((height, width), np.float32)  # what comes through all that lies above
    out = []
    for item, patch in reversed(found):
        alpha = patch.data[..., 3].astype(np.float32) / 255
        seen = np.zeros_like(alpha)
        here, there = overlap(patch, (height, width))
        seen[here] = alpha[here] * light[there]
        light[there] *= 1 - alpha[here]
        total = float(alpha.sum())
        colour = patch.data[..., :3].sum(axis=(0, 1)) / max(total, 1e-6)
        out.append(Sight(item, patch, seen, float(alpha.max()), np.clip(colour, 0, 255)))
    return out[::-1]


def draw_item(painter: Painter, item: Item) -> Patch | None:
    """The picture of one item alone, cut to what it covers; None where it shows nothing."""
    width, height = painter.view.raster
    cell = max(1, max(width, height) // COARSE)
    pad_x, pad_y = (-(-round(AROUND * side) // cell) * cell for side in (width, height))
    full = (-pad_x, -pad_y, -(-(width + 2 * pad_x) // cell) * cell, -(-(height + 2 * pad_y) // cell) * cell)
    instead = None if item.text is None else {item.node.order: item.text}
    rough = painter.draw(full, [item.node], scale=1 / cell, instead=instead)[..., 3]
    rows, cols = np.flatnonzero(rough.any(axis=1)), np.flatnonzero(rough.any(axis=0))
    if not len(rows):
        return None
    top, bottom = max(rows[0] - 1, 0), min(rows[-1] + 2, rough.shape[0])
    left, right = max(cols[0] - 1, 0), min(cols[-1] + 2, rough.shape[1])
    window = (full[0] + int(left) * cell, full[1] + int(top) * cell, int(right - left) * cell, int(bottom - top) * cell)
    data = painter.draw(window, [item.node], instead=instead)
    if data[..., 3].max() < FAINT:
        return None
    return crop(Patch(data, window[1], window[0]))


def crop(patch: Patch) -> Patch:
    """The patch without its empty margins; it must not be empty."""
    rows = np.flatnonzero(patch.data[..., 3].any(axis=1))
    cols = np.flatnonzero(patch.data[..., 3].any(axis=0))
    inner = patch.data[rows[0] : rows[-1] + 1, cols[0] : cols[-1] + 1]
    return Patch(np.ascontiguousarray(inner), patch.top + int(rows[0]), patch.left + int(cols[0]))


Slices = tuple[slice, slice]


def overlap(patch: Patch, shape: tuple[int, int]) -> tuple[Slices, Slices]:
    """The part of a patch that lies within a picture: where it is in the patch, and where in the picture."""
    h, w = patch.data.shape[:2]
    top, left = max(patch.top, 0), max(patch.left, 0)
    bottom, right = min(patch.top + h, shape[0]), min(patch.left + w, shape[1])
    bottom, right = max(bottom, top), max(right, left)
    return (
        (slice(top - patch.top, bottom - patch.top), slice(left - patch.left, right - patch.left)),
        (slice(top, bottom), slice(left, right)),
    )


def over(canvas: Float[np.ndarray, "H W 4"], patch: Patch) -> None:
    """Paint a patch on a premultiplied canvas (coverage 0..1, colours 0..255)."""
    here, there = overlap(patch, (canvas.shape[0], canvas.shape[1]))
    data = patch.data[here].astype(np.float32)
    data[..., 3] /= 255
    canvas[there] = data + canvas[there] * (1 - data[..., 3:])


def is_faithful(image: UInt8[np.ndarray, "H W 3"], patches: Iterable[Patch]) -> bool:
    """Whether patches painted in order on white give the picture, but for some stray pixels."""
    canvas = np.full((*image.shape[:2], 4), 255.0, np.float32)
    canvas[..., 3] = 1.0
    for patch in patches:
        over(canvas, patch)
    off = np.abs(canvas[..., :3] - image).max(axis=-1) > FAR
    return bool(np.count_nonzero(off) <= STRAY * off.size)


def solid(patch: Patch, shape: tuple[int, int], peak: float = 1.0, pad: int = 0) -> Bool[np.ndarray, "H W"]:
    """(H + 2 pad, W + 2 pad) where a patch covers at least half of what it covers at most."""
    out = np.zeros((shape[0] + 2 * pad, shape[1] + 2 * pad), bool)
    here, there = overlap(Patch(patch.data, patch.top + pad, patch.left + pad), (out.shape[0], out.shape[1]))
    out[there] = patch.data[here][..., 3] >= max(1.0, 127.5 * peak)
    return out
