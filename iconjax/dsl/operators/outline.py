"""Distances between filled outlines: exact point-to-edge distances, signed by the winding number.

Choices (which edge is nearest, inside or outside) are made without gradient on all pairs at once; the few
chosen pairs are then computed again with gradient. That is exact, and it keeps all pairwise arrays out of the
backward pass.
"""

from __future__ import annotations

from typing import NamedTuple

import jax
import jax.numpy as jnp
from jax.lax import stop_gradient
from jaxtyping import Array, Bool, Float, Int

from iconjax.dsl.operators import safe
from iconjax.dsl.operators.safe import Scalar, Vector
from iconjax.dsl.region import Region

FAR = 1e6
CONTACT = 1e-3  # pixels: nearer than this to an outline, the direction to it is taken from the edge


class Gap(NamedTuple):
    """How two regions lie to each other.

    Attributes:
        depth: signed distance between the filled regions: the gap between them, or minus the deepest
            penetration.
        least: least distance of a vertex of either outline to the other outline.
        crossing: whether the outlines cross.
    """

    depth: Scalar
    least: Scalar
    crossing: Bool[Array, ""]


def gap(s: Region, t: Region) -> Gap:
    """Measure the gap between two regions, both ways."""
    crossing, centre = crossings(s, t)
    # Thin bars can cross with no vertex of one in the other; the middle of what they share is in both.
    query_s, query_t = jnp.concatenate([s.points, centre[None]]), jnp.concatenate([t.points, centre[None]])
    mask = jnp.concatenate([s.weight > 0, crossing[None], t.weight > 0, crossing[None]])
    signed = jnp.concatenate([signed_distances(query_s, t), signed_distances(query_t, s)])
    depth = safe.ties(jnp.where(mask, signed, FAR))
    vertex = jnp.where(mask.at[-1].set(False).at[s.points.shape[0]].set(False), safe.absolute(signed), FAR)
    return Gap(depth, safe.ties(vertex), crossing)


def sticking_out(points: Float[Array, "n 2"], mask: Bool[Array, " n"], region: Region) -> Float[Array, " n"]:
    """How far each point lies outside `region`; 0 inside and for masked points."""
    return jnp.where(mask, safe.relu(signed_distances(points, region)), 0)


def signed_distances(points: Float[Array, "n 2"], region: Region) -> Float[Array, " n"]:
    """Distance of each point to the outline of `region`, negative inside; also differentiable on it."""
    edge, inside = nearest(points, region)
    start = region.points[edge]
    along = region.ends[edge] - start
    offset = points - start
    place = jnp.sum(offset * along, axis=1) / jnp.maximum(jnp.sum(along * along, axis=1), safe.TINY)
    offset = offset - stop_gradient(jnp.clip(place, 0, 1))[:, None] * along
    square = jnp.sum(offset * offset, axis=1)
    # On the outline itself the offset has no direction; the edge's outer normal has.
    normal = jnp.stack([along[:, 1], -along[:, 0]], axis=1) * orientation(region)
    straight = jnp.sum(offset * normal, axis=1) / (safe.norm(normal) + safe.TINY)
    apart = jnp.where(inside, -1, 1) * safe.sqrt(square)
    return jnp.where(square < CONTACT**2, straight, apart)


def nearest(points: Float[Array, "n 2"], region: Region) -> tuple[Int[Array, " n"], Bool[Array, " n"]]:
    """For each point, the nearest edge of the outline and whether the point lies inside; without gradient."""
    points, start, end = stop_gradient((points, region.points, region.ends))
    along = end - start
    scale = 1 / jnp.maximum(jnp.sum(along * along, axis=1), safe.TINY)
    ex, ey = along[:, 0, None], along[:, 1, None]
    dx, dy = points[None, :, 0] - start[:, 0, None], points[None, :, 1] - start[:, 1, None]
    place = jnp.clip((dx * ex + dy * ey) * scale[:, None], 0, 1)
    rx, ry = dx - place * ex, dy - place * ey
    absent = jnp.where(region.weight > 0, 0, FAR * FAR)
    edge = _argmin(rx * rx + ry * ry + absent[:, None])
    # Winding number: the signed count of edges that cross the horizontal ray from a point.
    left = ex * dy - ey * dx > 0
    from_above = dy >= 0
    to_below = points[None, :, 1] < end[:, 1, None]
    turns = (from_above & to_below & left).astype(jnp.int32) - (~from_above & ~to_below & ~left)
    return edge, jnp.sum(turns, axis=0) != 0


def crossings(s: Region, t: Region) -> tuple[Bool[Array, ""], Vector]:
    """Whether two outlines cross, and the mean of the places where they do; without gradient."""
    s, t = stop_gradient((s, t))
    cross, place = meetings(s, t)
    per_edge, count = jnp.sum(jnp.where(cross, place, 0), axis=0), jnp.sum(cross, axis=0)
    places = count[:, None] * s.points + per_edge[:, None] * (s.ends - s.points)
    total = jnp.sum(count)
    return total > 0, jnp.sum(places, axis=0) / jnp.maximum(total, 1)


def meetings(s: Region, t: Region) -> tuple[Bool[Array, "T S"], Float[Array, "T S"]]:
    """Which edges of T and S cross, and where along the edge of S (0 to 1; meaningless where they do not).

    A vertex on an edge counts to one side of it: a corner that lies on the other outline is not missed.
    """
    before, after = sides(t, s.points), sides(t, s.ends)
    start, end = sides(s, t.points), sides(s, t.ends)
    cross = ((before >= 0) != (after >= 0)) & ((start >= 0) != (end >= 0)).T
    return cross, before / jnp.where(cross, before - after, 1)


def orientation(region: Region) -> Scalar:
    """+1 where the loops run with positive shoelace area, -1 where they are mirrored."""
    return jnp.where(jnp.sum(safe.cross(*stop_gradient((region.points, region.ends)))) < 0, -1, 1)


def sides(region: Region, points: Float[Array, "n 2"]) -> Float[Array, "P n"]:
    """On which side of each edge of `region` each point lies: positive, negative or 0."""
    start, along = region.points[:, None], (region.ends - region.points)[:, None]
    return safe.cross(along, points[None] - start)


def _argmin(values: Float[Array, "n m"]) -> Int[Array, " m"]:
    """Row of the least of the non-negative values in each column; those within about 1e-5 count as equal.

    The row is kept in the last bits of the value, so that one plain minimum finds it, much faster.
    """
    rows = values.shape[0]
    low = (1 << max(rows - 1, 1).bit_length()) - 1
    bits = jax.lax.bitcast_convert_type(values.astype(jnp.float32), jnp.int32)
    return jnp.min((bits & ~low) | jnp.arange(rows, dtype=jnp.int32)[:, None], axis=0) & low
