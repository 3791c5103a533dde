"""What one solve of the default method guarantees, on small pictures and chosen motion masks."""

from __future__ import annotations

import threading
from functools import partial

import jax
import numpy as np
import pytest
from engine_support import STILL, Bench, disc, numeric_slope, picture, rect, unjoined, with_bodies

from iconjax.solve.cache import precise_cpu
from iconjax.solve.coherence import box_rows, joint_rows, one_hot_bodies
from iconjax.solve.pose import DOF, jacobians, matrices
from iconjax.solve.program import segment_matrices

GOAL = 'equal(center_x("Tower:Roof"), plus(center_x(old("Tower:Roof")), 20))'


def tower():
    """A base, a storey and a roof on top of each other, and a ball far from them."""
    shapes = {"Tower:Base": rect(15, 90, 65, 115), "Tower:Storey": rect(25, 60, 55, 90)}
    return picture(shapes | {"Tower:Roof": rect(20, 40, 60, 60), "Ball": disc(105, 25, 11)})


@pytest.fixture(scope="module")
def bench():
    """The tower with its roof asked to go 20 px to the right."""
    return Bench(tower(), 'translate("Tower:Roof")\n' + GOAL)


# Soft residuals ---------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def soft(bench):
    """Soft residuals as compiled functions of the parameters, for a candidate with everything free."""
    cand = bench.candidate(Base="TRSxy", Storey="TRSu", Roof="TRSxy", Ball="TRSxy")
    slide = cand.slide.copy()
    slide[0] = 1
    cand = cand._replace(slide=slide, align=np.ones_like(cand.align), canvas=np.array(1.0))
    free = cand.bodies.free.copy()
    free[3, 2] = 0
    cand = with_bodies(cand, free=free)

    def rows(kind, z):
        bodies = cand.bodies
        d, pick = jacobians(z, bodies), one_hot_bodies(cand.body, z.shape[0]).astype(z.dtype)
        segments = segment_matrices(matrices(z, bodies), cand.body)
        if kind == "joints":
            return joint_rows(bench.setup.problem, cand, z, segments, d, pick)
        return box_rows(bench.setup.problem, cand, segments, d, pick)

    with precise_cpu():
        run = {kind: jax.jit(partial(rows, kind)) for kind in ("joints", "boxes")}

        def call(kind, z):
            return run[kind](z)

        yield cand, call


@pytest.mark.parametrize("kind", ["joints", "boxes"])
def test_soft_residuals_are_zero_before_the_edit(soft, kind):
    cand, rows = soft
    found = rows(kind, np.zeros_like(cand.bodies.free))
    assert np.abs(found.value).max() < 1e-9 and np.abs(found.norm).max() < 1e-5


def some_motion(cand):
    """Parameters that move everything, the ball out of the picture."""
    z = np.random.default_rng(1).normal(0, 7, cand.bodies.free.shape)
    z[3, :2] = [25, -30]
    return z * cand.bodies.free


@pytest.mark.parametrize("kind", ["joints", "sliding joints", "boxes"])
def test_soft_slopes_agree_with_finite_differences(soft, kind):
    cand, rows = soft
    z, kind, sliding = some_motion(cand), kind.split()[-1], kind.startswith("sliding")
    found = rows(kind, z)
    numeric = numeric_slope(lambda x: rows(kind, x).value, z, 1e-4).reshape(found.slope.shape)
    some = np.arange(len(found.value))
    if kind == "joints":
        some = some[6:] if not sliding else some[:6]  # only the first relation may slide
    assert (np.abs(found.value[some]) > 0.1).sum() > 3
    assert np.allclose(found.slope[some], numeric[some] * cand.bodies.free, atol=1e-5)


def test_a_rigid_motion_of_all_opens_no_joint(soft):
    cand, rows = soft
    shift = np.zeros_like(cand.bodies.free)
    shift[:4, :2] = [9, -4]
    assert np.abs(rows("joints", shift).value).max() < 1e-9
    assert np.abs(rows("boxes", shift).value[: cand.align.size]).max() > 1 or not cand.align.any()


def test_a_sliding_joint_minds_only_what_is_across_it(soft):
    cand, rows = soft
    z = np.zeros_like(cand.bodies.free)
    z[0, 0] = 12  # the base goes right under the storey: relation 0 may slide
    sliding = np.asarray(rows("joints", z).value).reshape(-1, 6)[0]
    z[0, :2] = 0, 12
    pulled = np.asarray(rows("joints", z).value).reshape(-1, 6)[0]
    assert np.abs(sliding).max() < 1e-6 and np.abs(pulled).max() == pytest.approx(12)


