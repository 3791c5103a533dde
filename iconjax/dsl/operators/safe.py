"""Numerics that stay finite, in value and gradient, where the textbook formula does not."""

from __future__ import annotations

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

Scalar = Float[Array, ""]
Vector = Float[Array, "2"]

TINY = 1e-12


def sqrt(square: Array) -> Array:
    """Square root with gradient 0 at 0."""
    positive = square > 0
    return jnp.where(positive, jnp.sqrt(jnp.where(positive, square, 1)), 0)


def norm(vector: Float[Array, "*n d"]) -> Float[Array, "*n"]:
    """Euclidean length along the last axis, with gradient 0 at the zero vector."""
    return sqrt(jnp.sum(vector * vector, axis=-1))


def unit(vector: Vector) -> Vector:
    """The vector at length 1; the zero vector stays."""
    length = norm(vector)
    return vector / jnp.where(length > 0, length, 1)


def divide(a: Scalar, b: Scalar) -> Scalar:
    """a / b, with b kept away from zero by a millionth."""
    near = jnp.where(b < 0, -1e-6, 1e-6)
    return a / jnp.where(jnp.abs(b) < 1e-6, near, b)


def degrees(y: Scalar, x: Scalar) -> Scalar:
    """The angle of (x, y) in degrees, -180 to 180; 0 with gradient 0 for the zero vector."""
    zero = (jnp.abs(x) + jnp.abs(y)) < TINY
    return jnp.rad2deg(jnp.arctan2(jnp.where(zero, 0, y), jnp.where(zero, 1, x)))


def absolute(value: Array) -> Array:
    """abs with gradient +1 at 0, so that a value at its kink can still be moved."""
    return jnp.where(value >= 0, value, -value)


def relu(value: Array) -> Array:
    """max(0, value) with gradient 0 at 0."""
    return jnp.where(value > 0, value, 0)


def cross(a: Float[Array, "*n 2"], b: Float[Array, "*n 2"]) -> Float[Array, "*n"]:
    """a.x b.y - a.y b.x: positive when b lies clockwise of a on screen."""
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def ties(values: Float[Array, " n"], largest: bool = False, width: float = 0.25) -> Scalar:
    """The least (or largest) of `values`, exactly; its gradient is shared by all within about `width` of it.

    A flat side that comes to rest on another has many nearest points: pulling at one of them would turn it.
    """
    sign = -1 if largest else 1
    fixed = jax.lax.stop_gradient(values)
    best = jnp.min(sign * fixed)
    share = jnp.exp(jnp.maximum((best - sign * fixed) / width, -60))
    share = share / jnp.sum(share)
    # The zero keeps the value exact and carries the gradient.
    return sign * best + jnp.sum(share * (values - fixed))
