"""Programs as data: what they compile to, and the values and derivatives of their residuals."""

from __future__ import annotations

import functools

import jax
import numpy as np
import pytest
from dsl_helpers import QUICK, affine
from engine_support import numeric_slope, picture, program, rect

from iconjax.dsl.check import check_or_raise
from iconjax.dsl.registry import default_registry
from iconjax.errors import ProgramError
from iconjax.relations.detect import detect_relations
from iconjax.solve.cache import precise_cpu
from iconjax.solve.compile import LEAVES, compile_program
from iconjax.solve.program import residuals
from iconjax.solve.table import operator_table

SEGMENTS = 4
BODY = np.array([0, 1, 2, 3])  # three bodies; the fourth segment is padding
BOXES = {"A": (20, 30, 60, 50), "B": (50, 40, 70, 100), "C": (80, 70, 110, 90)}
MOVED = [
    affine(turn=11, scale=(1.2, 0.9), shift=(3.3, -2.1), about=(40, 40)),
    affine(turn=-7, scale=(0.8, 1.1), shift=(-1.7, 4.2), about=(55, 70)),
    affine(turn=25, scale=(1.1, 1.3), shift=(6.1, 2.9), about=(90, 80)),
]
SHIFTED = [affine(shift=(7, -3)), affine(shift=(-2, 5)), affine(scale=(2, 1), about=(95, 80))]
BOX_WORDS = ("min_x", "max_x", "min_y", "max_y", "center_x", "center_y", "hori_len", "vert_len")
ARITHMETIC = ("plus", "minus", "mul", "div", "min", "max", "equal", "smaller", "larger")
PLAIN = (*BOX_WORDS, *ARITHMETIC)


@functools.cache
def scene():
    """Two boxes that overlap (A is cut out of B) and one apart."""
    return picture({"B": rect(*BOXES["B"]), "A": rect(*BOXES["A"]), "C": rect(*BOXES["C"])})


ORDER = ("B", "A", "C")


@functools.cache
def small_table(words):
    """The operator table cut down to some operators, so that little is compiled."""
    full = operator_table(default_registry())
    leaves = [k for k, key in enumerate(full.leaf_keys) if key.split("#")[0] in words]
    steps = [k for k, key in enumerate(full.step_keys) if key.split("#")[0] in words]
    return full._replace(
        leaf_keys=tuple(full.leaf_keys[k] for k in leaves),
        leaf_kinds=tuple(full.leaf_kinds[k] for k in leaves),
        leaf_functions=tuple(full.leaf_functions[k] for k in leaves),
        step_keys=tuple(full.step_keys[k] for k in steps),
        step_functions=tuple(full.step_functions[k] for k in steps),
    )


@functools.cache
def kernel(words, wide):
    table = small_table(words)
    return jax.jit(
        lambda code, regions, m, body: residuals(code, regions, m, body, table, wide), compiler_options=QUICK
    )


def compiled(text, words=PLAIN):
    """A program compiled against the small table."""
    registry, tree = default_registry(), program(scene(), text)
    checked = check_or_raise(tree, registry)
    units = [None if registry.operators[c.name].is_motion else checked.unit(c) for c in tree.calls]
    sizes = {o.name: o.residual_size for o in registry.operators.values()}
    variadic = frozenset(o.name for o in registry.operators.values() if o.variadic)
    found = detect_relations(scene())
    return compile_program(tree, units, scene(), found, small_table(words), sizes, variadic, SEGMENTS)


def run(ready, moves=MOVED, words=PLAIN, body=BODY):
    """Residuals in use, and their derivatives, with transforms in the order A, B, C."""
    by_name = dict(zip("ABC", moves, strict=True))
    flat = np.stack([by_name[n].reshape(6) for n in ORDER])
    return run_flat(ready, flat, words, body)


def run_flat(ready, flat, words=PLAIN, body=BODY):
    with precise_cpu():
        value, slope = kernel(words, ready.wide)(ready.code, ready.regions, flat, body)
    return np.asarray(value)[: len(ready.owner)], np.asarray(slope)[: len(ready.owner)]


def moved_box(name, move):
    x0, y0, x1, y1 = BOXES[name]
    if name == "B":  # A covers one of its corners: what is left of it has the same box
        corners = np.array([[60, 40], [70, 40], [70, 100], [50, 100], [50, 50], [60, 50]], float)
    else:
        corners = np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]], float)
    corners = corners @ move[:, :2].T + move[:, 2]
    return dict(zip(("min_x", "min_y"), corners.min(0), strict=True)) | dict(
        zip(("max_x", "max_y"), corners.max(0), strict=True)
    )


@pytest.mark.parametrize("name", ["A", "B", "C"])
def test_boxes_of_moved_segments_are_measured(name):
    sides = ("min_x", "max_x", "min_y", "max_y")
    value, _ = run(compiled("\n".join(f'equal({side}("{name}"), 10)' for side in sides)))
    box = moved_box(name, MOVED["ABC".index(name)])
    assert np.allclose(np.abs(value), [abs(box[s] - 10) for s in sides], atol=1e-6)


