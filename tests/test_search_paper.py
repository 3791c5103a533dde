"""The paper's strategy: its states and fronts, its loss, what it finds, and its two switches."""

from __future__ import annotations

import jax
import numpy as np
import pytest
import solve_support as support

from iconjax.dsl.parse import parse
from iconjax.dsl.registry import default_registry
from iconjax.errors import ConfigError
from iconjax.search import paper
from iconjax.search.api import search_edit
from iconjax.search.config import SearchConfig
from iconjax.search.paper import PaperSearch
from iconjax.search.paper_states import (
    PaperState,
    build_choice,
    candidate_edges,
    flip_motion,
    flip_relations,
    initial_state,
    next_edges,
    next_nodes,
    primary_nodes,
    subsets,
)
from iconjax.solve.cache import precise_cpu
from iconjax.solve.objective import SHARP
from iconjax.solve.violation import MeanViolation


@pytest.fixture(scope="module", autouse=True)
def _quick():
    with support.quick_compiles():
        yield


def run(program, **settings):
    scene = support.picture()
    config = SearchConfig(strategy="paper", **settings)
    return scene, search_edit(scene, parse(program, scene.names, scene.objects), config)


@pytest.fixture(scope="module")
def narrower():
    return run(support.NARROWER)


@pytest.fixture(scope="module")
def apart():
    return run(support.APART, motion_search=False)


@pytest.fixture(scope="module")
def search():
    return PaperSearch(support.prepared(strategy="paper"), default_registry(), SearchConfig(strategy="paper"))


class Rel:
    """A relation, as far as flips look at it."""

    def __init__(self, a, b, scope, kind="overlap"):
        self.a, self.b, self.scope, self.kind = a, b, scope, kind


CHAIN = [Rel(0, 1, "inter"), Rel(1, 2, "intra"), Rel(2, 3, "intra-crucial"), Rel(3, 4, "inter")]


def test_flips_follow_the_papers_order_and_inherit_from_one_another():
    state = PaperState(("TRS",) * 5, ("ST",) * 4)
    states = [s.relations for _, s in flip_relations(state, (0, 1, 2), CHAIN)]
    assert states == [
        ("WK", "ST", "ST", "ST"),
        ("N", "ST", "ST", "ST"),
        ("N", "N", "ST", "ST"),
        ("N", "N", "WK", "ST"),
    ]
    assert [m for m, _ in flip_motion(state, 3)] == ["TRS", "TR", "TS", "T", "N"]
    assert flip_motion(state, 3)[-1][1].motion == ("TRS", "TRS", "TRS", "N", "TRS")


def test_fronts_spread_to_neighbours_not_seen_before():
    edges = range(4)
    assert next_edges([0], {0}, CHAIN, edges) == [1]
    assert next_edges([1], {0, 1}, CHAIN, edges) == [2]
    assert next_nodes([1], {1}, CHAIN, edges) == [0, 2]
    assert next_nodes([4], {0, 1, 2, 3, 4}, CHAIN, edges) == []


def test_relations_nearest_to_the_request_come_first():
    assert candidate_edges([4], CHAIN) == [3, 2, 1, 0]
    assert candidate_edges([1], [*CHAIN, Rel(0, 4, "intra", "near"), Rel(5, 6, "intra")]) == [0, 1, 2, 3, 5]


def test_subsets_are_all_or_bounded_with_the_whole_front_among_them():
    assert subsets((4, 7), 24) == ([(), (4,), (7,), (4, 7)], 4)
    chosen, count = subsets(tuple(range(9)), 6)
    assert count == 512
    assert chosen == [(), (0,), (1,), (2,), (3,), tuple(range(9))]


def test_states_begin_as_the_program_says():
    setup = support.prepared(('stay("Table")', *support.NARROWER), strategy="paper")
    state = initial_state(setup.setting.intent, {0, 1}, {0, 1, 2}, 2, 3)
    assert state.motion == ("TS", "TRS", "N")
    assert state.relations == ("ST", "ST")
    assert primary_nodes(setup) == [2, 0]


def test_slopes_of_the_mean_violation_agree_with_finite_differences(search):
    program = search.program
    state = initial_state(search.setup.setting.intent, search.edges, search.movable, len(search.relations), 3)
    choice = build_choice(state, search.setup, search.movable, program.active(state.relations))

    def value_and_slope(problem, cand, z):
        return MeanViolation(problem, cand, program.table, program.wide).value_and_slope(z, SHARP)

    with precise_cpu():
        call = jax.jit(value_and_slope, compiler_options=support.QUICK)
        free = np.asarray(choice.bodies.free).reshape(-1)
        z = np.random.default_rng(3).normal(0, 5, free.size) * free
        _, slope = call(program.violations, choice, z)
        step = 1e-6
        for k in np.flatnonzero(free):
            ahead, behind = (call(program.violations, choice, z + s * step * np.eye(free.size)[k])[0] for s in (1, -1))
            np.testing.assert_allclose(slope[k], (ahead - behind) / (2 * step), rtol=1e-3, atol=1e-5)


