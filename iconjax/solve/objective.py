"""What every method minimises: a loss of a flat parameter vector, with its exact slope.

`linearise` and `residuals` compute derivatives by hand, forward and cheap. A library solver wants to
differentiate a function itself: `scalar` and `vector` give it functions whose derivative is the one at hand.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, Protocol

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from iconjax.solve import irls
from iconjax.solve.arrays import Candidate, Problem, Solution
from iconjax.solve.pose import matrices, step_limits
from iconjax.solve.program import segment_matrices
from iconjax.solve.table import OperatorTable

Flat = Float[Array, " V"]
Number = Float[Array, ""] | float


class Level(NamedTuple):
    """How sharp a loss is: it is minimised from a blunt level to the sharpest one.

    Attributes:
        eps: absolute values are smoothed over this many pixels.
        hard: weight of a squared primary residual.
    """

    eps: Number
    hard: Number


SHARP = Level(irls.EPS_END, irls.HARD)


class Objective(Protocol):
    """One candidate's loss. V = 5 K parameters in pixels, body after body.

    Attributes:
        start: (V,) where to begin.
        free: (V,) 1 where a parameter may move.
        most: (V,) longest sensible step.
        unit: a pixel of a picture of 512 x 512, in pixels of this one.
        staged: whether the loss has levels of sharpness.
        good: a loss, in such units, that is low enough to stop at.
    """

    staged: bool
    good: float

    @property
    def start(self) -> Flat: ...
    @property
    def free(self) -> Flat: ...
    @property
    def most(self) -> Flat: ...
    @property
    def unit(self) -> Float[Array, ""]: ...

    def value_and_slope(self, z: Flat, level: Level) -> tuple[Float[Array, ""], Flat]:
        """The loss and its derivative."""

    def solution(self, z: Flat) -> Solution:
        """What the parameters amount to."""


class Coherent:
    """The default strategy's loss (`irls.loss_of`) of one candidate."""

    staged = True
    good = -1.0

    def __init__(self, problem: Problem, cand: Candidate, table: OperatorTable, wide: bool) -> None:
        self.problem, self.cand, self.table, self.wide = problem, cand, table, wide
        bodies = cand.bodies
        self.free = bodies.free.reshape(-1)
        self.start = bodies.start.reshape(-1) * self.free
        self.unit = jnp.max(problem.canvas) / 512
        self.most = step_limits(bodies, problem.canvas).reshape(-1)
        self.pairs = 6 * problem.joints.a.shape[0]  # rows of joints come in twos, one vector each

    def _at(self, z: Flat) -> tuple[Float[Array, "K 5"], irls.System]:
        own = z.reshape(self.cand.bodies.free.shape)
        return own, irls.linearise(self.problem, self.cand, own, self.table, self.wide)

    def value_and_slope(self, z: Flat, level: Level) -> tuple[Float[Array, ""], Flat]:
        """The loss and its derivative."""
        own, system = self._at(z)
        bodies, (eps, hard) = self.cand.bodies, level
        pull = system.weight / jnp.sqrt(system.norm**2 + eps**2)
        slope = hard * system.primary @ system.primary_slope + (pull * system.soft) @ system.soft_slope
        idle = bodies.inertia + bodies.sparsity / jnp.sqrt(own**2 + eps**2)
        slope = (slope + (idle * own).reshape(-1)) * self.free
        return irls.loss_of(system, self.cand, own, jnp.asarray(eps), jnp.asarray(hard)), slope

    def rows(self, z: Flat, level: Level) -> tuple[Float[Array, " M"], Float[Array, "M V"]]:
        """Rows r with `loss = sum(r^2) / 2`, and their derivatives.

        The smoothed length s - eps of a vector x, with s^2 = |x|^2 + eps^2, is |x|^2 / (s + eps): each of its
        components is a row once it is multiplied by sqrt(2 w / (s + eps)).
        """
        own, system = self._at(z)
        eps, hard = level.eps, jnp.sqrt(level.hard)
        long = jnp.sqrt(system.norm**2 + eps**2)
        factor = jnp.sqrt(2 * system.weight / (long + eps))
        # d factor / d x = -factor / (2 s (s + eps)) x, along the vector that the row is a component of.
        along = self._by_vector(system.soft[:, None] * system.soft_slope)
        bend = factor * system.soft / (2 * long * (long + eps))
        soft_slope = factor[:, None] * system.soft_slope - bend[:, None] * along
        bodies = self.cand.bodies
        size = jnp.sqrt(own**2 + eps**2)
        idle = jnp.sqrt(2 * bodies.sparsity / (size + eps))
        idle_slope = idle * (1 - own**2 / (2 * size * (size + eps)))
        still = jnp.sqrt(bodies.inertia)
        motion = [(x * own).reshape(-1) * self.free for x in (idle, still)]
        motion_slope = [jnp.diag(x.reshape(-1)) for x in (idle_slope, still)]
        rows = [hard * system.primary, factor * system.soft, *motion]
        slopes = [hard * system.primary_slope, soft_slope, *motion_slope]
        return jnp.concatenate(rows), jnp.concatenate(slopes) * self.free

    def _by_vector(self, x: Float[Array, "S V"]) -> Float[Array, "S V"]:
        """Sums over the components of each vector, given to each component."""
        joints = x[: self.pairs].reshape(-1, 2, x.shape[1])
        joints = jnp.repeat(joints.sum(1), 2, axis=0)
        return jnp.concatenate([joints, x[self.pairs :]])

    def solution(self, z: Flat) -> Solution:
        """Transforms, residuals and the loss at the least smoothing, as `irls.solve` reports them."""
        own, system = self._at(z)
        segments = segment_matrices(matrices(own, self.cand.bodies), self.cand.body)[:-1]
        loss = irls.loss_of(system, self.cand, own, *map(jnp.asarray, SHARP))
        return Solution(own, segments, system.primary, loss)


def scalar(objective: Objective) -> Callable[[Flat, Any], Float[Array, ""]]:
    """The loss over `hard` as a function `(z, level) -> ()` that JAX differentiates exactly, either way."""

    @jax.custom_jvp
    def loss(z: Flat, level: Level) -> Float[Array, ""]:
        return objective.value_and_slope(z, level)[0] / level.hard

    @loss.defjvp
    def _loss_slope(primals, tangents):  # type: ignore[no-untyped-def]
        value, slope = objective.value_and_slope(*primals)
        hard = primals[1].hard
        return value / hard, slope @ tangents[0] / hard

    return loss


def vector(objective: Coherent) -> Callable[[Flat, Any], Float[Array, " M"]]:
    """Rows whose squares sum to twice the loss over `hard`: a function `(z, level) -> (M,)` like `scalar`."""

    @jax.custom_jvp
    def rows(z: Flat, level: Level) -> Float[Array, " M"]:
        return objective.rows(z, level)[0] / jnp.sqrt(level.hard)

    @rows.defjvp
    def _rows_slope(primals, tangents):  # type: ignore[no-untyped-def]
        value, slope = objective.rows(*primals)
        root = jnp.sqrt(primals[1].hard)
        return value / root, slope @ tangents[0] / root

    return rows
