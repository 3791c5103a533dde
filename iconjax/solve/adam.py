"""Adam with a decaying step, the paper's optimiser."""

from __future__ import annotations

from typing import NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

from iconjax.solve import irls
from iconjax.solve.objective import SHARP, Flat, Level, Objective

RATE_START, RATE_END = 10.0, 0.02
"""Step in pixels of 512: the paper's first one, and where the decay ends (the paper only says that it falls)."""
MEAN, SQUARE, TINY = 0.9, 0.999, 1e-8


class _State(NamedTuple):
    z: Flat
    mean: Flat
    square: Flat
    best: Flat
    least: Float[Array, ""]
    turn: Int[Array, ""]


def blunt_to_sharp(done: Float[Array, ""]) -> Level:
    """The level of the default strategy's loss after a share of the steps; the last third is sharpest."""
    share = jnp.minimum(1.5 * done, 1.0)
    eps = irls.EPS_START * (irls.EPS_END / irls.EPS_START) ** share
    hard = irls.HARD_START * (irls.HARD / irls.HARD_START) ** share
    return Level(eps, hard)


def minimise(objective: Objective, iterations: int) -> Flat:
    """Run Adam for `iterations` steps at most; the best point that it saw at the sharpest level."""

    def level_at(count: Int[Array, ""]) -> Level:
        return blunt_to_sharp(count / iterations) if objective.staged else Level(*map(jnp.asarray, SHARP))

    def body(state: _State) -> _State:
        count = state.turn + 1
        level = level_at(state.turn)
        value, slope = objective.value_and_slope(state.z, level)
        slope = jnp.where(jnp.isfinite(slope), slope, 0.0)
        better = (level.hard >= irls.HARD * (1 - 1e-9)) & (value < state.least)
        mean = MEAN * state.mean + (1 - MEAN) * slope
        square = SQUARE * state.square + (1 - SQUARE) * slope**2
        rate = objective.unit * RATE_START * (RATE_END / RATE_START) ** (state.turn / iterations)
        step = rate * (mean / (1 - MEAN**count)) / (jnp.sqrt(square / (1 - SQUARE**count)) + TINY)
        return _State(
            state.z - jnp.clip(step, -objective.most, objective.most) * objective.free,
            mean,
            square,
            jnp.where(better, state.z, state.best),
            jnp.where(better, value, state.least),
            count,
        )

    zero = jnp.zeros_like(objective.start)
    first = _State(objective.start, zero, zero, objective.start, jnp.asarray(jnp.inf), jnp.asarray(0))
    last = jax.lax.while_loop(
        lambda s: (s.turn < iterations) & (s.least > objective.good * objective.unit), body, first
    )
    return last.best
