"""Parameters of a motion and the affine transform they stand for."""

from __future__ import annotations

from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Float

Array = Any  # a JAX array inside a solve, a numpy one outside
DOF = 5
"""Degrees of freedom of one body: x and y translation, rotation, scaling along its own x and y axis."""
LARGEST = 4.0
"""Scale factors stay within exp(-LARGEST) and exp(LARGEST): nothing is shrunk to nothing."""
IDENTITY = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0)


class Bodies(NamedTuple):
    """The bodies that may move; a body carries one or more segments along. K bodies.

    Every parameter is measured in pixels of displacement at the rim of its body, so that equal parameters change the
    picture about equally.

    Attributes:
        centre: (K, 2) the point about which a body turns and scales, px.
        axis: (K,) direction of its own x axis, radians.
        radius: (K,) lever that turns radians and log-factors into pixels, px.
        free: (K, 5) 1 where a degree of freedom may move, else 0 (the motion states as a mask).
        uniform: (K,) 1 where both scale factors are one, else 0.
        inertia: (K, 5) weight of the squared parameter: among equal solutions the smaller change wins.
        sparsity: (K, 5) weight of the absolute parameter: what nobody asked for is either needed or exactly zero.
        start: (K, 5) where the solver begins.
    """

    centre: Float[Array, "K 2"]
    axis: Float[Array, " K"]
    radius: Float[Array, " K"]
    free: Float[Array, "K 5"]
    uniform: Float[Array, " K"]
    inertia: Float[Array, "K 5"]
    sparsity: Float[Array, "K 5"]
    start: Float[Array, "K 5"]


def _matrix(
    z: Float[Array, "5"],
    centre: Float[Array, "2"],
    axis: Float[Array, ""],
    radius: Float[Array, ""],
    uniform: Float[Array, ""],
) -> Float[Array, "6"]:
    turn = z[2] / radius
    log_x, log_y = jnp.clip(z[3:] / radius, -LARGEST, LARGEST)
    log_y = uniform * log_x + (1 - uniform) * log_y
    c, s = jnp.cos(axis), jnp.sin(axis)
    frame = jnp.array([[c, -s], [s, c]])
    ct, st = jnp.cos(turn), jnp.sin(turn)
    rotation = jnp.array([[ct, -st], [st, ct]])
    linear = rotation @ frame @ jnp.diag(jnp.exp(jnp.stack([log_x, log_y]))) @ frame.T
    shift = centre + z[:2] - linear @ centre
    return jnp.concatenate([linear[0], shift[:1], linear[1], shift[1:]])


def step_limits(bodies: Bodies, canvas: Float[Array, "4"]) -> Float[Array, "K 5"]:
    """The largest step that a solver takes at once in each parameter, px: half the picture, 0.6 of a body's lever."""
    reach = jnp.full((bodies.radius.shape[0], 2), 0.5 * jnp.max(canvas))
    return jnp.concatenate([reach, jnp.repeat(0.6 * bodies.radius[:, None], 3, 1)], 1)


def matrices(z: Float[Array, "K 5"], bodies: Bodies) -> Float[Array, "K 6"]:
    """Affine transform of each body, rows of `[[a, b, c], [d, e, f]]` one after the other."""
    return jax.vmap(_matrix)(z, bodies.centre, bodies.axis, bodies.radius, bodies.uniform)


def jacobians(z: Float[Array, "K 5"], bodies: Bodies) -> Float[Array, "K 6 5"]:
    """Derivative of each body's transform by its own parameters; zero for what is not free."""
    d = jax.vmap(jax.jacfwd(_matrix))(z, bodies.centre, bodies.axis, bodies.radius, bodies.uniform)
    return d * bodies.free[:, None, :]
