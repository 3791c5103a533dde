"""From segment expressions of the DSL to arrays of material points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from iconjax.scene.sampling import (
    allot,
    elongation,
    perimeter,
    principal_axis,
    resample,
    side_loops,
    support_points,
)
from iconjax.scene.types import Scene
from iconjax.solve.arrays import Regions

HULL_POINTS, OUTLINE_POINTS = 128, 96


@dataclass(frozen=True)
class Material:
    """Some outlines carried by one segment; carrier None: they never move.

    Attributes:
        loops: closed outlines, each (V, 2), px.
        carrier: position of the segment that carries them.
        area: their share in what they are a part of, px^2.
    """

    loops: tuple[Float[np.ndarray, "_ 2"], ...]
    carrier: int | None
    area: float


@dataclass(frozen=True)
class RegionSpec:
    """A region of a program: plain material, or the intersection of two earlier regions."""

    materials: tuple[Material, ...]
    meet: tuple[int, int] | None = None


def materials_of(scene: Scene, members: Sequence[int]) -> tuple[Material, ...]:
    """The full outlines of some segments."""
    return tuple(Material(scene.segments[i].loops, i, scene.segments[i].area) for i in members)


def frozen(materials: Sequence[Material]) -> tuple[Material, ...]:
    """The same material as it was before the edit."""
    return tuple(Material(m.loops, None, m.area) for m in materials)


def side_of(materials: Sequence[Material], side: str) -> tuple[Material, ...]:
    """The outermost quarter of some material on one side of its common box."""
    box = _box([loop for m in materials for loop in m.loops])
    parts = []
    for m in materials:
        loops = tuple(side_loops(m.loops, side, box))
        if loops:
            parts.append(Material(loops, m.carrier, sum(abs(_area(loop)) for loop in loops)))
    return tuple(parts)


def canvas_material(scene: Scene) -> Material:
    """The whole picture as a rectangle."""
    w, h = float(scene.width), float(scene.height)
    return Material((np.array([[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]]),), None, w * h)


def _area(loop: Float[np.ndarray, "v 2"]) -> float:
    x, y = loop[:, 0], loop[:, 1]
    return float(0.5 * np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def _box(loops: Sequence[Float[np.ndarray, "_ 2"]]) -> tuple[float, float, float, float]:
    points = np.concatenate(loops)
    (x0, y0), (x1, y1) = points.min(0), points.max(0)
    return float(x0), float(y0), float(x1), float(y1)


def own_frame(loops: Sequence[Float[np.ndarray, "_ 2"]]) -> Float[np.ndarray, "2"]:
    """The axis along which a segment is naturally scaled: its long one where it clearly has one, else horizontal."""
    axis = principal_axis(loops)
    if elongation(loops) < 1.6 or min(abs(axis)) < np.sin(np.radians(6)):
        return np.array([1.0, 0.0])
    axis = axis if abs(axis[0]) >= abs(axis[1]) else np.array([-axis[1], axis[0]])
    return axis if axis[0] > 0 else -axis


def build_regions(specs: Sequence[RegionSpec], segments: int, rows: int) -> Regions:
    """Arrays for the regions of a program, padded to `rows` regions; segment number `segments` never moves."""
    q, p = HULL_POINTS, OUTLINE_POINTS
    out = Regions(
        hull=np.zeros((rows, q, 2)), hull_segment=np.full((rows, q), segments), hull_mask=np.ones((rows, q)),
        points=np.zeros((rows, p, 2)), ends=np.zeros((rows, p, 2)), segment=np.full((rows, p), segments),
        weight=np.zeros((rows, p)), share=np.zeros((rows, segments + 1)), long_dir=np.tile([1.0, 0.0], (rows, 1)),
        frame=np.tile([1.0, 0.0], (rows, 1)), first=np.full(rows, -1), second=np.full(rows, -1),
    )  # fmt: skip
    out.share[:, segments] = 1.0
    for k, spec in enumerate(specs):
        if spec.meet is not None:
            out.first[k], out.second[k] = spec.meet
            spec = RegionSpec(specs[spec.meet[0]].materials + specs[spec.meet[1]].materials)
        _fill(out, k, spec.materials, segments)
    return out


def _fill(out: Regions, k: int, materials: Sequence[Material], still: int) -> None:
    def carrier(m: Material) -> int:
        return still if m.carrier is None else m.carrier

    loops = [loop for m in materials for loop in m.loops]
    out.long_dir[k], out.frame[k] = principal_axis(loops), own_frame(loops)
    out.share[k] = 0.0
    total = sum(m.area for m in materials) or 1.0
    sizes = np.array([sum(perimeter(loop) for loop in m.loops) for m in materials])
    at_hull = at_points = 0
    hulls = _counts(np.ones(len(materials)), out.hull.shape[1])
    points = _counts(sizes, out.points.shape[1])
    for m, size, hull_count, point_count in zip(materials, sizes, hulls, points, strict=True):
        out.share[k, carrier(m)] += m.area / total
        if hull_count:
            rows = slice(at_hull, at_hull + hull_count)
            out.hull[k, rows] = support_points(m.loops, hull_count)
            out.hull_segment[k, rows] = carrier(m)
            at_hull += hull_count
        if point_count:
            rows = slice(at_points, at_points + point_count)
            out.points[k, rows], out.ends[k, rows], weight = resample(m.loops, point_count)
            out.weight[k, rows] = weight * size / (sizes.sum() or 1.0)
            out.segment[k, rows] = carrier(m)
            at_points += point_count


def _counts(sizes: Float[np.ndarray, " m"], total: int) -> list[int]:
    """Points for each of several outlines by size, at least four each; the smallest get none if there are too many."""
    counts = np.zeros(len(sizes), int)
    chosen = np.argsort(-sizes, kind="stable")[: total // 4]
    counts[chosen] = 4 + allot(sizes[chosen], total - 4 * len(chosen))
    return [int(c) for c in counts]


def scene_hulls(scene: Scene, count: int, rows: int) -> Float[np.ndarray, "rows count 2"]:
    """Support points of every segment, padded to `rows` segments."""
    hulls = np.zeros((rows, count, 2))
    for i, s in enumerate(scene.segments):
        hulls[i] = support_points(s.loops, count)
    return hulls


def index_array(values: Sequence[int], rows: int, fill: int) -> Int[np.ndarray, " rows"]:
    """Integers padded to a static length."""
    out = np.full(rows, fill)
    out[: len(values)] = values
    return out
