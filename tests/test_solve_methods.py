"""Registered solvers: they agree with each other, and their slopes with finite differences."""

from __future__ import annotations

import jax
import numpy as np
import pytest
import solve_support as support

from iconjax.errors import ConfigError
from iconjax.search.candidate import build_candidate
from iconjax.search.starts import initial_states
from iconjax.solve.cache import precise_cpu
from iconjax.solve.engine import Engine
from iconjax.solve.methods import FOR_MEAN_VIOLATION, METHODS, method
from iconjax.solve.objective import Coherent, Level, scalar, vector


@pytest.fixture(scope="module")
def setup():
    with support.quick_compiles():
        yield support.prepared()


@pytest.fixture(scope="module")
def candidates(setup):
    return [build_candidate(setup.setting, s, setup.sizes) for s in initial_states(setup.setting)[:2]]


@pytest.fixture(scope="module")
def solved(setup, candidates):
    """Name of a method -> its solution of the candidates."""
    found = {}

    def solve(name):
        if name not in found:
            engine = Engine(setup.problem, setup.table, setup.compiled.wide, name, batch=2)
            found[name] = engine.solve(candidates)
        return found[name]

    return solve


@pytest.mark.parametrize("name", METHODS)
def test_every_method_meets_the_request_as_cheaply_as_the_default(name, solved):
    solution, reference = solved(name), solved("irls")
    assert np.abs(solution.primary).max() < 0.4
    np.testing.assert_allclose(solution.loss, reference.loss, rtol=0.02, atol=0.05)
    assert np.isfinite(solution.matrices).all()


def test_unknown_methods_are_refused():
    with pytest.raises(ConfigError, match=r"unknown solver 'newton'.*irls"):
        method("newton")
    with pytest.raises(ConfigError, match=r"this strategy cannot use solver 'irls'.*adam"):
        method("irls", FOR_MEAN_VIOLATION)


def test_slopes_agree_with_finite_differences(setup, candidates):
    level = Level(1.5, 40.0)

    def everything(problem, cand, z):
        objective = Coherent(problem, cand, setup.table, setup.compiled.wide)
        loss, rows = scalar(objective), vector(objective)
        value, slope = objective.value_and_slope(z, level)
        by_jax = jax.grad(loss)(z, level)
        r, forward = rows(z, level), jax.jacfwd(rows)(z, level)
        return value, slope, by_jax, r, forward

    with precise_cpu():
        run = jax.jit(everything, compiler_options=support.QUICK)
        cand = candidates[-1]
        free = np.asarray(cand.bodies.free).reshape(-1)
        z = np.random.default_rng(7).normal(0, 4, free.size) * free
        value, slope, by_jax, rows, forward = map(np.asarray, run(setup.problem, cand, z))
        np.testing.assert_allclose(by_jax * level.hard, slope, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(level.hard * (rows @ rows) / 2, value, rtol=1e-6)
        np.testing.assert_allclose(level.hard * (rows @ forward), slope, rtol=1e-6, atol=1e-6)
        step = 1e-5
        slope, forward = np.asarray(slope), np.asarray(forward)
        for k in np.flatnonzero(free):
            ahead, behind = (run(setup.problem, cand, z + s * step * np.eye(free.size)[k]) for s in (1, -1))
            by_value, by_rows = ((np.asarray(ahead[i]) - behind[i]) / (2 * step) for i in (0, 3))
            np.testing.assert_allclose(slope[k], by_value, rtol=1e-4, atol=1e-3)
            np.testing.assert_allclose(forward[:, k], by_rows, rtol=1e-3, atol=1e-4)


def test_a_solver_keeps_its_start_where_nothing_is_free(setup, candidates, solved):
    still = candidates[0]._replace(bodies=candidates[0].bodies._replace(free=np.zeros_like(candidates[0].bodies.free)))
    engine = Engine(setup.problem, setup.table, setup.compiled.wide, "adam", batch=2)
    solved("adam")
    found = engine.solve([still])
    assert engine.compile_seconds == 0
    np.testing.assert_array_equal(found.matrices[0, :3], np.tile([1.0, 0, 0, 0, 1, 0], (3, 1)))
