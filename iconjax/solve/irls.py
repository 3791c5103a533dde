"""The default solver: damped Gauss-Newton on hard primaries and robust coherence terms.

The loss of a candidate is

    hard / 2 * sum(primary^2)  +  sum_w |soft|  +  sum_i inertia_i / 2 * z_i^2 + sparsity_i * |z_i|.

Absolute values (smoothed over `eps` pixels, which shrinks from iteration to iteration) make soft terms all-or-nothing:
a joint holds exactly or is given up whole, a part that nobody asked to move either has to or stays where it was.
They are minimised by iteratively reweighted least squares. The weight of primaries is so large that no sum of soft
forces bends one by a hundredth of a pixel.
"""

from __future__ import annotations

from typing import NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Bool, Float, Int

from iconjax.solve.arrays import Candidate, Problem, Solution
from iconjax.solve.coherence import box_rows, joint_rows, one_hot_bodies
from iconjax.solve.linear import solve_positive
from iconjax.solve.pose import DOF, Array, jacobians, matrices, step_limits
from iconjax.solve.program import residuals, segment_matrices
from iconjax.solve.table import OperatorTable

HARD = 1e4
"""Weight of a squared primary residual (px) against soft forces of order 1 to 30."""
HARD_START, HARD_RATE = 0.5, 2.2
"""It begins small and grows by this factor an iteration: in a valley that is stiff at once, steps along it are tiny."""
EPS_START, EPS_END, EPS_RATE = 12.0, 0.02, 0.6
"""Smoothing of absolute values, px: first, last, factor an iteration."""
DAMPING_START, DAMPING_LOW, DAMPING_HIGH = 1e-2, 1e-6, 1e8


class System(NamedTuple):
    """A linearised loss: residuals and derivatives at one point."""

    primary: Float[Array, " C"]
    primary_slope: Float[Array, "C V"]
    soft: Float[Array, " S"]
    soft_slope: Float[Array, "S V"]
    norm: Float[Array, " S"]
    weight: Float[Array, " S"]


def linearise(problem: Problem, cand: Candidate, z: Float[Array, "K 5"], table: OperatorTable, wide: bool) -> System:
    """All residuals of a candidate at parameters `z`, with their derivatives."""
    bodies = cand.bodies
    k = z.shape[0]
    m, d = matrices(z, bodies), jacobians(z, bodies)
    segments = segment_matrices(m, cand.body)
    pick = one_hot_bodies(cand.body, k).astype(z.dtype)
    primary, by_matrix = residuals(problem.code, problem.regions, m, cand.body, table, wide)
    primary_slope = jnp.einsum("ckm,kmv->ckv", by_matrix, d).reshape(-1, k * DOF)
    joints = joint_rows(problem, cand, z, segments, d, pick)
    boxes = box_rows(problem, cand, segments, d, pick)
    value, slope, norm, weight = (jnp.concatenate(x) for x in zip(joints, boxes, strict=True))
    return System(primary, primary_slope, value, slope.reshape(-1, k * DOF), norm, weight)


def _smooth(x: Float[Array, " n"], eps: Float[Array, ""]) -> Float[Array, " n"]:
    return jnp.sqrt(x**2 + eps**2)


def loss_of(
    system: System, cand: Candidate, z: Float[Array, "K 5"], eps: Float[Array, ""], hard: Float[Array, ""]
) -> Float[Array, ""]:
    """The loss at a linearised point, absolute values smoothed over `eps` px, primaries weighted by `hard`."""
    # A vector residual has two rows that share one norm: each row carries its squared share of it.
    share = jnp.where(system.norm > 0, (system.soft / (system.norm + 1e-9)) ** 2, 0.0)
    soft = jnp.sum(system.weight * (share * (_smooth(system.norm, eps) - eps)))
    bodies = cand.bodies
    own = 0.5 * bodies.inertia * z**2 + bodies.sparsity * (_smooth(z, eps) - eps)
    return hard / 2 * jnp.sum(system.primary**2) + soft + jnp.sum(own * bodies.free)


