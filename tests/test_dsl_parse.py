"""Parser, type check and printer: what is accepted, what every error says, and what hostile input meets."""

from __future__ import annotations

import subprocess
import sys
import time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from iconjax.dsl.nodes import Call, Number, Point, Program, SegmentRef, segment_names
from iconjax.dsl.parse import MAX_CALLS, MAX_DEPTH, parse, parse_syntax
from iconjax.dsl.pretty import to_text
from iconjax.dsl.registry import default_registry
from iconjax.errors import ProgramError

NAMES = ("Lamp:Shade", "Lamp:Foot", "Plant", "Pot #1", "Pot #2")
OBJECTS = ("Lamp", "Plant", "Pot #1", "Pot #2")


def problems(text):
    """(line, column, message) of every problem of a program."""
    with pytest.raises(ProgramError) as caught:
        parse(text, NAMES, OBJECTS)
    assert "\n" not in str(caught.value)
    return [(p.line, p.column, p.message) for p in caught.value.problems]


def only(text):
    """The one problem's message."""
    (found,) = problems(text)
    return found[2]


def test_a_program_is_one_call_a_line_with_comments():
    text = '# size first\nscale("Pot #1")  # by half\n\ntouch("Plant", "Lamp:Shade")\n'
    assert parse(text, NAMES, OBJECTS) == Program(
        (
            Call("scale", (SegmentRef("Pot #1"),)),
            Call("touch", (SegmentRef("Plant"), SegmentRef("Lamp:Shade"))),
        )
    )


def test_a_list_of_calls_counts_entries():
    assert len(parse(['stay("Plant")', 'rotate("Lamp")'], NAMES, OBJECTS).calls) == 2
    assert problems(['stay("Plant")', 'rotat("Lamp")'])[0][:2] == (2, 1)


def test_positions_are_one_based_and_do_not_enter_comparison():
    (call,) = parse('\n  touch("Plant", "Lamp")', NAMES, OBJECTS).calls
    assert (call.line, call.column) == (2, 3)
    assert (call.args[1].line, call.args[1].column) == (2, 18)
    assert call == parse('touch("Plant","Lamp")', NAMES, OBJECTS).calls[0]


def test_columns_count_characters():
    assert problems('touch("Länge", "Plant")')[0][:2] == (1, 7)
    with pytest.raises(ProgramError) as caught:
        parse('touch("Länge", "Plnt")', ("Länge", "Plant"), ())
    assert caught.value.problems[0].column == 16


def test_a_call_may_take_several_lines():
    text = 'equal(\n  vert_len("Plant"),  # now\n  120\n)\nstay("Lamp")'
    assert [c.name for c in parse(text, NAMES, OBJECTS).calls] == ["equal", "stay"]


def test_numbers_points_and_minus():
    text = 'equal(-center_x("Plant"), -3)\ncoincide_on_point("Plant", [1, -2.5], "Lamp", (3e1, 4))'
    first, second = parse(text, NAMES, OBJECTS).calls
    assert first.args == (
        Call("mul", (Number(-1), Call("center_x", (SegmentRef("Plant"),)))),
        Number(-3),
    )
    assert second.args[1::2] == (Point(1, -2.5), Point(30, 4))


def test_every_name_of_the_scene_and_the_canvas_is_valid():
    for name in (*NAMES, *OBJECTS, "canvas"):
        assert segment_names(parse([f'inside("Plant", "{name}")'], NAMES, OBJECTS).calls[0])[-1] == name


def test_names_may_be_left_unchecked():
    assert parse('stay("Anything")', None).calls


def test_all_errors_are_reported_at_once_in_order():
    text = (
        'tuoch("Plant", "Pto #1")\n'
        "  equal(vert_len(Plant) 0.5)\n"
        'vert_len("Plant")\n'
        'equal(angle("Plant", "Lamp"), vert_len("Plant"))\n'
        'equal(max_x("Plant"))\n'
        'rotate(top("Plant"))'
    )
    found = problems(text)
    assert [(line, column) for line, column, _ in found] == [
        (1, 1),
        (1, 16),
        (2, 9),
        (3, 1),
        (4, 1),
        (5, 1),
        (6, 8),
    ]
    assert 'did you mean "touch"?' in found[0][2]
    assert 'did you mean "Pot #1"?' in found[1][2]
    assert "states nothing" in found[3][2]
    assert "an angle and a length" in found[4][2]
    assert "2 arguments, not 1" in found[5][2]
    assert "by its name" in found[6][2]


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ('stay("lamp:shade")', 'did you mean "Lamp:Shade"?'),
        ('stay("Shade")', 'did you mean "Lamp:Shade"?'),
        ('stay("Zebra")', 'no segment is named "Zebra"'),
        ("stay(Plant)", 'as a string: "Plant"'),
        ('stay("canvas")', "does not move"),
        ('stay(old("Plant"))', "by its name"),
        ('together(union("Plant", left("Lamp")))', "by its name"),
        ('touch("Plant", 3)', "takes a segment here, not a value"),
        ('equal("Plant", 3)', "takes a value here, not a segment"),
        ('equal(touch("Plant", "Lamp"), 0)', "a constraint of its own"),
        ('equal(stay("Plant"), 0)', "a motion"),
        ('coincide_on_point("Plant", 3, "Lamp", [1, 2])', "takes a point"),
        ('coincide_on_point("Plant", [3], "Lamp", [1, 2])', "two numbers"),
        ('coincide_on_point("Plant", [3, "x"], "Lamp", [1, 2])', "two numbers"),
        ('equal(1 + 2, min_x("Plant"))', "plus(a, b)"),
        ('equal(min_x("Plant") / 2, 3)', "div(a, b)"),
        ('stay(segment="Plant")', "no keyword arguments"),
        ('stay(*["Plant"])', "only calls"),
        ('scene.stay("Plant")', "bare name"),
        ('x = stay("Plant")', "every line is one call"),
        ('stay("Plant"),', "every line is one call"),
        ("import os", "every line is one call"),
        ('equal(True, min_x("Plant"))', "neither a number"),
        ('equal(1j, min_x("Plant"))', "neither a number"),
        ('equal(nan, min_x("Plant"))', "as a string"),
        ('equal(1e999, min_x("Plant"))', "a number is at most"),
        ('equal(10000000000000000000000, min_x("Plant"))', "a number is at most"),
        ('stay(f"{1}")', "only calls"),
        ('equal((lambda: 1)(), min_x("Plant"))', "bare name"),
        ('stay("Plant"', "not a call"),
        ("", "empty"),
        ("# nothing\n\n", "empty"),
        ("equal(min(1), 2)", "2 or more"),
    ],
)
def test_errors_say_what_is_wrong(text, says):
    assert says in only(text)


