"""The same loss minimised one candidate at a time, as one would without this engine.

"Eager" is JAX under `jax.disable_jit()`: every operation is dispatched by itself. (Without it, un-jitted code still
compiles each loop and switch anew on every call, which is slower by far.) "Jitted" is one compiled function for value
and slope, called from a Python loop. All use the value and slope of `iconjax.solve.objective.Coherent`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Float
from scipy.optimize import minimize

from iconjax.search.setup import Setup
from iconjax.solve.adam import MEAN, RATE_END, RATE_START, SQUARE, TINY, blunt_to_sharp
from iconjax.solve.arrays import Candidate
from iconjax.solve.cache import OPTIONS
from iconjax.solve.library import STEPS, levels
from iconjax.solve.methods import ITERATIONS
from iconjax.solve.objective import Coherent, Level

Vector = Float[np.ndarray, " v"]
ValueAndSlope = Callable[[Candidate, Any, Level], tuple[Any, Any]]


@dataclass(frozen=True)
class Loss:
    """Value and slope of a candidate's loss, and the seconds it took to compile them (0 where eager)."""

    call: ValueAndSlope
    compile_seconds: float


def eager_loss(setup: Setup) -> Loss:
    """Call inside `jax.disable_jit()`."""

    def call(cand: Candidate, z: Any, level: Level) -> tuple[Any, Any]:
        return Coherent(setup.problem, cand, setup.table, setup.compiled.wide).value_and_slope(z, level)

    return Loss(call, 0.0)


def jitted_loss(setup: Setup, cand: Candidate) -> Loss:
    """Compiled for the shapes of `cand`, with the options that the engine uses."""

    def function(problem: Any, cand: Candidate, z: Any, eps: Any, hard: Any) -> tuple[Any, Any]:
        return Coherent(problem, cand, setup.table, setup.compiled.wide).value_and_slope(z, Level(eps, hard))

    number = np.float64(1.0)
    begin = perf_counter()
    lowered = jax.jit(function).lower(setup.problem, cand, np.zeros(cand.bodies.free.size), number, number)
    executable = lowered.compile(compiler_options=OPTIONS)
    seconds = perf_counter() - begin

    def call(cand: Candidate, z: Any, level: Level) -> tuple[Any, Any]:
        return executable(setup.problem, cand, np.asarray(z), np.float64(level.eps), np.float64(level.hard))

    return Loss(call, seconds)


def adam_steps(loss: Loss, cand: Candidate, steps: int) -> float:
    """Seconds for the first `steps` of the `ITERATIONS` steps that Adam takes for one candidate."""
    z = jnp.asarray(cand.bodies.start.reshape(-1))
    mean, square = jnp.zeros_like(z), jnp.zeros_like(z)
    begin = perf_counter()
    for turn in range(steps):
        level = blunt_to_sharp(jnp.asarray(turn / ITERATIONS))
        _, slope = loss.call(cand, z, level)
        mean = MEAN * mean + (1 - MEAN) * slope
        square = SQUARE * square + (1 - SQUARE) * slope**2
        rate = RATE_START * (RATE_END / RATE_START) ** (turn / ITERATIONS)
        z = z - rate * (mean / (1 - MEAN ** (turn + 1))) / (jnp.sqrt(square / (1 - SQUARE ** (turn + 1))) + TINY)
    z.block_until_ready()
    return perf_counter() - begin


def lbfgsb(loss: Loss, cand: Candidate) -> tuple[Vector, int, float]:
    """SciPy's L-BFGS-B from blunt to sharp, as `iconjax.solve.library` stages it: point, evaluations, seconds."""
    free = cand.bodies.free.reshape(-1) > 0
    z = cand.bodies.start.reshape(-1) * free
    evaluations = 0
    staged = levels()
    begin = perf_counter()
    for eps, hard in zip(np.asarray(staged.eps), np.asarray(staged.hard), strict=True):

        def fun(part: Vector, level: Level = Level(float(eps), float(hard))) -> tuple[float, Vector]:  # noqa: B008
            whole = np.zeros(free.shape)
            whole[free] = part
            value, slope = loss.call(cand, whole, level)
            return float(value) / level.hard, np.asarray(slope)[free] / level.hard

        found = minimize(fun, z[free], jac=True, method="L-BFGS-B", options={"maxiter": STEPS, "ftol": 0, "gtol": 1e-6})
        z[free] = found.x
        evaluations += found.nfev
    return z, evaluations, perf_counter() - begin
