"""Outer outlines of a pixel mask as smooth closed polygons."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.ndimage import label

SPECK_PIXELS = 6
SPECK_SHARE = 0.001
"""A component of fewer pixels and less than this share of the segment has no outline."""
SMOOTH_ROUNDS = 16
MAX_SHIFT = 0.5
"""Furthest, in pixels, that smoothing may move a point of the half-level contour."""
STRAIGHT = 0.15
"""Largest error, in pixels, of leaving out vertices on almost straight stretches."""
_EIGHT = np.ones((3, 3), dtype=bool)


def fill(mask: Bool[np.ndarray, "h w"]) -> Bool[np.ndarray, "h w"]:
    """`mask` with its inner holes closed; a hole may not leak out diagonally between two pixels."""
    empty = label(~np.pad(mask, 1))[0]
    return np.asarray(empty != empty[0, 0])[1:-1, 1:-1]


def drop_specks(mask: Bool[np.ndarray, "h w"]) -> Bool[np.ndarray, "h w"]:
    """`mask` without components of a few pixels that are next to nothing of the whole; one always remains."""
    parts, count = label(mask, _EIGHT)
    if count < 2:
        return mask
    sizes = np.bincount(parts.ravel())
    keep = (sizes >= SPECK_PIXELS) | (sizes >= SPECK_SHARE * sizes[1:].sum())
    keep[0] = False
    return np.asarray(keep[parts])


def trace(mask: Bool[np.ndarray, "h w"]) -> tuple[Float[np.ndarray, "_ 2"], ...]:
    """Outlines of a mask without holes, one per component (pixels that meet at a corner belong together).

    They follow the edges between pixels: straight axis-aligned edges and their corners are exact, staircases
    become the lines and curves they stand for, and the box of each outline is exactly that of its pixels.
    Coordinates are (x, y) in pixels from the corner of the array; the shoelace area is positive.
    """
    starts, heads = _cracks(mask)
    order, sizes = _chains(starts, heads, mask.shape[1] + 1)
    raw, rings, fixed, corner = _half_level(starts[order], heads[order], _Rings.of(sizes))
    smooth = _relax(raw, rings, ~fixed)
    thin, owner = _thin_out(smooth, rings, fixed, corner)
    thin_loops = np.split(thin, np.flatnonzero(np.diff(owner)) + 1)
    raw_loops = np.split(raw, rings.first[1:])
    simple = _are_simple(thin, owner, thin_loops)
    return tuple(t if ok else r for t, r, ok in zip(thin_loops, raw_loops, simple, strict=True))


class _Rings(NamedTuple):
    """Rows of an array as closed loops, one after the other: each row's loop, the row before and after it."""

    loop: Int[np.ndarray, " n"]
    before: Int[np.ndarray, " n"]
    after: Int[np.ndarray, " n"]
    first: Int[np.ndarray, " loops"]

    @classmethod
    def of(cls, sizes: Int[np.ndarray, " loops"]) -> _Rings:
        first = np.cumsum(sizes) - sizes
        index = np.arange(int(sizes.sum()))
        before, after = index - 1, index + 1
        before[first] = first + sizes - 1
        after[first + sizes - 1] = first
        return cls(np.repeat(np.arange(len(sizes)), sizes), before, after, first)


_STEP = np.array([[1, 0], [0, 1], [-1, 0], [0, -1]])


def _cracks(mask: Bool[np.ndarray, "h w"]) -> tuple[Int[np.ndarray, "n 2"], Int[np.ndarray, " n"]]:
    """Edges between in and out: start (x, y) and heading (0 east, 1 south, 2 west, 3 north), inside right."""
    p = np.pad(mask, 1)
    own = p[1:-1, 1:-1]
    outside = (p[:-2, 1:-1], p[1:-1, 2:], p[2:, 1:-1], p[1:-1, :-2])
    corner = ((0, 0), (1, 0), (1, 1), (0, 1))
    starts, heads = [], []
    for heading in range(4):
        rows, cols = np.nonzero(own & ~outside[heading])
        starts.append(np.stack([cols + corner[heading][0], rows + corner[heading][1]], 1))
        heads.append(np.full(len(rows), heading))
    return np.concatenate(starts), np.concatenate(heads)


def _chains(
    starts: Int[np.ndarray, "n 2"], heads: Int[np.ndarray, " n"], stride: int
) -> tuple[Int[np.ndarray, " n"], Int[np.ndarray, " loops"]]:
    """The edges in order of travel, loop after loop, and the number of edges of each loop.

    A loop starts at its topmost leftmost corner, as that edge comes first.
    """
    where = starts[:, 1] * stride + starts[:, 0]
    leaving = np.full((4, int(where.max()) + 1), -1)
    leaving[heads, where] = np.arange(len(heads))
    stop = starts + _STEP[heads]
    stop_at = stop[:, 1] * stride + stop[:, 0]
    follow = np.full(len(heads), -1)
    for turn in (1, 0, 3):  # the left turn is looked at last and wins: diagonal pixels stay together
        option = leaving[(heads + turn) % 4, stop_at]
        follow = np.where(option >= 0, option, follow)
    successor = follow.tolist()
    seen = bytearray(len(successor))
    order: list[int] = []
    begins: list[int] = []
    for first in range(len(successor)):
        if not seen[first]:
            begins.append(len(order))
            k = first
            while not seen[k]:
                seen[k] = 1
                order.append(k)
                k = successor[k]
    return np.array(order), np.diff([*begins, len(order)])


