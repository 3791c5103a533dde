"""Attributes of one region in its current pose: its box, its axes, and how it has turned and stretched."""

from __future__ import annotations

import jax.numpy as jnp
from jaxtyping import Array, Float

from iconjax.dsl.operators import implements, safe
from iconjax.dsl.operators.safe import Scalar, Vector
from iconjax.dsl.region import Region


def least(region: Region, values: Float[Array, " Q"]) -> Scalar:
    """The least of the values that belong to support points of the region; of all if it has none."""
    mask = region.hull_mask | ~jnp.any(region.hull_mask)
    return jnp.min(jnp.where(mask, values, jnp.inf))


def greatest(region: Region, values: Float[Array, " Q"]) -> Scalar:
    """The greatest of the values that belong to support points of the region."""
    return -least(region, -values)


def extent(region: Region, direction: Vector) -> Scalar:
    """How far the region reaches along a unit vector, from one end to the other."""
    along = region.hull @ direction
    return greatest(region, along) - least(region, along)


def across(direction: Vector) -> Vector:
    """The direction a quarter turn clockwise on screen."""
    return jnp.stack([-direction[1], direction[0]])


def carried(region: Region, direction: Vector) -> Vector:
    """A direction of the material before the edit, where the edit has taken it; not normalised."""
    return region.matrix[:, :2] @ direction


def long_dir(region: Region) -> Vector:
    """Unit vector of the principal axis, carried along by the edit."""
    return safe.unit(carried(region, region.long_dir0))


def short_dir(region: Region) -> Vector:
    """Unit vector across the principal axis before the edit, carried along by the edit."""
    return safe.unit(carried(region, across(region.long_dir0)))


@implements("min_x")
def min_x(s: Region) -> Scalar:
    """x of the left side of the box."""
    return least(s, s.hull[:, 0])


@implements("max_x")
def max_x(s: Region) -> Scalar:
    """x of the right side of the box."""
    return greatest(s, s.hull[:, 0])


@implements("min_y")
def min_y(s: Region) -> Scalar:
    """y of the upper side of the box."""
    return least(s, s.hull[:, 1])


@implements("max_y")
def max_y(s: Region) -> Scalar:
    """y of the lower side of the box."""
    return greatest(s, s.hull[:, 1])


@implements("hori_len")
def hori_len(s: Region) -> Scalar:
    """Width of the box."""
    return max_x(s) - min_x(s)


@implements("vert_len")
def vert_len(s: Region) -> Scalar:
    """Height of the box."""
    return max_y(s) - min_y(s)


@implements("center_x")
def center_x(s: Region) -> Scalar:
    """x of the centre of the box."""
    return (min_x(s) + max_x(s)) / 2


@implements("center_y")
def center_y(s: Region) -> Scalar:
    """y of the centre of the box."""
    return (min_y(s) + max_y(s)) / 2


@implements("long_dir_x")
def long_dir_x(s: Region) -> Scalar:
    """x of the principal direction."""
    return long_dir(s)[0]


@implements("long_dir_y")
def long_dir_y(s: Region) -> Scalar:
    """y of the principal direction."""
    return long_dir(s)[1]


@implements("short_dir_x")
def short_dir_x(s: Region) -> Scalar:
    """x of the direction across."""
    return short_dir(s)[0]


@implements("short_dir_y")
def short_dir_y(s: Region) -> Scalar:
    """y of the direction across."""
    return short_dir(s)[1]


@implements("long_len")
def long_len(s: Region) -> Scalar:
    """Extent along the principal direction."""
    return extent(s, long_dir(s))


@implements("short_len")
def short_len(s: Region) -> Scalar:
    """Extent across the principal direction (at right angles to where that points now)."""
    return extent(s, across(long_dir(s)))


@implements("rotation")
def rotation(s: Region) -> Scalar:
    """Degrees turned since before the edit, clockwise positive: the rotation nearest to the transform."""
    (a, b), (c, d) = s.matrix[0, :2], s.matrix[1, :2]
    return safe.degrees(c - b, a + d)


@implements("scale_x")
def scale_x(s: Region) -> Scalar:
    """Stretch along the region's own x axis."""
    return safe.norm(carried(s, s.frame0))


@implements("scale_y")
def scale_y(s: Region) -> Scalar:
    """Stretch along the region's own y axis."""
    return safe.norm(carried(s, across(s.frame0)))
