"""What programs are read to ask of which segments."""

from __future__ import annotations

import pytest
from engine_support import intent, picture, rect

SHADE, FOOT, TABLE, BALL = range(4)


@pytest.fixture(scope="module")
def scene():
    """A lamp of two parts, a table, a ball."""
    shapes = {"Lamp:Shade": rect(40, 20, 80, 40), "Lamp:Foot": rect(55, 40, 65, 80)}
    return picture(shapes | {"Table": rect(10, 80, 110, 100), "Ball": rect(100, 20, 120, 40)})


def asked(found):
    """Members and kinds of every thing."""
    return {t.members: set(t.kinds) for t in found.things}


def test_a_motion_specifier_names_one_segment(scene):
    found = intent(scene, 'translate("Ball")\nequal(center_x("Ball"), 60)')
    assert asked(found) == {(BALL,): {"translate"}}


def test_an_object_is_one_thing_of_all_its_parts(scene):
    assert asked(intent(scene, 'rotate("Lamp")')) == {(SHADE, FOOT): {"rotate"}}


def test_kinds_asked_of_the_same_thing_add_up(scene):
    found = intent(scene, 'rotate("Ball")\nscale("Ball")\ntranslate("Lamp")')
    assert asked(found) == {(BALL,): {"rotate", "scale"}, (SHADE, FOOT): {"translate"}}


def test_the_smallest_thing_of_a_segment_comes_first(scene):
    found = intent(scene, 'translate("Lamp")\nscale("Lamp:Shade")')
    assert [t.members for t in found.things_of(SHADE)] == [(SHADE,), (SHADE, FOOT)]
    assert [t.members for t in found.things_of(FOOT)] == [(SHADE, FOOT)]
    assert found.things_of(TABLE) == ()


def test_what_is_told_to_stay_is_fixed_and_moves_with_nothing(scene):
    found = intent(scene, 'translate("Lamp")\nstay("Lamp:Foot")\nstay("Table")')
    assert found.fixed == {FOOT, TABLE}
    assert asked(found) == {(SHADE,): {"translate"}}


@pytest.mark.parametrize(
    ("call", "extents"),
    [
        ('equal(hori_len("Ball"), 30)', {"x"}),
        ('equal(vert_len("Ball"), 30)', {"y"}),
        ('equal(plus(hori_len("Ball"), vert_len("Ball")), 60)', {"x", "y"}),
        ('equal(long_len("Ball"), 30)', {"long"}),
        ('equal(short_len("Ball"), 30)', {"short"}),
        ('uniform("Ball")', {"uniform"}),
        ('equal(center_x("Ball"), 30)', set()),
        ('equal(hori_len("Table"), mul(0.5, hori_len(old("Ball"))))', set()),
    ],
)
def test_extents_are_those_that_the_program_speaks_of(scene, call, extents):
    (thing,) = [t for t in intent(scene, 'scale("Ball")\n' + call).things if t.members == (BALL,)]
    assert set(thing.extents) == extents


def test_an_extent_of_the_whole_is_one_of_its_parts(scene):
    found = intent(scene, 'scale("Lamp:Shade")\nequal(vert_len("Lamp"), 80)')
    assert found.things_of(SHADE)[0].extents == {"y"}


def test_an_extent_of_a_neighbour_is_not(scene):
    found = intent(scene, 'scale("Lamp:Shade")\nscale("Lamp:Foot")\nequal(vert_len("Lamp:Foot"), 80)')
    assert not found.things_of(SHADE)[0].extents and found.things_of(FOOT)[0].extents == {"y"}


def test_directions_are_noticed(scene):
    turns = {
        t.members[0]: t.turns
        for t in intent(scene, 'rotate("Ball")\nrotate("Table")\nequal(rotation("Ball"), 9)').things
    }
    assert turns == {BALL: True, TABLE: False}


