"""A guess helps the search and never stands in for a constraint."""

from __future__ import annotations

import numpy as np
import pytest
from engine_support import picture, program, rect

from iconjax.search.advice import Advice
from iconjax.search.api import search_edit
from iconjax.search.candidate import build_candidate
from iconjax.search.config import SearchConfig
from iconjax.search.hints import distance, hint_matrices, hinted_start, hinted_state
from iconjax.search.setup import prepare
from iconjax.search.state import State
from iconjax.solve.pose import matrices

ABOUT = {"translate": np.array([[1.0, 0, 7], [0, 1, -4]]), "scale": np.array([[1.5, 0, -20], [0, 1, 0]])}


@pytest.fixture(scope="module")
def scene():
    return picture({"Box:Body": rect(30, 40, 60, 90), "Box:Lid": rect(30, 30, 60, 40), "Ball": rect(90, 60, 110, 80)})


@pytest.fixture(scope="module")
def setup(scene):
    return prepare(scene, program(scene, ['translate("Ball")']), SearchConfig())


@pytest.mark.parametrize("kind", ABOUT)
def test_a_start_reproduces_the_guess(setup, kind):
    guess = hint_matrices(3, {0: ABOUT[kind], 1: ABOUT[kind]})
    state = hinted_state(setup.setting, State(("N",) * 3), guess)
    assert state.modes[1] == "W:0"  # what moves alike moves as one
    bodies = build_candidate(setup.setting, state, setup.sizes).bodies
    z = hinted_start(state, bodies, guess)
    found = np.asarray(matrices(np.vstack([z[:1], np.zeros((len(bodies.centre) - 1, 5))]), bodies))[0]
    np.testing.assert_allclose(found, guess[0], atol=1e-4)


def test_a_mirrored_or_broken_guess_is_ignored():
    mirror = np.array([[-1.0, 0, 100], [0, 1, 0]])
    guess = hint_matrices(3, {0: mirror, 1: np.full((2, 3), np.nan), 7: np.eye(2, 3)})
    np.testing.assert_array_equal(guess, hint_matrices(3, {}))


def test_distance_is_the_mean_displacement(setup):
    features = setup.setting.facts.features
    shifted = hint_matrices(3, {2: np.array([[1.0, 0, 3], [0, 1, 4]])})
    assert distance(shifted, hint_matrices(3, {}), features) == pytest.approx(5 / 3)


def test_a_guess_decides_between_equal_solutions_only(scene):
    calls = program(scene, ['translate("Ball")', 'equal(dist_x("Ball", "Box:Body"), 30)'])
    ids = {s.name: s.id for s in scene.segments}
    free = search_edit(scene, calls)
    lie = {ids["Box:Body"]: np.array([[1.0, 0, 40], [0, 1, 40]]), ids["Ball"]: np.array([[1.0, 0, 0], [0, 1, 30]])}
    told = search_edit(scene, calls, advice=Advice(guesses=lie))
    assert all(c.satisfied for c in told.constraints)
    np.testing.assert_allclose(told.matrices, free.matrices, atol=0.05)
