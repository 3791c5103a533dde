"""The paper's loss: the mean violation of all constraints switched on, primary and secondary alike."""

from __future__ import annotations

from typing import NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

from iconjax.solve.arrays import Code, Regions, Solution
from iconjax.solve.coherence import one_hot_bodies, point_slope
from iconjax.solve.objective import Flat, Level
from iconjax.solve.pose import Bodies, jacobians, matrices, step_limits
from iconjax.solve.program import move, residuals, segment_matrices
from iconjax.solve.table import OperatorTable


class Violations(NamedTuple):
    """What all candidates share: the constraints of one program, primary and secondary, and where E relations
    meet. There are G constraints: those of the program first, then one for each relation.

    Attributes:
        code, regions: the program.
        owner: (C,) constraint that each residual of the program belongs to; G for padding.
        a, b: (E,) segments of each relation.
        meeting: (E, 2) the place where the two meet, as material of both, px. `coincide_on_point` of it is
            computed directly: by way of the program, it would differentiate whole outlines.
        allowed: (G,) violation that does not count, px: how far the constraint was violated before the edit.
        canvas: (4,) extent of the picture.
    """

    code: Code
    regions: Regions
    owner: Int[Array, " C"]
    a: Int[Array, " E"]
    b: Int[Array, " E"]
    meeting: Float[Array, "E 2"]
    allowed: Float[Array, " G"]
    canvas: Float[Array, " 4"]


class Choice(NamedTuple):
    """One setting of the discrete states.

    Attributes:
        body: (N,) the body that carries each segment: its own; K for padding.
        bodies: the bodies; motion states are the mask `bodies.free`.
        active: (G,) 1 where a constraint is switched on, else 0.
    """

    body: Int[Array, " N"]
    bodies: Bodies
    active: Float[Array, " G"]


class MeanViolation:
    """The loss of one candidate. The level of sharpness changes nothing: absolute values stay as they are."""

    staged = False
    good = 5e-3

    def __init__(self, problem: Violations, cand: Choice, table: OperatorTable, wide: bool) -> None:
        self.problem, self.cand, self.table, self.wide = problem, cand, table, wide
        bodies = cand.bodies
        self.free = bodies.free.reshape(-1)
        self.start = bodies.start.reshape(-1) * self.free
        self.unit = jnp.max(problem.canvas) / 512
        self.most = step_limits(bodies, problem.canvas).reshape(-1)
        rows = jnp.repeat(problem.allowed.shape[0] - problem.a.shape[0] + jnp.arange(problem.a.shape[0]), 2)
        owner = jnp.concatenate([problem.owner, rows])
        self.owner = jax.nn.one_hot(owner, problem.allowed.shape[0], dtype=self.start.dtype).T  # G C+2E

    def _residuals(self, z: Flat) -> tuple[Float[Array, " C2"], Float[Array, "C2 V"], Float[Array, "N1 6"]]:
        """Residuals of the program, then two for each relation; derivatives; the segments' transforms."""
        bodies, problem = self.cand.bodies, self.problem
        own = z.reshape(bodies.free.shape)
        m, d = matrices(own, bodies), jacobians(own, bodies)
        value, by_matrix = residuals(problem.code, problem.regions, m, self.cand.body, self.table, self.wide)
        slope = jnp.einsum("ckm,kmv->ckv", by_matrix, d)
        segments = segment_matrices(m, self.cand.body)
        apart = move(problem.meeting, segments[problem.a]) - move(problem.meeting, segments[problem.b])
        by_segment = point_slope(problem.meeting[:, None], d)  # E K 2 5
        pick = one_hot_bodies(self.cand.body, m.shape[0]).astype(z.dtype)
        sides = pick[problem.a] - pick[problem.b]  # E K
        apart_slope = jnp.einsum("ek,ekiv->eikv", sides, by_segment)
        value = jnp.concatenate([value, apart.reshape(-1)])
        slopes = jnp.concatenate([slope, apart_slope.reshape(-1, *slope.shape[1:])])
        return value, slopes.reshape(value.shape[0], -1), segments

    def value_and_slope(self, z: Flat, level: Level) -> tuple[Float[Array, ""], Flat]:
        """The loss and its derivative."""
        value, slope, _ = self._residuals(z)
        total, weight = self._total(value)
        return total, weight @ slope

    def _total(self, value: Float[Array, " C2"]) -> tuple[Float[Array, ""], Float[Array, " C2"]]:
        """Mean violation, and its derivative by the residuals."""
        size = jnp.sqrt(self.owner @ value**2 + 1e-18)
        excess = size - 1e-9 - self.problem.allowed
        counts = jnp.maximum(self.cand.active.sum(), 1.0)
        total = jnp.sum(self.cand.active * jnp.maximum(excess, 0.0)) / counts
        return total, self.owner.T @ (self.cand.active * (excess > 0) / size / counts) * value

    def solution(self, z: Flat) -> Solution:
        """Transforms, residuals of all constraints (switched on or not), and the loss."""
        value, _, segments = self._residuals(z)
        return Solution(z.reshape(self.cand.bodies.free.shape), segments[:-1], value, self._total(value)[0])