@pytest.mark.parametrize(
    ("call", "kind"),
    [
        ('equal(center_x("Ball"), 60)', "translate"),
        ('on_left("Ball", "Table")', "translate"),
        ('equal(hori_len("Ball"), 30)', "scale"),
        ('equal(rotation("Ball"), 30)', "rotate"),
        ('parallel("Ball", "Table")', "rotate"),
    ],
)
def test_a_constraint_without_a_specifier_implies_the_motion_it_speaks_of(scene, call, kind):
    assert asked(intent(scene, call)) == {(BALL,): {kind}}


def test_nothing_is_implied_for_what_already_moves(scene):
    found = intent(scene, 'translate("Ball")\nequal(hori_len("Table"), minus(min_x("Ball"), 10))')
    assert asked(found) == {(BALL,): {"translate"}}


def test_nothing_is_implied_for_what_is_fixed(scene):
    found = intent(scene, 'stay("Table")\nequal(min_x("Table"), min_x("Ball"))')
    assert asked(found) == {(BALL,): {"translate"}}


@pytest.mark.parametrize(
    "keep",
    [
        'equal(center_x("Ball"), center_x(old("Ball")))',
        'equal(hori_len(old("Table")), hori_len("Table"))',
        'equal(rotation("Ball"), 0)',
        'equal(min_x(top("Lamp")), min_x(top(old("Lamp"))))',
    ],
)
def test_keeping_something_asks_for_no_motion(scene, keep):
    assert asked(intent(scene, keep)) == {}


def test_only_extents_that_change_count_as_changed(scene):
    keep, change = 'equal(hori_len("Ball"), hori_len(old("Ball")))', 'equal(vert_len("Ball"), 30)'
    assert intent(scene, f'scale("Ball")\n{keep}\n{change}').changed == {"y"}
    assert intent(scene, f'scale("Ball")\n{keep}').changed == set()
    both = intent(scene, f'scale("Ball")\n{change}\nequal(hori_len("Ball"), 30)')
    assert both.changed == {"x", "y"}


def test_what_is_only_compared_with_as_it_was_is_not_mentioned(scene):
    found = intent(scene, 'translate("Ball")\nequal(center_x("Ball"), center_x(old("Table")))')
    assert found.mentioned == {BALL}
    assert intent(scene, 'translate("Ball")\nequal(center_x("Ball"), center_x("Table"))').mentioned == {BALL, TABLE}


def test_what_was_is_not_asked_to_move(scene):
    assert asked(intent(scene, 'equal(center_x(old("Table")), center_x("Ball"))')) == {(BALL,): {"translate"}}


def test_where_a_moving_thing_was_is_no_mention_of_it(scene):
    found = intent(scene, 'translate("Ball")\nequal(center_x("Table"), center_x(old("Ball")))')
    assert asked(found) == {(BALL,): {"translate"}, (TABLE,): {"translate"}}


def test_the_canvas_is_nobody(scene):
    found = intent(scene, 'translate("Ball")\nequal(max_x("Ball"), max_x("canvas"))')
    assert found.mentioned == {BALL} and asked(found) == {(BALL,): {"translate"}}


def test_together_names_one_group(scene):
    assert intent(scene, 'translate("Ball")\ntogether("Ball", "Lamp")').together == (frozenset({BALL, SHADE, FOOT}),)


def test_put_on_top_means_above_and_touching(scene):
    above, touch = 'on_top("Ball", "Table")', 'touch("Table", "Ball")'
    assert intent(scene, f"{above}\n{touch}").placed == ((frozenset({BALL}), frozenset({TABLE})),)
    assert intent(scene, above).placed == () and intent(scene, touch).placed == ()


def test_hinges_are_pairs(scene):
    assert intent(scene, 'rotate("Lamp:Shade")\nhinge("Lamp:Shade", "Lamp:Foot")').hinged == (
        (frozenset({SHADE}), frozenset({FOOT})),
    )