def test_arithmetic_is_done_on_values():
    text = (
        'equal(plus(min_x("A"), mul(2, min_y("C"))), minus(max_x("B"), 3))\n'
        'equal(div(max_x("A"), 4), 0)\n'
        'equal(max(min_x("A"), min_x("B"), min_x("C")), 0)\n'
        'equal(min(min_x("A"), min_x("B"), min_x("C")), 0)\n'
        'equal(-min_x("A"), 0)'
    )
    value, _ = run(compiled(text))
    a, b, c = (moved_box(n, m) for n, m in zip("ABC", MOVED, strict=True))
    lows = [box["min_x"] for box in (a, b, c)]
    right = [a["min_x"] + 2 * c["min_y"] - b["max_x"] + 3, a["max_x"] / 4, max(lows), min(lows), a["min_x"]]
    assert np.allclose(np.abs(value), np.abs(right), atol=1e-6)


def test_one_sided_constraints_are_zero_where_they_hold():
    text = 'smaller(min_x("A"), 500)\nlarger(min_x("A"), 500)\nsmaller(min_x("A"), -500)\nlarger(min_x("A"), -500)'
    value, slope = run(compiled(text))
    assert value[0] == 0 and value[3] == 0 and not slope[[0, 3]].any()
    assert abs(value[1]) > 400 and abs(value[2]) > 400 and slope[1].any() and slope[2].any()


def test_old_material_stays_where_it_was():
    value, slope = run(compiled('equal(max_x(old("A")), 0)\nequal(center_x(old(union("A", "C"))), 0)'))
    assert np.allclose(np.abs(value), [60, 65], atol=1e-6)
    assert not slope.any()


def test_sides_are_the_outermost_quarter_and_move_along():
    sides = ('vert_len(top("C"))', 'max_y(bot("C"))', 'hori_len(left("C"))', 'min_x(right("C"))')
    text = "\n".join(f"equal({side}, 0)" for side in sides)
    still, _ = run(compiled(text), [affine()] * 3)
    assert np.allclose(np.abs(still), [5, 90, 7.5, 102.5], atol=0.6)
    value, _ = run(compiled(text), SHIFTED)  # C is stretched to twice its width about x = 95
    assert np.allclose(np.abs(value), [5, 90, 15, 110], atol=1.1)


def test_the_canvas_is_the_whole_picture_and_never_moves():
    text = 'equal(max_x("canvas"), 0)\nequal(vert_len("canvas"), 0)\nequal(min_y("canvas"), 7)'
    value, slope = run(compiled(text))
    assert np.allclose(np.abs(value), [128, 128, 7]) and not slope.any()


def test_a_union_is_measured_as_one_and_pulls_on_whichever_part_sticks_out():
    value, slope = run(compiled('equal(min_x(union("A", "C")), 0)\nequal(max_x(union("A", "C")), 0)'))
    a, c = moved_box("A", MOVED[0]), moved_box("C", MOVED[2])
    assert np.allclose(np.abs(value), [a["min_x"], c["max_x"]], atol=1e-6)
    at = {n: ORDER.index(n) for n in ORDER}
    assert slope[0, at["A"]].any() and not slope[0, at["C"]].any()
    assert slope[1, at["C"]].any() and not slope[1, at["A"]].any()


def test_segments_carried_by_one_body_add_up_in_its_derivative():
    ready = compiled('equal(plus(center_x("A"), center_x("C")), 0)')
    flat = np.stack([affine(shift=(2, 3)).reshape(6)] * 3)
    together = np.array([1, 0, 0, 3])  # A and C on body 0
    _, apart = run_flat(ready, flat)
    value, slope = run_flat(ready, flat, body=together)
    assert value[0] == pytest.approx(run_flat(ready, flat)[0][0])
    assert np.allclose(slope[0, 0], apart[0, 1] + apart[0, 2]) and not slope[0, 2].any()


def test_a_segment_without_a_body_stays():
    ready = compiled('equal(max_x("A"), 0)')
    value, slope = run(ready, body=np.array([0, 3, 2, 3]))
    assert abs(value[0]) == pytest.approx(60) and not slope.any()


def test_equal_expressions_share_a_register():
    ready = compiled(
        'equal(center_x("A"), center_x("B"))\nequal(center_x("A"), plus(center_x("B"), 5))\nequal(center_x("B"), 5)'
    )
    assert int(ready.code.leaves) == 2
    assert int(ready.code.steps) == 5  # three comparisons, one sum, and the literal once
    assert len(np.unique(ready.code.region_a[:2])) == 2


def test_regions_that_are_written_alike_are_built_once():
    ready = compiled('equal(min_x(top("A")), max_x(top("A")))\nequal(min_x(old("A")), min_x("A"))')
    assert set(ready.code.region_a[: int(ready.code.leaves)]) == {0, 1, 2}


