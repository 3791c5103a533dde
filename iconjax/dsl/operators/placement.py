"""Derived specifiers of place: how two regions lie to each other. Violations are in pixels, or in degrees."""

from __future__ import annotations

import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float

from iconjax.dsl.operators import implements, residual_of, safe
from iconjax.dsl.operators.attributes import (
    center_x,
    center_y,
    long_dir,
    max_x,
    max_y,
    min_x,
    min_y,
)
from iconjax.dsl.operators.outline import gap, sticking_out
from iconjax.dsl.operators.safe import Scalar
from iconjax.dsl.region import Region

APART = 1.5  # pixels: what is separated by less still looks as if it touched
SHARED = 1.0  # pixels: regions overlap when they reach this deep into each other


@residual_of("inside")
@implements("inside")
def inside(s: Region, t: Region) -> Scalar:
    """How far S sticks out of T: 0 when it does not, else once to twice the greatest distance."""
    return _peak(sticking_out(s.points, s.weight > 0, t))


@residual_of("contain")
@implements("contain")
def contain(s: Region, t: Region) -> Scalar:
    """How far T sticks out of S."""
    return inside(t, s)


@residual_of("touch")
def clearance(s: Region, t: Region) -> Scalar:
    """The gap between S and T, or minus how deep they lie in each other."""
    return gap(s, t).depth


@implements("touch")
def touch(s: Region, t: Region) -> Scalar:
    """The gap between S and T, or how deep they lie in each other."""
    return safe.absolute(clearance(s, t))


@residual_of("overlap")
@implements("overlap")
def overlap(s: Region, t: Region) -> Scalar:
    """How far S and T are from reaching a pixel deep into each other."""
    return safe.relu(clearance(s, t) + SHARED)


@residual_of("detach")
@implements("detach")
def detach(s: Region, t: Region) -> Scalar:
    """How far S and T are from lying visibly apart."""
    return safe.relu(APART - clearance(s, t))


@residual_of("on_top")
@implements("on_top")
def on_top(s: Region, t: Region) -> Scalar:
    """How far S reaches below the upper side of T."""
    return safe.relu(max_y(s) - min_y(t))


@residual_of("on_bottom")
@implements("on_bottom")
def on_bottom(s: Region, t: Region) -> Scalar:
    """How far S reaches above the lower side of T."""
    return safe.relu(max_y(t) - min_y(s))


@residual_of("on_left")
@implements("on_left")
def on_left(s: Region, t: Region) -> Scalar:
    """How far S reaches beyond the left side of T."""
    return safe.relu(max_x(s) - min_x(t))


@residual_of("on_right")
@implements("on_right")
def on_right(s: Region, t: Region) -> Scalar:
    """How far S reaches beyond the right side of T."""
    return safe.relu(max_x(t) - min_x(s))


@residual_of("align_x")
def offset_x(s: Region, t: Region) -> Scalar:
    """x from the centre of T's box to that of S."""
    return center_x(s) - center_x(t)


@implements("align_x")
def align_x(s: Region, t: Region) -> Scalar:
    """Horizontal distance between the box centres."""
    return safe.absolute(offset_x(s, t))


@residual_of("align_y")
def offset_y(s: Region, t: Region) -> Scalar:
    """y from the centre of T's box to that of S."""
    return center_y(s) - center_y(t)


@implements("align_y")
def align_y(s: Region, t: Region) -> Scalar:
    """Vertical distance between the box centres."""
    return safe.absolute(offset_y(s, t))


@residual_of("parallel")
def slant(s: Region, t: Region) -> Scalar:
    """Degrees from the long axis of T to that of S, -90 to 90, clockwise positive."""
    u, v = long_dir(s), long_dir(t)
    sine, cosine = safe.cross(v, u), jnp.dot(v, u)
    return safe.degrees(2 * sine * cosine, cosine**2 - sine**2) / 2


@implements("parallel")
def parallel(s: Region, t: Region) -> Scalar:
    """Angle between the long axes, 0 to 90 degrees."""
    return safe.absolute(slant(s, t))


@residual_of("perpendicular")
def slant_across(s: Region, t: Region) -> Scalar:
    """Degrees by which the long axes miss a right angle, -90 to 90."""
    u, v = long_dir(s), long_dir(t)
    sine, cosine = safe.cross(v, u), jnp.dot(v, u)
    return safe.degrees(-2 * sine * cosine, sine**2 - cosine**2) / 2


@implements("perpendicular")
def perpendicular(s: Region, t: Region) -> Scalar:
    """By how many degrees the long axes miss a right angle, 0 to 90."""
    return safe.absolute(slant_across(s, t))


def _peak(values: Float[Array, " n"]) -> Scalar:
    """A smooth maximum of non-negative values through which all of them pull: their 8-norm."""
    scale = jax.lax.stop_gradient(jnp.max(values))
    scale = jnp.where(scale > 0, scale, 1)
    total = jnp.sum((values / scale) ** 8)
    present: Bool[Array, ""] = total > 0
    return jnp.where(present, scale * jnp.where(present, total, 1) ** (1 / 8), 0)