def _step(
    system: System,
    cand: Candidate,
    z: Float[Array, "K 5"],
    eps: Float[Array, ""],
    hard: Float[Array, ""],
    damping: Float[Array, ""],
) -> Float[Array, "K 5"]:
    bodies = cand.bodies
    flat, free = z.reshape(-1), bodies.free.reshape(-1)
    pull = system.weight / _smooth(system.norm, eps)
    own = (bodies.inertia + bodies.sparsity / _smooth(z, eps)).reshape(-1) * free
    gradient = hard * system.primary @ system.primary_slope + (pull * system.soft) @ system.soft_slope + own * flat
    curvature = hard * system.primary_slope.T @ system.primary_slope
    curvature += (system.soft_slope * pull[:, None]).T @ system.soft_slope
    diagonal = jnp.diagonal(curvature) + own
    # Marquardt scaling with a floor, and a one for what is not free, so that the matrix stays positive definite.
    ridge = own + damping * (0.02 * diagonal + 1e-2) + (1.0 - free)
    step = solve_positive(curvature + jnp.diag(ridge), -gradient, DOF)
    return (step * free).reshape(z.shape)


class _State(NamedTuple):
    z: Float[Array, "K 5"]
    system: System
    trial: Float[Array, "K 5"]
    damping: Float[Array, ""]
    turn: Int[Array, ""]
    done: Bool[Array, ""]


def solve(
    problem: Problem, cand: Candidate, table: OperatorTable, *, wide: bool = False, iterations: int = 40
) -> Solution:
    """Minimise the loss of one candidate; pure, so that a batch of candidates is its `vmap`.

    Args:
        iterations: upper bound on the number of points at which the loss is linearised.
    """
    bodies = cand.bodies
    start = bodies.start * bodies.free
    most = step_limits(bodies, problem.canvas)

    def at(z: Float[Array, "K 5"]) -> System:
        return linearise(problem, cand, z, table, wide)

    def body(state: _State) -> _State:
        # One linearisation a turn: judge the trial point, then step from the better of it and the point before.
        first = state.turn == 0
        eps = jnp.maximum(EPS_END, EPS_START * EPS_RATE**state.turn)
        system = at(state.trial)
        hard = jnp.minimum(HARD, HARD_START * HARD_RATE**state.turn)
        before = loss_of(state.system, cand, state.z, eps, hard)
        after = loss_of(system, cand, state.trial, eps, hard)
        better = first | (jnp.isfinite(after) & (after <= before + 1e-9 * jnp.abs(before)))
        z = jnp.where(better, state.trial, state.z)
        system = jax.tree.map(lambda new, old: jnp.where(better, new, old), system, state.system)
        damping = state.damping * jnp.where(first, 1.0, jnp.where(better, 0.25, 6.0))
        step = jnp.clip(_step(system, cand, z, eps, hard, jnp.clip(damping, DAMPING_LOW, DAMPING_HIGH)), -most, most)
        small = jnp.max(jnp.abs(step)) < 2e-4
        flat = better & ~first & (before - after < 1e-6 * (1 + before))
        done = (eps <= EPS_END) & (hard >= HARD) & (small | flat) | (damping >= DAMPING_HIGH)
        return _State(z, system, z + step, jnp.clip(damping, DAMPING_LOW, DAMPING_HIGH), state.turn + 1, done)

    shapes = jax.eval_shape(at, start)
    nothing = jax.tree.map(lambda x: jnp.zeros(x.shape, x.dtype), shapes)
    first = _State(start, nothing, start, jnp.asarray(DAMPING_START), jnp.asarray(0), jnp.asarray(False))
    last = jax.lax.while_loop(lambda s: ~s.done & (s.turn < iterations), body, first)
    segments = segment_matrices(matrices(last.z, bodies), cand.body)[:-1]
    loss = loss_of(last.system, cand, last.z, jnp.asarray(EPS_END), jnp.asarray(HARD))
    return Solution(last.z, segments, last.system.primary, loss)