def test_a_broken_line_leaves_the_others_readable():
    found = problems('touch("Plant",\n\nstay("Lamp")\nstay("Zebra")')
    assert [line for line, *_ in found] == [1, 4]


def test_problems_in_one_call_are_not_repeated_upwards():
    assert only('equal(plus(vert_len("Plant"), angle("Plant", "Lamp")), 3)').startswith("plus cannot combine")
    assert "no operator" in only('equal(vertlen("Plant"), angle("Plant", "Lamp"))')


@pytest.mark.parametrize(
    "text",
    [
        "min(" * 10_000 + "1" + ")" * 10_000,
        "equal(" * 1_500,
        "(" * 150 + "1" + ")" * 150,
        "-" * 7_000 + "1",
        "+".join("1" * 3_000),
        "a" * 2_000_000,
        "stay('Plant')\n" * 90_000,
        "\n" * 200_000,
        "stay('Plant');" * 600,
        "x\n" * 49_000,
        "[" * 30 + "]" * 30,
        f"equal({'9' * 5_000}, 1)",
        "stay('\ud800')",
        "stay('Plant\0')",
        "\ufeff\x0c\x1b",
        "stay('Plant'\\",
        "'''",
    ],
    ids=range(17),
)
def test_hostile_programs_meet_one_clear_error(text):
    start = time.perf_counter()
    with pytest.raises(ProgramError) as caught:
        parse(text, NAMES, OBJECTS)
    assert time.perf_counter() - start < 2
    assert len(str(caught.value)) < 3_000
    assert "\n" not in str(caught.value)


def test_limits_are_wide_enough_for_real_programs():
    assert len(parse(['stay("Plant")'] * MAX_CALLS, NAMES, OBJECTS).calls) == MAX_CALLS
    nested = "1"
    for _ in range(MAX_DEPTH - 2):
        nested = f"plus({nested}, 1)"
    assert parse(f'smaller(min_x("Plant"), {nested})', NAMES, OBJECTS)


def test_nothing_is_evaluated(tmp_path):
    target = tmp_path / "made"
    with pytest.raises(ProgramError):
        parse(f'stay(open("{target}", "w"))', NAMES, OBJECTS)
    assert not target.exists()


def test_parsing_needs_no_jax():
    code = (
        "import sys; from iconjax.dsl.parse import parse; "
        "parse('touch(\"A\", \"B\")', ['A', 'B'], []); assert 'jax' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def _programs():
    names = st.text(st.characters(exclude_categories=["Cs"]), max_size=12)
    numbers = st.floats(-1e8, 1e8) | st.integers(-(10**8), 10**8).map(float)
    leaves = st.builds(Number, numbers) | st.builds(SegmentRef, names) | st.builds(Point, numbers, numbers)
    operators = st.sampled_from(sorted(default_registry().operators))

    def call(arguments):
        return st.builds(Call, operators, st.lists(arguments, max_size=3).map(tuple))

    calls = call(st.recursive(leaves, call, max_leaves=8))
    return st.builds(Program, st.lists(calls, min_size=1, max_size=4).map(tuple))


@settings(max_examples=150, deadline=None)
@given(_programs())
def test_what_is_printed_parses_back(program):
    again, found = parse_syntax(to_text(program))
    assert not found
    assert again == program
    assert parse_syntax("\n".join(to_text(program)))[0] == program


@settings(max_examples=150, deadline=None)
@given(st.text(max_size=80) | st.text('stay("Plant"),[]1-#\n\\ ', max_size=80))
def test_any_text_parses_or_raises_a_program_error(text):
    try:
        parse(text, NAMES, OBJECTS)
    except ProgramError as error:
        assert all(p.line >= 1 and p.column >= 1 for p in error.problems)
