"""Value specifiers: constraints between two values of the same unit."""

from __future__ import annotations

import jax.numpy as jnp

from iconjax.dsl.operators import implements, residual_of, safe
from iconjax.dsl.operators.safe import Scalar


@residual_of("equal")
def difference(a: Scalar, b: Scalar) -> Scalar:
    """a - b."""
    return a - b


@implements("equal")
def equal(a: Scalar, b: Scalar) -> Scalar:
    """abs(a - b)."""
    return safe.absolute(a - b)


@residual_of("equal", unit="angle")
def turn(a: Scalar, b: Scalar) -> Scalar:
    """a - b in degrees, the shorter way round: -180 to 180."""
    return a - b - 360 * jnp.round((a - b) / 360)


@implements("equal", unit="angle")
def equal_angle(a: Scalar, b: Scalar) -> Scalar:
    """How far apart two angles are, in degrees."""
    return safe.absolute(turn(a, b))


@residual_of("smaller")
@implements("smaller")
def smaller(a: Scalar, b: Scalar) -> Scalar:
    """max(0, a - b)."""
    return safe.relu(a - b)


@residual_of("larger")
@implements("larger")
def larger(a: Scalar, b: Scalar) -> Scalar:
    """max(0, b - a)."""
    return safe.relu(b - a)
