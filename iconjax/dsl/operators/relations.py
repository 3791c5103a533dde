"""Values of two regions: distances between their outlines, and the angle between them."""

from __future__ import annotations

import jax.numpy as jnp
from jax.lax import stop_gradient
from jaxtyping import Array, Float

from iconjax.dsl.operators import implements, safe
from iconjax.dsl.operators.attributes import center_x, center_y, long_dir
from iconjax.dsl.operators.outline import gap, signed_distances
from iconjax.dsl.operators.safe import Scalar
from iconjax.dsl.region import Region


@implements("min_dist")
def min_dist(s: Region, t: Region) -> Scalar:
    """Least distance between the outlines; 0 where they cross, with the gradient that takes them apart."""
    found = gap(s, t)
    return jnp.where(found.crossing, found.depth - stop_gradient(found.depth), found.least)


@implements("max_dist")
def max_dist(s: Region, t: Region) -> Scalar:
    """Greatest distance from an outline to the other (Hausdorff distance)."""
    far = jnp.concatenate([_to_outline(s, t), _to_outline(t, s)])
    return safe.ties(jnp.where(jnp.concatenate([s.weight, t.weight]) > 0, far, 0), largest=True)


@implements("avg_dist")
def avg_dist(s: Region, t: Region) -> Scalar:
    """Mean distance from an outline to the other, by length, averaged over both ways."""
    return (jnp.sum(s.weight * _to_outline(s, t)) + jnp.sum(t.weight * _to_outline(t, s))) / 2


@implements("dist_x")
def dist_x(s: Region, t: Region) -> Scalar:
    """Horizontal distance between the box centres."""
    return safe.absolute(center_x(s) - center_x(t))


@implements("dist_y")
def dist_y(s: Region, t: Region) -> Scalar:
    """Vertical distance between the box centres."""
    return safe.absolute(center_y(s) - center_y(t))


@implements("angle")
def angle(s: Region, t: Region) -> Scalar:
    """Unsigned angle between the long directions, 0 to 180 degrees; at 0 its gradient turns S clockwise."""
    u, v = long_dir(s), long_dir(t)
    return safe.absolute(safe.degrees(safe.cross(v, u), jnp.dot(v, u)))


def _to_outline(s: Region, t: Region) -> Float[Array, " P"]:
    """Distance of each outline vertex of S to the outline of T."""
    return safe.absolute(signed_distances(s.points, t))
