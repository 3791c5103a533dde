"""Point samples and moments of outlines and masks, in numpy."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.spatial import ConvexHull, QhullError

Loops = Sequence[Float[np.ndarray, "_ 2"]]
"""Closed outlines, each (V, 2) without a repeated first vertex."""

ISOTROPIC = 1.08
"""Shapes that are less elongated than this have no direction of their own."""
EDGE_NEAR, EDGE_SHARE = 5.0, 0.6
"""Sides within so many degrees of the axis of inertia give the axis where they make up this share of both flanks."""
AXIS_ALIGNED = 1.0
"""Principal axes within this many degrees of a picture axis are that axis."""
CORNER_SHARE = 0.6
"""Largest share of a loop's samples that sit on its corners; the rest even out the spacing."""


def support_points(loops: Loops, count: int) -> Float[np.ndarray, "count 2"]:
    """Extreme vertices in `count` directions: the four axis directions, the rest evenly spaced.

    The extremes of the four axis directions are exact. Directions with the same extreme repeat it.

    Raises:
        ValueError: no vertices, or fewer than four directions.
    """
    if count < 4:
        raise ValueError(f"count must be at least 4, not {count}")
    every = np.concatenate(list(loops))
    if count % 4 == 0:
        degrees = np.arange(count) * (360.0 / count)
    else:
        degrees = np.append(np.arange(4) * 90.0, (np.arange(count - 4) + 0.5) * (360.0 / (count - 4)))
    directions = np.stack([np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))])
    directions[np.abs(directions) < 1e-12] = 0.0
    return np.asarray(every[(every @ directions).argmax(0)])