def test_instructions_beyond_the_end_change_nothing():
    ready = compiled('equal(plus(center_x("A"), min_y("C")), 3)\nsmaller(hori_len("B"), 9)')
    code = ready.code
    leaves, steps = int(code.leaves), int(code.steps)
    junk = {
        f: getattr(code, f).copy()
        for f in ("leaf_op", "region_a", "region_b", "extra", "step_op", "value_a", "literal")
    }
    for name, array in junk.items():
        array[(leaves if name in ("leaf_op", "region_a", "region_b", "extra") else steps) :] = 1
    full = {"value": run(ready)[0], "slope": run(ready)[1]}
    value, slope = run(type(ready)(code._replace(**junk), ready.regions, ready.owner, ready.wide))
    assert np.array_equal(value, full["value"]) and np.array_equal(slope, full["slope"])


def test_padding_residuals_are_zero():
    ready = compiled('equal(center_x("A"), 3)')
    flat = np.stack([affine(shift=(2, 3)).reshape(6)] * 3)
    with precise_cpu():
        found = kernel(PLAIN, False)(ready.code, ready.regions, flat, BODY)
    value, slope = map(np.asarray, found)
    assert abs(value[0]) > 1 and not value[1:].any() and not slope[1:].any()


def test_a_program_of_the_next_size_gives_the_same_values():
    line = 'equal(center_x("A"), {})'
    few = compiled(line.format(3))
    many = compiled("\n".join(line.format(k) for k in range(3, 3 + 12)))
    assert len(many.code.out) > len(few.code.out) and len(many.code.leaf_op) == LEAVES[1]
    assert run(many)[0][0] == pytest.approx(run(few)[0][0])
    assert np.allclose(run(many)[1][0], run(few)[1][0])


def test_a_program_beyond_the_largest_size_is_refused_in_words():
    with pytest.raises(ProgramError, match="at most"):
        compiled("\n".join(f'equal(center_x("A"), {k})' for k in range(300)))


def test_motion_specifiers_leave_no_residual():
    ready = compiled('translate("A")\nstay("B")\nequal(center_x("A"), 3)')
    assert ready.owner == (2,)


def test_an_intersection_within_a_side_is_refused_in_words():
    with pytest.raises(ProgramError, match="intersection"):
        compiled('equal(vert_len(top(inter("A", "B"))), 3)')


MANY = (
    "rotation", "angle", "long_dir_x", "scale_x", "coincide_on_point", "uniform", "avg_dist", "inside", *PLAIN
)  # fmt: skip
MANY_TEXT = """
equal(plus(center_y("A"), mul(0.5, hori_len(union("B", "C")))), 9)
equal(rotation("A"), 30)
equal(angle("A", "B"), 20)
equal(long_dir_x("C"), 0.2)
equal(scale_x("B"), 2)
coincide_on_point("A", [30, 35], "C", [100, 72])
uniform("C")
equal(avg_dist("A", "C"), 4)
inside("A", "B")
"""
MEET = ("hori_len", "min_x", "max_x", "angle", "equal", "plus")
MEET_TEXT = """
equal(hori_len(inter("C", "canvas")), 3)
equal(min_x(inter("B", "A")), plus(max_x("C"), 5))
equal(angle("A", inter("B", "A")), 20)
"""


def slopes_agree(ready, words):
    """Compare derivatives by every entry of every transform with differences, row by row."""
    flat = np.stack([MOVED["ABC".index(n)].reshape(6) for n in ORDER])
    value, slope = run_flat(ready, flat, words)
    assert np.isfinite(value).all() and np.isfinite(slope).all()
    numeric = numeric_slope(lambda m: run_flat(ready, m, words)[0], flat, 1e-4).reshape(slope.shape)
    for k in range(len(value)):
        assert slope[k].any()
        # Which of two equally near edges is nearest is decided to 1e-5: smaller steps see that, and not the slope.
        assert np.allclose(slope[k], numeric[k], rtol=1e-4, atol=1e-3 * np.abs(slope[k]).max()), ready.owner[k]


def test_derivatives_of_many_operators_agree_with_finite_differences():
    slopes_agree(compiled(MANY_TEXT, MANY), MANY)


def test_violations_of_every_unit_are_pixels():
    value, _ = run(compiled(MANY_TEXT, MANY), SHIFTED, MANY)
    lever = 128 / 4
    assert abs(value[1]) == pytest.approx(lever * np.radians(30), abs=1e-6)
    assert abs(value[4]) == pytest.approx(lever, abs=1e-6)  # a ratio of 1 instead of 2
    apart = np.array([37, 32]) - np.array([95 + 2 * (100 - 95), 72])  # of the two points that should meet
    assert np.allclose(np.abs(value[5:7]), np.abs(apart), atol=1e-6)


def test_intersections_are_measured_in_their_new_pose():
    ready = compiled(MEET_TEXT, MEET)
    assert ready.wide
    value, _ = run(ready, SHIFTED, MEET)
    assert abs(value[0]) == pytest.approx(57, abs=1e-6)  # C is stretched from 80..110 to 65..125, all in the picture
    # A comes to lie at 27..67 x 27..47. Where it was cut out of B stays open, so that B begins at 58 in those rows.
    assert abs(value[1]) == pytest.approx(125 + 5 - 58, abs=1e-6)


def test_derivatives_of_intersections_agree_with_finite_differences():
    slopes_agree(compiled(MEET_TEXT, MEET), MEET)
