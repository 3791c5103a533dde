"""Units: their algebra, how the check applies it, and the common scale."""

from __future__ import annotations

import pytest

from iconjax.dsl.check import check, check_or_raise
from iconjax.dsl.parse import parse
from iconjax.dsl.registry import default_registry
from iconjax.dsl.units import Unit, pixels_per_unit, product, quotient, same, to_pixels
from iconjax.errors import ProgramError

NUMBER, RATIO, DIRECTION, LENGTH, AREA, ANGLE = Unit

# Values of each unit, as text.
LENGTH_TEXT, ANGLE_TEXT = 'vert_len("A")', 'rotation("A")'
DIRECTION_TEXT, RATIO_TEXT = 'long_dir_x("A")', 'scale_x("A")'


def violation_unit(text):
    """The unit that the check finds for the violation of a call."""
    program = parse(text, ["A", "B"])
    return check(program, default_registry()).unit(program.calls[0])


@pytest.mark.parametrize("unit", list(Unit))
def test_numbers_take_the_unit_of_what_they_meet(unit):
    for rule in (same, product, quotient):
        assert rule(unit, NUMBER) is unit
    assert same(NUMBER, unit) is unit
    assert product(NUMBER, unit) is unit


@pytest.mark.parametrize(
    ("rule", "a", "b", "expected"),
    [
        (same, LENGTH, LENGTH, LENGTH), (same, RATIO, DIRECTION, RATIO), (same, LENGTH, ANGLE, None),
        (same, LENGTH, AREA, None), (same, LENGTH, RATIO, None),
        (product, LENGTH, DIRECTION, LENGTH), (product, RATIO, LENGTH, LENGTH),
        (product, LENGTH, LENGTH, AREA),
        (product, DIRECTION, DIRECTION, RATIO),
        (product, RATIO, DIRECTION, DIRECTION), (product, RATIO, ANGLE, ANGLE),
        (product, ANGLE, LENGTH, None), (product, AREA, LENGTH, None),
        (quotient, LENGTH, LENGTH, RATIO), (quotient, AREA, LENGTH, LENGTH),
        (quotient, LENGTH, DIRECTION, LENGTH),
        (quotient, ANGLE, ANGLE, RATIO), (quotient, ANGLE, RATIO, ANGLE), (quotient, RATIO, LENGTH, None),
        (quotient, LENGTH, ANGLE, None), (quotient, NUMBER, LENGTH, None),
        (quotient, DIRECTION, RATIO, DIRECTION),
    ],
)  # fmt: skip
def test_algebra(rule, a, b, expected):
    assert rule(a, b) is expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (f"equal({LENGTH_TEXT}, 3)", LENGTH),
        (f"equal(3, {ANGLE_TEXT})", ANGLE),
        (f"larger({DIRECTION_TEXT}, 0.5)", DIRECTION),
        (f"equal(mul(0.5, {LENGTH_TEXT}), -{LENGTH_TEXT})", LENGTH),
        (f"equal(div({LENGTH_TEXT}, {LENGTH_TEXT}), {RATIO_TEXT})", RATIO),
        (f"smaller(mul({LENGTH_TEXT}, {LENGTH_TEXT}), 900)", AREA),
        (f"equal(max({LENGTH_TEXT}, 3, {LENGTH_TEXT}), {LENGTH_TEXT})", LENGTH),
        ('equal(mul(minus(center_y("A"), center_y(old("A"))), long_dir_x("B")), '
         'mul(minus(center_x("A"), center_x(old("A"))), long_dir_y("B")))', LENGTH),
        ('touch("A", "B")', LENGTH),
        ('parallel("A", "B")', ANGLE),
        ('together("A", "B")', LENGTH),
    ],
)  # fmt: skip
def test_units_of_violations(text, expected):
    assert violation_unit(text) is expected


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (f"equal({LENGTH_TEXT}, {ANGLE_TEXT})", "equal cannot combine a length and an angle"),
        (f"equal({LENGTH_TEXT}, {RATIO_TEXT})", "a length and a ratio"),
        (f"equal(plus({LENGTH_TEXT}, {DIRECTION_TEXT}), 1)", "plus cannot combine a length and a direction"),
        (f"equal(mul({LENGTH_TEXT}, {ANGLE_TEXT}), 1)", "mul cannot combine"),
        (f"equal(div(1, {LENGTH_TEXT}), 1)", "div cannot combine a number and a length"),
        (f"equal(min(1, {LENGTH_TEXT}, {ANGLE_TEXT}), 1)", "min cannot combine a length and an angle"),
    ],
)
def test_units_that_do_not_fit(text, says):
    with pytest.raises(ProgramError, match=says):
        parse(text, ["A", "B"])


def test_every_value_of_a_program_has_a_unit():
    program = parse(f'rotate("A")\nequal({LENGTH_TEXT}, mul(2, {LENGTH_TEXT}))', ["A"])
    checked = check_or_raise(program, default_registry(), ["A"])
    motion, compare = program.calls
    assert motion not in checked.units
    assert [checked.unit(node) for node in (compare, *compare.args)] == [LENGTH] * 3


def test_the_common_scale():
    assert to_pixels(LENGTH, 3.0, 512) == 3
    assert to_pixels(DIRECTION, 0.35, 512) == pytest.approx(44.8)
    assert to_pixels(RATIO, 1.0, 512) == to_pixels(NUMBER, 1.0, 512) == 128
    assert to_pixels(ANGLE, 1.0, 512) == pytest.approx(2.234, abs=1e-3)
    assert to_pixels(AREA, 128.0, 512) == 1
    assert all(pixels_per_unit(unit, 512) > 0 for unit in Unit)


def test_symbols():
    assert [unit.symbol for unit in (LENGTH, ANGLE, AREA, RATIO)] == ["px", "deg", "px2", ""]