def resample(
    loops: Loops, count: int
) -> tuple[Float[np.ndarray, "count 2"], Float[np.ndarray, "count 2"], Float[np.ndarray, " count"]]:
    """Exactly `count` points on the outlines, allotted to the loops by length, corners first.

    Returns:
        points: in order along each loop.
        ends: the next point of the same loop, so that (points, ends) are the edges of closed polygons.
        weight: share of the outline length each point stands for, sum 1. Points that could not be placed
            (outlines of no length) repeat a vertex with a zero-length edge and weight 0; when there are more
            loops than a third of `count`, the shortest are left out.

    Raises:
        ValueError: no vertices, or `count` below 3.
    """
    if count < 3:
        raise ValueError(f"count must be at least 3, not {count}")
    lengths = np.array([perimeter(loop) for loop in loops])
    chosen = np.sort(np.argsort(-lengths, kind="stable")[: count // 3])
    chosen = chosen[lengths[chosen] > 1e-9]
    if not len(chosen):
        return _nothing(np.concatenate(list(loops)), count)
    quota = 3 + allot(lengths[chosen], count - 3 * len(chosen))
    pieces = [_along(np.asarray(loops[k], dtype=float), int(n)) for k, n in zip(chosen, quota, strict=True)]
    points = np.concatenate(pieces)
    ends = np.concatenate([np.roll(piece, -1, 0) for piece in pieces])
    edge = np.linalg.norm(ends - points, axis=1)
    before = np.concatenate([np.roll(e, 1) for e in np.split(edge, np.cumsum(quota)[:-1])])
    return points, ends, (edge + before) / (2 * edge.sum())


def allot(sizes: Float[np.ndarray, " n"], total: int) -> Int[np.ndarray, " n"]:
    """Share `total` out in proportion to `sizes` by largest remainder."""
    exact = sizes * (total / sizes.sum())
    out = np.floor(exact).astype(int)
    rest = total - int(out.sum())
    out[np.argsort(out - exact, kind="stable")[:rest]] += 1
    return np.asarray(out)


def perimeter(loop: Float[np.ndarray, "n 2"]) -> float:
    """Length of a closed loop."""
    return float(np.linalg.norm(np.roll(loop, -1, 0) - loop, axis=1).sum())


def corners(loop: Float[np.ndarray, "n 2"], most: int) -> Int[np.ndarray, " k"]:
    """Indices, ascending, of 3 to `most` vertices that describe the loop best (Douglas-Peucker)."""
    import shapely

    n = len(loop)
    if n <= 3:
        return np.arange(n)
    first = int(np.linalg.norm(loop - loop.mean(0), axis=1).argmax())
    order = (np.arange(n + 1) + first) % n
    ring = shapely.linestrings(np.column_stack([loop[order], order]))
    tolerance = max(0.75, 0.004 * float(np.hypot(*np.ptp(loop, axis=0))))
    kept = order[:1]
    for _ in range(40):
        simple = shapely.simplify(ring, tolerance, preserve_topology=False)
        kept = shapely.get_coordinates(simple, include_z=True)[:-1, 2].astype(int)
        if len(kept) <= most:
            break
        tolerance *= 1.4
    return np.unique(kept)


def _along(loop: Float[np.ndarray, "n 2"], count: int) -> Float[np.ndarray, "count 2"]:
    """`count` points of a loop: its main corners, and between them points at even distances."""
    edge = np.linalg.norm(np.roll(loop, -1, 0) - loop, axis=1)
    reach = np.append(0.0, np.cumsum(edge))
    at = reach[corners(loop, max(3, int(CORNER_SHARE * count)))][:count]
    gaps = np.diff(np.append(at, at[0] + reach[-1]))
    extra = allot(gaps, count - len(at))
    start, gap, steps = (np.repeat(a, extra + 1) for a in (at, gaps, extra + 1))
    step = np.arange(count) - np.repeat(np.cumsum(extra + 1) - (extra + 1), extra + 1)
    where = np.sort((start + gap * step / steps) % reach[-1])
    closed = np.append(loop, loop[:1], 0)
    return np.stack([np.interp(where, reach, closed[:, 0]), np.interp(where, reach, closed[:, 1])], 1)


def _nothing(
    every: Float[np.ndarray, "n 2"], count: int
) -> tuple[Float[np.ndarray, "count 2"], Float[np.ndarray, "count 2"], Float[np.ndarray, " count"]]:
    points = np.repeat(every[:1], count, 0)
    return points, points.copy(), np.zeros(count)


def moments(loops: Loops) -> tuple[float, Float[np.ndarray, " 2"], Float[np.ndarray, "2 2"]]:
    """Area, centroid and covariance of the region inside the loops (Green's theorem)."""
    area, first, second = 0.0, np.zeros(2), np.zeros((2, 2))
    shift = np.asarray(loops[0][0], dtype=float)  # near the shape, so that nothing cancels
    for loop in loops:
        p = np.asarray(loop, dtype=float) - shift
        q = np.roll(p, -1, 0)
        cross = p[:, 0] * q[:, 1] - q[:, 0] * p[:, 1]
        sign = 1.0 if cross.sum() >= 0 else -1.0
        area += sign * cross.sum() / 2
        first += sign * (cross[:, None] * (p + q)).sum(0) / 6
        both = p[:, :, None] * p[:, None] + q[:, :, None] * q[:, None]
        mixed = p[:, :, None] * q[:, None] + q[:, :, None] * p[:, None]
        second += sign * (cross[:, None, None] * (2 * both + mixed)).sum(0) / 24
    if area < 1e-9:
        every = np.concatenate(list(loops))
        return 0.0, every.mean(0), np.cov(every.T, bias=True).reshape(2, 2)
    centre = first / area
    return area, centre + shift, second / area - np.outer(centre, centre)


def principal_axis(loops: Loops) -> Float[np.ndarray, " 2"]:
    """Unit vector of the long direction of the region inside the loops, pointing right (if vertical, down).

    Shapes without a long direction of their own get that of the longer side of their box, in doubt the
    horizontal. Where straight sides run along the axis of inertia within a few degrees, their direction counts: a
    slanted bar or a striped stick lies level when its sides do.
    """
    values, vectors = np.linalg.eigh(moments(loops)[2])
    if _ratio(values) < ISOTROPIC:
        wide, high = np.ptp(np.concatenate(list(loops)), axis=0)
        return np.array([0.0, 1.0]) if high > 1.02 * wide else np.array([1.0, 0.0])
    axis = _along_edges(np.concatenate(list(loops)), vectors[:, 1])
    flat = np.abs(axis) < np.sin(np.deg2rad(AXIS_ALIGNED))
    if flat.any():
        return np.where(flat, 0.0, 1.0)
    return np.asarray(axis * np.sign(axis[0]))


def _along_edges(points: Float[np.ndarray, "n 2"], axis: Float[np.ndarray, " 2"]) -> Float[np.ndarray, " 2"]:
    """`axis` turned into the mean direction of the hull's sides that are almost parallel to it, if these are long."""
    try:
        hull = points[ConvexHull(points).vertices]
    except QhullError:  # all on one line
        return axis
    side = np.roll(hull, -1, 0) - hull
    side *= np.sign(side @ axis)[:, None]
    length = np.linalg.norm(side, axis=1)
    near = (side @ axis > np.cos(np.deg2rad(EDGE_NEAR)) * length) & (length > 0)
    extent = float(np.ptp(points @ axis))
    if length[near].sum() < EDGE_SHARE * 2 * extent:
        return axis
    total = side[near].sum(0)
    return np.asarray(total / np.linalg.norm(total))


def elongation(loops: Loops) -> float:
    """Length over breadth of the ellipse with the region's moments, at least 1 (at most 1e6)."""
    return _ratio(np.linalg.eigvalsh(moments(loops)[2]))


def _ratio(values: Float[np.ndarray, " 2"]) -> float:
    short, long = np.maximum(values, 0.0)
    return 1.0 if long <= 0 else float(np.sqrt(long / max(short, 1e-12 * long)))


def area_samples(mask: Bool[np.ndarray, "H W"], count: int) -> Float[np.ndarray, "count 2"]:
    """`count` pixel centres of `mask`, spread evenly: one near the middle of each of `count` equal patches.

    Masks of fewer pixels repeat some.

    Raises:
        ValueError: the mask is empty.
    """
    rows, cols = np.nonzero(mask)
    n = len(rows)
    if n == 0:
        raise ValueError("the mask is empty")
    side = max(1, round(np.sqrt(n / count)))
    strip = (rows - rows.min()) // side
    snake = np.where(strip % 2 == 0, cols, -cols)
    order = np.lexsort((rows, snake, strip))
    points = np.stack([cols[order] + 0.5, rows[order] + 0.5], 1)
    if n <= count:
        return np.asarray(points[np.arange(count) * n // count])
    first = np.arange(count) * n // count
    sizes = np.diff(np.append(first, n))
    middle = np.add.reduceat(points, first, 0) / sizes[:, None]
    patch = np.repeat(np.arange(count), sizes)
    away = ((points - middle[patch]) ** 2).sum(1)
    return np.asarray(points[np.lexsort((away, patch))[first]])


def side_loops(loops: Loops, side: str, box: tuple[float, float, float, float]) -> tuple[Float[np.ndarray, "_ 2"], ...]:
    """The outermost quarter of a shape on one side: its outlines clipped to that quarter of `box`.

    Args:
        loops: closed outlines; those that do not reach the quarter contribute nothing.
        side: "top", "bot", "left" or "right".
        box: (min x, min y, max x, max y) that is quartered, usually the box of the loops.

    Raises:
        ValueError: another side.
    """
    import shapely

    x0, y0, x1, y1 = box
    w, h = (x1 - x0) / 4, (y1 - y0) / 4
    windows = {
        "top": (x0, y0, x1, y0 + h),
        "bot": (x0, y1 - h, x1, y1),
        "left": (x0, y0, x0 + w, y1),
        "right": (x1 - w, y0, x1, y1),
    }
    if side not in windows:
        raise ValueError(f"side must be one of {', '.join(windows)}, not {side!r}")
    if not len(loops):
        return ()
    shapes = shapely.make_valid(np.array([shapely.polygons(loop) for loop in loops]))
    parts = shapely.get_parts(shapely.get_parts(shapely.intersection(shapes, shapely.box(*windows[side]))))
    parts = parts[(shapely.get_type_id(parts) == 3) & (shapely.area(parts) > 1e-9)]
    rings = shapely.get_exterior_ring(parts)
    outlines = (shapely.get_coordinates(ring)[:-1][:: 1 if shapely.is_ccw(ring) else -1] for ring in rings)
    return tuple(outlines)
