"""Boolean operators on regions; `union` is structural and left to the compiler."""

from __future__ import annotations

from typing import NamedTuple

import jax.numpy as jnp
from jax.lax import stop_gradient
from jaxtyping import Array, Float

from iconjax.dsl.operators import implements
from iconjax.dsl.operators.outline import meetings, nearest
from iconjax.dsl.operators.safe import Vector
from iconjax.dsl.region import Region


class _Edges(NamedTuple):
    """Edges of an outline cut down to what lies in another region; without weight where nothing does."""

    points: Float[Array, "P 2"]
    ends: Float[Array, "P 2"]
    weight: Float[Array, " P"]


@implements("inter")
def inter(s: Region, t: Region) -> Region:
    """What S and T share: of each outline, the edges that lie in the other, cut where the outlines cross.

    The result has the points of both (so twice as many), and they are its hull as well. Where nothing is
    shared it shrinks to the point midway between the two. It takes its axes from S and the mean of both
    transforms.
    """
    parts = [_within(s, t), _within(t, s)]
    points, ends, weight = (jnp.concatenate(arrays) for arrays in zip(*parts, strict=True))
    total = jnp.sum(weight)
    empty = total <= 0
    middle = _midway(s, t)
    points, ends = jnp.where(empty, middle, points), jnp.where(empty, middle, ends)
    weight = jnp.where(empty, 1 / weight.shape[0], weight / jnp.where(empty, 1, total))
    points0 = jnp.concatenate([s.points0, t.points0])
    matrix = (s.matrix + t.matrix) / 2
    return Region(points, points0, weight > 0, points, ends, points0, weight, matrix, s.long_dir0, s.frame0)


def _within(s: Region, t: Region) -> _Edges:
    """The outline of S within T. An edge that leaves T and comes back is kept whole in between."""
    edge = s.ends - s.points
    cross, place = meetings(s, t)
    enter = jnp.min(jnp.where(cross, place, 1), axis=0)
    leave = jnp.max(jnp.where(cross, place, 0), axis=0)
    low = jnp.where(nearest(s.points, t)[1], 0, enter)
    high = jnp.where(nearest(s.ends, t)[1], 1, leave)
    kept = (s.weight > 0) & (high > low)
    low, high = jnp.where(kept, low, 0)[:, None], jnp.where(kept, high, 0)[:, None]
    return _Edges(s.points + low * edge, s.points + high * edge, s.weight * (high - low)[:, 0])


def _midway(s: Region, t: Region) -> Vector:
    """The point midway between the vertices of S and T that are nearest to each other."""
    square = jnp.sum(stop_gradient(s.points[:, None] - t.points[None]) ** 2, axis=2)
    square = jnp.where((s.weight[:, None] > 0) & (t.weight[None] > 0), square, jnp.inf)
    i, j = jnp.divmod(jnp.argmin(square), t.points.shape[0])
    return (s.points[i] + t.points[j]) / 2
