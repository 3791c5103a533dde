"""Segments of an SVG as a scene: outlines, visible pixels, and the layers it is painted in."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from jaxtyping import Bool, Float, Int32, UInt8

from iconjax.scene.build import background_colour
from iconjax.scene.labels import number_names, split_name
from iconjax.scene.outline import drop_specks, fill, trace
from iconjax.scene.svg.draw import Patch
from iconjax.scene.svg.grouping import Draft
from iconjax.scene.svg.sight import Sight, over, overlap, solid
from iconjax.scene.types import Layer, Scene, Segment

Owner = Int32[np.ndarray, "H W"]


def assemble(
    image: UInt8[np.ndarray, "H W 3"], sights: Sequence[Sight], drafts: Sequence[Draft], labels: Mapping[int, str]
) -> Scene:
    """The scene of n drafts, which are segments 1 to n.

    Outlines follow the whole elements, hidden parts and parts beyond the picture's border included; a mask
    holds the pixels in which a segment is seen.

    Args:
        image: the drawing on white.
        sights: the items in paint order.
        drafts: the segments in paint order.
        labels: label by segment number.
    """
    shape = (image.shape[0], image.shape[1])
    owner = _owners(sights, drafts, shape)
    outlines = [_outline([sights[i] for i in draft.members], shape) for draft in drafts]
    boxes = [_box(loops) for loops, _ in outlines]
    centres = {k + 1: ((b[0] + b[2]) / 2, (b[1] + b[3]) / 2) for k, b in enumerate(boxes)}
    names = number_names(labels, centres, image.shape[1])
    segments = []
    for k, ((loops, area), box) in enumerate(zip(outlines, boxes, strict=True)):
        thing, part = split_name(names[k + 1])
        segments.append(Segment(k + 1, names[k + 1], thing, part, owner == k, loops, area, box))
    background = background_colour(image, (owner + 1).astype(np.int32))
    return Scene(image, tuple(segments), background, layers(sights, drafts))


def layers(sights: Sequence[Sight], drafts: Sequence[Draft]) -> tuple[Layer, ...]:
    """Runs of items of one segment, in paint order."""
    segment = {i: k for k, draft in enumerate(drafts) for i in draft.members}
    runs: list[tuple[int | None, list[Patch]]] = []
    for i, sight in enumerate(sights):
        owner = segment.get(i)
        if not runs or runs[-1][0] != owner:
            runs.append((owner, []))
        runs[-1][1].append(sight.patch)
    return tuple(_layer(owner, patches) for owner, patches in runs)


def _layer(owner: int | None, patches: Sequence[Patch]) -> Layer:
    if len(patches) == 1:
        return Layer(owner, patches[0].data, patches[0].top, patches[0].left)
    top, left = min(p.top for p in patches), min(p.left for p in patches)
    bottom = max(p.top + p.data.shape[0] for p in patches)
    right = max(p.left + p.data.shape[1] for p in patches)
    canvas = np.zeros((bottom - top, right - left, 4), np.float32)
    for patch in patches:
        over(canvas, Patch(patch.data, patch.top - top, patch.left - left))
    canvas[..., 3] *= 255
    return Layer(owner, np.rint(canvas).astype(np.uint8), top, left)


def _owners(sights: Sequence[Sight], drafts: Sequence[Draft], shape: tuple[int, int]) -> Owner:
    """Position of the segment seen in each pixel, -1 for none: the one that shows most, if it shows clearly."""
    best = np.full(shape, 0.02, np.float32)
    owner = np.full(shape, -1, np.int32)
    shares = []
    for k, draft in enumerate(drafts):
        share, peak = np.zeros(shape, np.float32), max(sights[i].peak for i in draft.members)
        for i in draft.members:
            here, there = overlap(sights[i].patch, shape)
            share[there] += sights[i].seen[here]
        clear = (share >= 0.5 * peak) & (share > best)
        best[clear], owner[clear] = share[clear], k
        shares.append(share >= 0.5 * min(peak, float(share.max(initial=0.0))))
    counts = np.bincount(owner[owner >= 0], minlength=len(drafts))
    for k in np.flatnonzero(counts == 0).tolist():  # a faint thing on others: it is seen, and has to own something
        room = shares[k] & (counts[owner] > 2 * shares[k].sum()) | shares[k] & (owner < 0)
        owner[room if room.any() else shares[k]] = k
    return owner


def _outline(sights: Sequence[Sight], shape: tuple[int, int]) -> tuple[tuple[Float[np.ndarray, "_ 2"], ...], float]:
    """Outer outlines of items together, and the area in them."""
    top, left = min(s.patch.top for s in sights), min(s.patch.left for s in sights)
    bottom = max(s.patch.top + s.patch.data.shape[0] for s in sights)
    right = max(s.patch.left + s.patch.data.shape[1] for s in sights)
    mask: Bool[np.ndarray, "h w"] = np.zeros((bottom - top, right - left), bool)
    for s in sights:
        mask |= solid(Patch(s.patch.data, s.patch.top - top, s.patch.left - left), mask.shape, s.peak)
    whole = fill(drop_specks(mask))
    corner = np.array([left, top], dtype=float)
    return tuple(loop + corner for loop in trace(whole)), float(whole.sum())


def _box(loops: Sequence[Float[np.ndarray, "_ 2"]]) -> tuple[float, float, float, float]:
    every = np.concatenate(list(loops))
    (x0, y0), (x1, y1) = every.min(0), every.max(0)
    return float(x0), float(y0), float(x1), float(y1)
