"""Running a constraint program inside the solver: values and derivatives of its residuals.

A program is data (`Code`), not code: a loop over leaves and one over steps, each with a switch over operators. Switch
index and loop bounds are the same for every candidate of a batch, so only operators that are asked for run, and no new
program compiles anything. Each leaf differentiates its own operator backwards, by the points of its regions and from
there by the transforms of the few bodies; steps then carry values and derivatives forward.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Float, Int

from iconjax.dsl.region import Region
from iconjax.solve.arrays import Code, Regions
from iconjax.solve.pose import Array
from iconjax.solve.table import OperatorTable


def segment_matrices(matrices: Float[Array, "K 6"], body: Int[Array, " N"]) -> Float[Array, "N1 6"]:
    """Transform of each segment, and of the segment that never moves as the last one."""
    still = jnp.array([[1.0, 0.0, 0.0, 0.0, 1.0, 0.0]], matrices.dtype)
    table = jnp.concatenate([matrices, still])
    pick = jax.nn.one_hot(jnp.append(body, matrices.shape[0]), table.shape[0], dtype=matrices.dtype)
    return pick @ table


def move(points: Float[Array, "*n 2"], matrix: Float[Array, "*n 6"]) -> Float[Array, "*n 2"]:
    """Points under one transform each."""
    x, y = points[..., 0], points[..., 1]
    m = matrix
    return jnp.stack([m[..., 0] * x + m[..., 1] * y + m[..., 2], m[..., 3] * x + m[..., 4] * y + m[..., 5]], axis=-1)


class _Posed(NamedTuple):
    """All regions of a program in their current pose; leading axis R. The pose is what derivatives are taken by."""

    hull: Float[Array, "R Q 2"]
    points: Float[Array, "R P 2"]
    ends: Float[Array, "R P 2"]
    matrix: Float[Array, "R 2 3"]


def _region(regions: Regions, k: Int[Array, ""], posed: _Posed) -> Region:
    """Region `k` whose pose is given by `posed` (already picked out)."""
    return Region(
        hull=posed.hull,
        hull0=regions.hull[k],
        hull_mask=regions.hull_mask[k] > 0,
        points=posed.points,
        ends=posed.ends,
        points0=regions.points[k],
        weight=regions.weight[k],
        matrix=posed.matrix,
        long_dir0=regions.long_dir[k],
        frame0=regions.frame[k],
    )


_Operand = tuple[_Posed, _Posed | None]
"""Pose of a region; of an intersection, the poses of both regions it is made of."""


def _pick(posed: _Posed, k: Int[Array, ""]) -> _Posed:
    return _Posed(*(x[k] for x in posed))


def _leaf_branches(regions: Regions, table: OperatorTable, wide: bool) -> Sequence[Callable[..., Any]]:
    """For each leaf operator: value, and derivatives by its posed regions."""

    def operand(pose: _Operand, k: Int[Array, ""]) -> Region:
        first, second = pose
        if second is None:
            return _region(regions, k, first)
        # An intersection is as large as both of its regions together, so that in this mode all regions are.
        region: Region = jax.lax.cond(
            regions.second[k] >= 0,
            lambda: table.inter(_region(regions, regions.first[k], first), _region(regions, regions.second[k], second)),
            lambda: _widened(_region(regions, k, first)),
        )
        return region

    def branch(kind: str, function: Callable[..., Any]) -> Callable[..., Any]:
        def run(pa: _Operand, pb: _Operand, a, b, extra):  # type: ignore[no-untyped-def]
            if kind == "region":
                return function(operand(pa, a))
            both = operand(pa, a), operand(pb, b)
            return function(*both, extra) if kind == "points" else function(*both)

        return jax.value_and_grad(run, argnums=(0, 1))

    return [branch(k, f) for k, f in zip(table.leaf_kinds, table.leaf_functions, strict=True)]


def _widened(region: Region) -> Region:
    q, p = region.hull.shape[0], region.points.shape[0]
    more = 2 * p - q

    def repeat_first(x: Float[Array, "n 2"], count: int) -> Float[Array, "m 2"]:
        return jnp.concatenate([x, jnp.broadcast_to(x[:1], (count, 2))])

    return region._replace(
        hull=repeat_first(region.hull, more),
        hull0=repeat_first(region.hull0, more),
        hull_mask=jnp.concatenate([region.hull_mask, jnp.zeros(more, bool)]),
        points=repeat_first(region.points, p),
        # A padding edge starts and ends at the first point.
        ends=jnp.concatenate([region.ends, jnp.broadcast_to(region.points[:1], (p, 2))]),
        points0=repeat_first(region.points0, p),
        weight=jnp.concatenate([region.weight, jnp.zeros(p, region.weight.dtype)]),
    )


def _moments(g: Float[Array, "n 2"], at: Float[Array, "n 2"], carrier: Float[Array, "n N1"]) -> Float[Array, "N1 6"]:
    """Derivative by the transforms of the carriers, of something with derivative `g` by the moved points `at`."""
    one = jnp.concatenate([at, jnp.ones((at.shape[0], 1), at.dtype)], 1)
    return jnp.einsum("nc,ni,nj->cij", carrier, g, one).reshape(-1, 6)


class _Poser(NamedTuple):
    """All regions in their pose, and the way back from a derivative by a pose to one by the bodies' transforms."""

    regions: Regions
    posed: _Posed
    hull_of: Float[Array, "R Q N1"]
    point_of: Float[Array, "R P N1"]
    pick: Float[Array, "N1 K"]

    def slope(self, k: Int[Array, ""], g: _Posed) -> Float[Array, "K 6"]:
        """Derivative by the bodies, of something with derivative `g` by the pose of region `k`."""
        regions, points = self.regions, self.point_of[k]
        out = _moments(g.hull, regions.hull[k], self.hull_of[k])
        out += _moments(g.points, regions.points[k], points) + _moments(g.ends, regions.ends[k], points)
        return self.pick.T @ (out + regions.share[k][:, None] * g.matrix.reshape(6))

    def operand(self, k: Int[Array, ""], wide: bool) -> _Operand:
        """The pose of region `k`."""
        if not wide:
            return _pick(self.posed, k), None
        meets = self.regions.second[k] >= 0
        first = jnp.where(meets, self.regions.first[k], k)
        second = jnp.where(meets, self.regions.second[k], k)
        return _pick(self.posed, first), _pick(self.posed, second)

    def slope_of_operand(self, k: Int[Array, ""], g: _Operand) -> Float[Array, "K 6"]:
        """Like `slope`, for what `operand` gave."""
        first, second = g
        if second is None:
            return self.slope(k, first)
        meets = self.regions.second[k] >= 0
        out = self.slope(jnp.where(meets, self.regions.first[k], k), first)
        return out + self.slope(jnp.where(meets, self.regions.second[k], k), second)


