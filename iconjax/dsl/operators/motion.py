"""Derived specifiers of motion: meeting points, moving as one, keeping proportions."""

from __future__ import annotations

import jax.numpy as jnp
from jaxtyping import Array, Float

from iconjax.dsl.operators import implements, residual_of, safe
from iconjax.dsl.operators.attributes import across, extent, long_dir
from iconjax.dsl.operators.safe import Scalar, Vector
from iconjax.dsl.region import Region

Anchors = Float[Array, "4"]


@residual_of("coincide_on_point")
def separation(s: Region, t: Region, anchors: Anchors) -> Vector:
    """From where T has taken the point (u, v) to where S has taken (x, y); `anchors` is x, y, u, v."""
    return _carry(s, anchors[:2]) - _carry(t, anchors[2:])


@implements("coincide_on_point")
def coincide_on_point(s: Region, t: Region, anchors: Anchors) -> Scalar:
    """Distance between the two material points."""
    return safe.norm(separation(s, t, anchors))


@residual_of("hinge")
def hinge_separation(s: Region, t: Region, anchors: Anchors) -> Vector:
    """As for `coincide_on_point`; the meeting points are found by the compiler."""
    return separation(s, t, anchors)


@implements("hinge")
def hinge(s: Region, t: Region, anchors: Anchors) -> Scalar:
    """Distance between the two meeting points."""
    return safe.norm(separation(s, t, anchors))


@residual_of("together")
@implements("together")
def together(s: Region) -> Scalar:
    """Greatest distance of a point of the region from where its common transform takes it."""
    common = s.hull0 @ s.matrix[:, :2].T + s.matrix[:, 2]
    off = jnp.sum((s.hull - common) ** 2, axis=1)
    return safe.sqrt(jnp.max(jnp.where(s.hull_mask, off, 0)))


@residual_of("uniform")
def distortion(s: Region) -> Vector:
    """The logarithm of the ratio of the greatest to the least stretch, times the region's size, as a vector.

    A linear map is z -> p z + q conj(z) for complex p and q; the ratio is (|p| + |q|) / (|p| - |q|), and q /
    p (both brought to the pose before any rotation) vanishes smoothly where the map is uniform.
    """
    (a, b), (c, d) = s.matrix[0, :2], s.matrix[1, :2]
    p, q = jnp.stack([a + d, c - b]) / 2, jnp.stack([a - d, c + b]) / 2
    square = jnp.maximum(jnp.dot(p, p), safe.TINY)
    ratio = jnp.stack([jnp.dot(q, p), safe.cross(p, q)]) / square
    return ratio * _stretch(safe.norm(ratio)) * _size(s)


@implements("uniform")
def uniform(s: Region) -> Scalar:
    """How far the region's proportions have changed: about the difference of the two stretches, in pixels."""
    return safe.norm(distortion(s))


def _carry(region: Region, point: Vector) -> Vector:
    return region.matrix[:, :2] @ point + region.matrix[:, 2]


def _stretch(m: Scalar) -> Scalar:
    """2 artanh(m) / m, levelling off where the map is singular or mirrors (m >= 1)."""
    small = m < 1e-3
    inner = jnp.where(small, 0.5, jnp.minimum(m, 0.999))
    return jnp.where(small, 2 + 2 * m * m / 3, 2 * jnp.arctanh(inner) / jnp.where(small, 0.5, m))


def _size(region: Region) -> Scalar:
    """The longer extent before the edit."""
    before = region._replace(hull=region.hull0, matrix=jnp.eye(2, 3, dtype=region.matrix.dtype))
    direction = long_dir(before)
    return jnp.maximum(extent(before, direction), extent(before, across(direction)))
