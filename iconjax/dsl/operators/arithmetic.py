"""Arithmetic on values; `min` and `max` of more than two are folded by the compiler."""

from __future__ import annotations

import jax.numpy as jnp

from iconjax.dsl.operators import implements, safe
from iconjax.dsl.operators.safe import Scalar


@implements("plus")
def plus(a: Scalar, b: Scalar) -> Scalar:
    """a + b."""
    return a + b


@implements("minus")
def minus(a: Scalar, b: Scalar) -> Scalar:
    """a - b."""
    return a - b


@implements("mul")
def mul(a: Scalar, b: Scalar) -> Scalar:
    """a b."""
    return a * b


@implements("div")
def div(a: Scalar, b: Scalar) -> Scalar:
    """a / b, finite everywhere."""
    return safe.divide(a, b)


@implements("min")
def least(a: Scalar, b: Scalar) -> Scalar:
    """The lesser of two values."""
    return jnp.minimum(a, b)


@implements("max")
def greatest(a: Scalar, b: Scalar) -> Scalar:
    """The greater of two values."""
    return jnp.maximum(a, b)