def _pose(regions: Regions, matrices: Float[Array, "K 6"], body: Int[Array, " N"]) -> _Poser:
    segments = segment_matrices(matrices, body)
    # Products with one-hot matrices: gathers and scatters are slow where the work is this small.
    hull_of = jax.nn.one_hot(regions.hull_segment, segments.shape[0], dtype=matrices.dtype)
    point_of = jax.nn.one_hot(regions.segment, segments.shape[0], dtype=matrices.dtype)
    carriers = point_of @ segments
    posed = _Posed(
        move(regions.hull, hull_of @ segments),
        move(regions.points, carriers),
        move(regions.ends, carriers),
        (regions.share @ segments).reshape(-1, 2, 3),
    )
    pick = jax.nn.one_hot(jnp.append(body, matrices.shape[0]), matrices.shape[0], dtype=matrices.dtype)
    return _Poser(regions, posed, hull_of, point_of, pick)


def residuals(
    code: Code,
    regions: Regions,
    matrices: Float[Array, "K 6"],
    body: Int[Array, " N"],
    table: OperatorTable,
    wide: bool = False,
) -> tuple[Float[Array, " C"], Float[Array, "C K 6"]]:
    """Residuals of a program in pixels, and their derivatives by the bodies' transforms."""
    leaves, steps = code.leaf_op.shape[0], code.step_op.shape[0]
    poser = _pose(regions, matrices, body)
    leaf_branches = _leaf_branches(regions, table, wide)
    step_branches = [jax.value_and_grad(lambda x, y: 0.0 * (x + y), argnums=(0, 1))]
    step_branches += [jax.value_and_grad(f, argnums=(0, 1)) for f in table.step_functions]

    def leaf(t, carry):  # type: ignore[no-untyped-def]
        values, slopes = carry
        a, b = code.region_a[t], code.region_b[t]
        pa, pb = poser.operand(a, wide), poser.operand(b, wide)
        value, (by_a, by_b) = jax.lax.switch(code.leaf_op[t], leaf_branches, pa, pb, a, b, code.extra[t])
        slope = poser.slope_of_operand(a, by_a) + poser.slope_of_operand(b, by_b)
        return values.at[t].set(value), slopes.at[t].set(slope)

    def step(t, carry):  # type: ignore[no-untyped-def]
        values, slopes = carry
        x, y = code.value_a[t], code.value_b[t]
        value, (by_x, by_y) = jax.lax.switch(code.step_op[t], step_branches, values[x], values[y])
        slope = by_x * slopes[x] + by_y * slopes[y]
        return values.at[leaves + t].set(value + code.literal[t]), slopes.at[leaves + t].set(slope)

    registers = leaves + steps
    start = (jnp.zeros(registers, matrices.dtype), jnp.zeros((registers, *matrices.shape), matrices.dtype))
    after_leaves = jax.lax.fori_loop(0, code.leaves, leaf, start)
    values, slopes = jax.lax.fori_loop(0, code.steps, step, after_leaves)
    return values[code.out] * code.scale, slopes[code.out] * code.scale[:, None, None]