def test_flipping_a_mask_changes_only_what_counts_and_compiles_nothing(narrower, search):
    setup, program = search.setup, search.program
    relations = search.relations
    strong = PaperState(("N",) * 3, ("ST",) * len(relations))
    states = [strong, strong.with_relations([0], "WK"), strong.with_relations([0], "N")]
    choices = [build_choice(s, setup, search.movable, program.active(s.relations)) for s in states]
    found = search.engine.solve(choices)
    assert search.engine.compile_seconds == 0  # the search before it had the same sizes
    for k in (1, 2):
        np.testing.assert_array_equal(found.primary[k], found.primary[0])
        np.testing.assert_array_equal(found.matrices[k], found.matrices[0])
    excess = program.excess(found.primary[0])
    for k, choice in enumerate(choices):
        assert found.loss[k] == pytest.approx((choice.active * excess).sum() / choice.active.sum(), abs=1e-6)
    assert [int(c.active.sum()) for c in choices] == [2 + 2 * len(relations) - k for k in range(3)]


def test_a_simple_request_is_met_with_every_relation_kept(narrower):
    scene, outcome = narrower
    x0, _, x1, _ = support.box_of(scene, outcome.matrices, "Lamp:Shade")
    assert (x0, x1) == pytest.approx((36, 56), abs=0.5)
    assert all(c.satisfied for c in outcome.constraints)
    assert {r.state for r in outcome.relations} == {"ST"}
    assert outcome.score < 0.02
    assert outcome.notes == ()


def test_the_trace_tells_what_was_tried(narrower):
    _, outcome = narrower
    first, *rest = outcome.trace
    assert (first.origin, first.kept) == ("initial state", True)
    assert first.motion == {"Lamp:Shade": "TS", "Lamp:Foot": "TRS", "Table": "TRS"}
    assert all(e.cost == pytest.approx(sum(e.terms.values()), abs=1e-6) for e in outcome.trace)
    assert any(e.origin == "Lamp:Foot: N" for e in rest)
    assert any(e.kept for e in rest)
    assert outcome.timings["search"] > 0


def test_a_relation_in_the_way_is_loosened(apart):
    _, outcome = apart
    assert all(c.satisfied for c in outcome.constraints)
    lamp = next(r for r in outcome.relations if {r.a, r.b} == {"Lamp:Shade", "Lamp:Foot"})
    assert lamp.state == "WK"  # crucial: the paper never gives it up
    assert any(e.relations and e.kept for e in outcome.trace)


def test_without_relation_search_every_relation_exists(apart):
    _, outcome = run(support.APART, relation_search=False, motion_search=False)
    assert {r.state for r in outcome.relations} == {"ST"}
    assert all(not e.relations for e in outcome.trace)
    assert outcome.score > 10 * apart[1].score


def test_without_motion_search_every_segment_keeps_its_first_state(narrower):
    _, outcome = run(support.NARROWER, motion_search=False)
    assert [dict(e.motion) for e in outcome.trace] == [dict(narrower[1].trace[0].motion)]


def test_a_bounded_front_says_so(monkeypatch):
    monkeypatch.setattr(paper, "COMBINATIONS", 2)
    _, outcome = run(support.APART, motion_search=False)
    assert outcome.notes == (
        "relation search: a front of 2 relations has 4 subsets; the 1 smallest and the whole front were tried",
    )


def test_a_bounded_scene_says_so(monkeypatch):
    monkeypatch.setattr(paper, "EDGES", 1)
    monkeypatch.setattr(paper, "NODES", 1)
    _, outcome = run(support.NARROWER)
    assert outcome.notes == (
        "paper strategy: 1 of 2 relations are constraints, those nearest to the request",
        "paper strategy: 1 of 2 segments had their motion searched, those nearest to the request",
    )
    assert sorted(r.state for r in outcome.relations) == ["N", "ST"]


def test_a_solver_that_needs_more_than_slopes_is_refused():
    with pytest.raises(ConfigError, match=r"cannot use solver 'lm'"):
        run(support.NARROWER, solver="lm")
