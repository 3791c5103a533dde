"""Solvers of jaxopt and optimistix on a candidate's loss, from blunt to sharp in a few stages."""

from __future__ import annotations

import warnings
from typing import Any

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from iconjax.solve import irls
from iconjax.solve.linear import solve_positive
from iconjax.solve.objective import Coherent, Flat, Level, Objective, scalar, vector
from iconjax.solve.pose import DOF

STAGES = 4
"""Each stage starts where the one before ended; smoothing falls, and the weight of primaries grows, by equal
factors."""
STEPS = 40
"""Most iterations of a stage."""


def levels(staged: bool = True) -> Level:
    """The levels of all stages, both attributes (STAGES,); one level where the loss has no more."""
    if not staged:
        return Level(jnp.ones(1), jnp.ones(1))
    share = jnp.linspace(0.0, 1.0, STAGES)
    return Level(
        irls.EPS_START * (irls.EPS_END / irls.EPS_START) ** share,
        irls.HARD_START * (irls.HARD / irls.HARD_START) ** share,
    )


def _staged(solve_stage: Any, objective: Objective) -> Flat:
    def stage(z: Flat, level: Level) -> tuple[Flat, None]:
        found = solve_stage(z, level)
        return jnp.where(jnp.isfinite(found).all(), found, z), None

    return jax.lax.scan(stage, objective.start, levels(objective.staged))[0]


def _jaxopt() -> Any:
    """jaxopt warns whoever imports it that it gets no new features."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        import jaxopt
    return jaxopt


def lbfgs(objective: Objective) -> Flat:
    """`jaxopt.LBFGS` with a backtracking line search."""
    jaxopt = _jaxopt()

    def loss(z: Flat, level: Level) -> tuple[tuple[Float[Array, ""], None], Flat]:
        value, slope = objective.value_and_slope(z, level)
        return (value / level.hard, None), slope / level.hard

    def stage(z: Flat, level: Level) -> Flat:
        # Unrolled loops branch on each candidate's progress; in a batch every operator runs for every leaf.
        # With a loose curvature condition the line search does not shrink on until it fails.
        both = {"value_and_grad": True, "has_aux": True, "unroll": False}
        search = jaxopt.BacktrackingLineSearch(
            loss, condition="wolfe", c2=0.999, decrease_factor=0.4, maxiter=12, **both
        )
        solver = jaxopt.LBFGS(
            loss,
            maxiter=STEPS,
            tol=1e-6,
            linesearch=search,
            linesearch_init="max",
            history_size=12,
            implicit_diff=False,
            **both,
        )
        return solver.run(z, level).params  # type: ignore[no-any-return]

    return _staged(stage, objective)


def bfgs(objective: Objective) -> Flat:
    """`optimistix.BFGS`."""
    import optimistix

    loss = scalar(objective)

    def stage(z: Flat, level: Level) -> Flat:
        solver: Any = optimistix.BFGS(rtol=1e-9, atol=1e-9)
        return optimistix.minimise(loss, solver, z, args=level, max_steps=3 * STEPS, throw=False).value

    return _staged(stage, objective)


def lm(objective: Objective) -> Flat:
    """`optimistix.LevenbergMarquardt`, with normal equations solved by elimination (see `linear`)."""
    import optimistix

    assert isinstance(objective, Coherent)  # the only loss that is a sum of squares

    residuals = vector(objective)

    def stage(z: Flat, level: Level) -> Flat:
        solver: Any = optimistix.LevenbergMarquardt(rtol=1e-8, atol=1e-8, linear_solver=_elimination())
        return optimistix.least_squares(residuals, solver, z, args=level, max_steps=STEPS, throw=False).value

    return _staged(stage, objective)


def _elimination() -> Any:
    """A lineax solver for least squares that needs no LAPACK call."""
    import lineax  # type: ignore[import-untyped]
    from jax.flatten_util import ravel_pytree

    class Elimination(lineax.AbstractLinearSolver):  # type: ignore[misc]
        def init(self, operator: Any, options: Any) -> Float[Array, "M V"]:
            matrix: Float[Array, "M V"] = operator.as_matrix()
            return matrix

        def compute(self, state: Float[Array, "M V"], vector: Any, options: Any) -> Any:
            right = ravel_pytree(vector)[0]
            normal = state.T @ state
            # A parameter that nothing depends on has an empty row.
            idle = jnp.where(jnp.diagonal(normal) > 0, 1e-14 * jnp.trace(normal), 1.0)
            solution = solve_positive(normal + jnp.diag(idle), state.T @ right, DOF)
            return solution, lineax.RESULTS.successful, {}

        def transpose(self, state: Any, options: Any) -> Any:
            raise NotImplementedError

        def conj(self, state: Any, options: Any) -> Any:
            return state, options

        def assume_full_rank(self) -> bool:
            return True

    return Elimination()