def test_the_canvas_pulls_only_on_what_leaves_it(soft):
    cand, rows = soft
    z = np.zeros_like(cand.bodies.free)
    z[3, :2] = [5, -5]  # the ball comes nearer to the corner, but stays in
    edge = np.asarray(rows("boxes", z).value)[cand.align.size :]
    assert not edge.any()
    z[3, :2] = [30, -30]
    edge = np.asarray(rows("boxes", z).value)[cand.align.size :].reshape(-1, 4)
    assert np.allclose(edge[3], [0, 105 + 11 + 30 - 128, 30 - 25 + 11, 0], atol=0.6)
    assert not np.delete(edge, 3, 0).any()


# Primary constraints ----------------------------------------------------------------------------------------------

ALL_WAYS = """
translate("Ball")
scale("Ball")
rotate("Tower:Roof")
equal(center_x("Ball"), 80)
equal(min_y("Ball"), 20)
equal(hori_len("Ball"), mul(1.5, hori_len(old("Ball"))))
equal(vert_len("Ball"), 30)
equal(rotation("Tower:Roof"), 25)
smaller(max_x("Tower:Roof"), 70)
"""


def test_primaries_that_can_be_met_are_met_to_a_hundredth_of_a_pixel():
    bench = Bench(tower(), ALL_WAYS)
    free = bench.candidate(Ball="TSxy", Roof="TR", Storey="T")
    found = bench.solve(free, unjoined(free))
    assert np.abs(found.primary).max() < 0.01
    assert np.degrees(np.arctan2(*bench.matrix(found, "Roof")[::-1, 0])) == pytest.approx(25, abs=0.02)


def test_contradictory_primaries_end_in_the_least_squares_compromise():
    far = GOAL.replace("20)", "32)")
    bench = Bench(tower(), f'translate("Tower:Roof")\n{GOAL}\n{far}')
    candidate = bench.candidate(Roof="T")
    found = bench.solve(unjoined(candidate), candidate)
    assert np.isfinite(found.matrices).all() and np.isfinite(found.loss).all()
    assert bench.matrix(found, "Roof")[0, 2] == pytest.approx(26, abs=0.05)
    assert np.allclose(np.abs(found.primary[0]), 6, atol=0.05)


def test_what_nothing_can_reach_leaves_everything_finite_and_in_place(bench):
    found = bench.solve(bench.candidate(), bench.candidate(Ball="TR"))
    assert np.allclose(np.abs(found.primary[:, 0]), 20)
    assert np.isfinite(found.loss).all()
    assert np.array_equal(found.matrices[:, :4].reshape(2, 4, 2, 3), np.broadcast_to(STILL, (2, 4, 2, 3)))


def test_a_primary_is_never_bent_by_what_holds_the_rest(bench):
    joined = bench.candidate(Roof="TRSxy")
    found = bench.solve(joined, unjoined(joined))
    assert joined.hold.any() and joined.ends.any()
    assert np.abs(found.primary).max() < 0.01
    assert not np.allclose(found.matrices[0], found.matrices[1], atol=0.5)  # the joints did pull


def test_primaries_are_met_from_far_away_and_back():
    start = 'translate("Ball")\nequal(center_x("Ball"), {})\nequal(center_y("Ball"), {})'
    for x, y in ((15, 110), (105, 25)):
        bench = Bench(tower(), start.format(x, y))
        found = bench.solve(bench.candidate(Ball="TRSxy"))
        assert np.abs(found.primary).max() < 0.01
    assert np.allclose(bench.matrix(found, "Ball"), STILL, atol=1e-6)  # it was there: no need to move


# Least change -----------------------------------------------------------------------------------------------------


def test_what_is_free_but_not_needed_is_exactly_still(bench):
    found = bench.solve(bench.candidate(Roof="T", Ball="TRSxy"))
    assert np.abs(found.primary).max() < 0.01
    assert np.array_equal(bench.matrix(found, "Ball"), STILL)
    assert not found.z[0, 1].any()


def test_what_holds_on_follows_and_what_is_let_go_stays(bench):
    follows = bench.candidate(Roof="T", Storey="T", Base="T")
    let_go = follows._replace(hold=0 * follows.hold, ends=0 * follows.ends, align=0 * follows.align)
    found = bench.solve(follows, let_go)
    for name in ("Storey", "Base"):
        assert np.allclose(bench.matrix(found, name)[:, 2], [20, 0], atol=0.1)
        assert np.array_equal(bench.matrix(found, name, 1), STILL)


def test_what_nobody_asked_to_move_resists_a_weak_pull(bench):
    plain = bench.candidate(Roof="T", Storey="T")
    names = bench.scene.names
    pairs = [{names[r.a], names[r.b]} for r in bench.setup.setting.relations]
    weak = np.zeros_like(plain.hold)
    weak[pairs.index({"Tower:Roof", "Tower:Storey"})] = 0.03
    pulled = unjoined(plain)._replace(hold=weak, ends=weak)
    assert pulled.bodies.sparsity[0, 0] > 3 * 0.03
    willing = with_bodies(pulled, sparsity=np.zeros_like(plain.bodies.sparsity))
    found = bench.solve(pulled, willing)
    assert np.allclose(bench.matrix(found, "Storey"), STILL, atol=0.05)
    assert np.allclose(bench.matrix(found, "Storey", 1)[:, 2], [20, 0], atol=0.5)