def _half_level(
    starts: Int[np.ndarray, "n 2"], heads: Int[np.ndarray, " n"], edges: _Rings
) -> tuple[Float[np.ndarray, "m 2"], _Rings, Bool[np.ndarray, " m"], Bool[np.ndarray, " m"]]:
    """Midpoints of the edges plus the true corners between them; which may not move; which are corners."""
    turns = (heads - heads[edges.before]) % 4  # at the start of each edge: 0 none, 1 right, 3 left
    at = np.flatnonzero(turns)
    runs = _Rings.of(np.bincount(edges.loop[at]))
    entry = turns[at]
    length = np.diff(np.append(at, len(heads)))
    # Three pixels, or the same turn at both ends, make a side; the rest are steps of a staircase.
    side = (length >= 3) | (entry == entry[runs.after])
    sharp = np.zeros(len(heads), dtype=bool)
    sharp[at] = side & side[runs.before] & _alone(starts[at])
    middles = starts + _STEP[heads] / 2
    low = np.minimum.reduceat(middles, edges.first)[edges.loop]
    high = np.maximum.reduceat(middles, edges.first)[edges.loop]
    extreme = ((middles == low) | (middles == high)).any(1)
    here = np.flatnonzero(sharp)
    raw = np.insert(middles, here, starts[here], 0)
    corner = np.insert(np.zeros(len(heads), dtype=bool), here, True)
    rings = _Rings.of(np.bincount(np.insert(edges.loop, here, edges.loop[here])))
    return raw, rings, np.insert(extreme, here, True), corner


def _alone(points: Int[np.ndarray, "n 2"]) -> Bool[np.ndarray, " n"]:
    """Which points are passed only once: corners where an outline touches itself must stay cut."""
    code = points[:, 1] * (int(points[:, 0].max()) + 1) + points[:, 0]
    return np.asarray(np.bincount(code)[code] == 1)


def _relax(raw: Float[np.ndarray, "n 2"], rings: _Rings, loose: Bool[np.ndarray, " n"]) -> Float[np.ndarray, "n 2"]:
    """The loose points smoothed, each a little."""
    points = raw.copy()
    before, after = rings.before[loose], rings.after[loose]
    for round_ in range(2 * SMOOTH_ROUNDS):  # Taubin: a step in and a slightly longer one out keep the area
        pull = (points[before] + points[after]) / 2 - points[loose]
        points[loose] += (0.5 if round_ % 2 == 0 else -0.53) * pull
    return np.asarray(raw + np.clip(points - raw, -MAX_SHIFT, MAX_SHIFT))


def _thin_out(
    points: Float[np.ndarray, "n 2"],
    rings: _Rings,
    fixed: Bool[np.ndarray, " n"],
    corner: Bool[np.ndarray, " n"],
) -> tuple[Float[np.ndarray, "m 2"], Int[np.ndarray, " m"]]:
    """The points without those on straight stretches between corners and ends of fixed runs; their loops."""
    import shapely

    keep = corner | (fixed & ~(fixed[rings.before] & fixed[rings.after]))
    keep[rings.first] = True
    at = np.flatnonzero(keep)
    sizes = np.diff(np.append(at, len(points))) + 1  # a piece includes the first point of the next
    piece = np.repeat(np.arange(len(at)), sizes)
    within = np.arange(len(piece)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    row = at[piece] + within
    last = within == sizes[piece] - 1
    row[last] = rings.after[row[last] - 1]
    lines = shapely.linestrings(points[row], indices=piece)
    lines = shapely.simplify(lines, STRAIGHT, preserve_topology=False)
    out, owner = shapely.get_coordinates(lines, return_index=True)
    inner = np.append(owner[1:] == owner[:-1], False)
    return np.asarray(out[inner]), np.asarray(rings.loop[at][owner[inner]])


def _are_simple(
    points: Float[np.ndarray, "n 2"], owner: Int[np.ndarray, " n"], loops: list[Float[np.ndarray, "_ 2"]]
) -> Bool[np.ndarray, " loops"]:
    """Which loops have three corners or more and do not cross themselves."""
    import shapely

    enough = np.array([len(loop) >= 3 for loop in loops])
    chosen = enough[owner]
    number = (np.cumsum(enough) - 1)[owner[chosen]]
    simple = enough.copy()
    simple[enough] = shapely.is_valid(shapely.polygons(shapely.linearrings(points[chosen], indices=number)))
    return simple