def test_masked_parameters_stay_zero_even_where_the_start_says_otherwise(bench):
    candidate = bench.candidate(Roof="T")
    pushed = with_bodies(candidate, start=np.full_like(candidate.bodies.start, 9.0))
    found = bench.solve(candidate, pushed)
    assert not found.z[:, candidate.bodies.free == 0].any()
    assert np.array_equal(found.matrices[:, 0], found.matrices[:, 3])
    assert np.allclose(found.matrices[0], found.matrices[1], atol=1e-3)


def test_freeing_one_parameter_changes_nothing_elsewhere(bench):
    plain = bench.candidate(Roof="T", Ball="T")
    free = plain.bodies.free.copy()
    free[1, 2] = 1  # the ball may turn as well
    found = bench.solve(plain, with_bodies(plain, free=free))
    assert np.allclose(found.matrices[0], found.matrices[1], atol=1e-9, rtol=0)


def test_freeing_a_parameter_changes_only_what_it_moves(bench):
    plain = unjoined(bench.candidate(Roof="T", Storey="T"))
    free = plain.bodies.free.copy()
    free[1, 3] = 1
    found = bench.solve(plain, with_bodies(plain, free=free))
    still = [0, 1, 3]  # base, storey, ball
    assert np.array_equal(found.matrices[0][still], found.matrices[1][still])


# Padding and batches ----------------------------------------------------------------------------------------------


def test_bodies_in_use_may_stand_anywhere_among_the_padding(bench):
    plain = bench.candidate(Roof="TR", Storey="TSxy", Base="T")
    count = len(plain.bodies.free)
    order = np.random.default_rng(0).permutation(count)
    place = np.append(np.argsort(order), count)
    moved = plain._replace(
        body=place[plain.body],
        bodies=type(plain.bodies)(*(array[order] for array in plain.bodies)),
    )
    found = bench.solve(plain, moved)
    assert np.allclose(found.matrices[0], found.matrices[1], atol=1e-6, rtol=0)
    assert found.loss[0] == pytest.approx(found.loss[1], abs=1e-6)


def test_padding_relations_and_alignments_weigh_nothing(bench):
    plain = bench.candidate(Roof="TR", Storey="T", Base="T")
    problem, used = bench.setup.problem, len(bench.setup.setting.relations)
    rows = len(bench.setup.setting.facts.alignments)
    joints, alignments = (type(x)(*(a.copy() for a in x)) for x in (problem.joints, problem.alignments))
    joints.a[used:], joints.b[used:], joints.points_a[used:], joints.points_b[used:] = 0, 2, 40.0, 70.0
    alignments.a[rows:], alignments.b[rows:], alignments.offset[rows:] = 2, 1, 33.0
    assert used < len(joints.a) and rows < len(alignments.a)
    other = Bench(bench.scene, 'translate("Tower:Roof")\n' + GOAL)
    other.engine.problem = problem._replace(joints=joints, alignments=alignments)
    assert np.allclose(other.solve(plain).matrices, bench.solve(plain).matrices, atol=1e-9, rtol=0)


def test_one_candidate_is_solved_alone_as_it_is_among_others(bench):
    ways = ["T", "TR", "TSxy", "TSu"]
    some = [bench.candidate(Roof=a, Storey=b) for a in ways for b in ("N", *ways)]
    together = bench.solve(*some)
    assert len(together.loss) == len(some) == 20  # more than one call of the executable holds
    for k in (0, 7, 19):
        alone = bench.solve(some[k])
        assert alone.matrices.shape[0] == 1
        assert np.allclose(alone.matrices[0], together.matrices[k], atol=1e-9, rtol=0)


def test_solves_in_two_threads_finish_and_agree(bench):
    ways = ["T", "TR", "TSxy", "TSu"]
    some = [bench.candidate(Roof=a, Storey=b, Base=c) for a in ways for b in ways for c in ("N", "T", "TR")]
    expected = bench.solve(*some).matrices
    found = {}

    def work(name):
        found[name] = bench.solve(*some).matrices

    threads = [threading.Thread(target=work, args=(k,), daemon=True) for k in range(2)]
    for t in threads:
        t.start()
    for t in threads:
        t.join(timeout=60)
    assert set(found) == {0, 1}, "a solve did not come back"
    assert np.array_equal(found[0], expected) and np.array_equal(found[1], expected)


def test_no_candidates_are_refused(bench):
    with pytest.raises(ValueError, match="nothing"):
        bench.engine.solve([])


def test_parameters_are_five_a_body(bench):
    found = bench.solve(bench.candidate(Roof="T"))
    assert found.z.shape[2] == DOF
