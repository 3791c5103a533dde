"""The same wish in other words gives the same program; what the picture does not show is never passed over."""

from __future__ import annotations

import pytest
from test_language_requests import SCENES, translate

from iconjax.errors import TranslationError
from iconjax.language.bearings import bearing, turning
from iconjax.language.canonical import canonical
from iconjax.language.offline import OfflineTranslator
from iconjax.language.shapes import Shapes


def meaning(scene: str, request: str) -> set[object]:
    return {canonical(line) for line in translate(scene, request)}


@pytest.mark.parametrize(
    ("scene", "plain", "others"),
    [
        (
            "desk",
            "make the mug 20% wider",
            [
                "mug width +20 %",
                "the mug: +20% width",
                "The mug needs another 20 % of width",
                "I'd love the mug 20% wider",
                "sorry to bother you, but could the mug be 20 percent wider?",
                "the cup should be 20% wider",
                "the mug is far too narrow. Make it 20% wider",
                "make the mug clearly 20% wider, if you would",
            ],
        ),
        (
            "desk",
            "make the lamp's shade 1.5 times as wide",
            [
                "the lampshade should be half as wide again",
                "lamp shade: width times 1.5",
            ],
        ),
        (
            "desk",
            "move the book 30 px to the right and 10 px up",
            ["book -> 30px right, 10px up", "move the book by +30 px in x and -10 px in y"],
        ),
        (
            "desk",
            "make the lamp's pole 25% shorter",
            [
                "The lamp wants to fit under a smaller cupboard: make its pole 25% shorter",
                "the lamp's pole should lose a quarter of its length",
                "shorten the lamp's pole by a quarter, so a child can reach it",
            ],
        ),
        (
            "desk",
            "shrink the lamp to 80%",
            ["lamp to 80 %", "the lamp at 80%, please", "shrink the lamp, shade and pole included, to 80%"],
        ),
        (
            "desk",
            "the gap between the mug and the book should be 20 px",
            ["leave a 20 px gap between the mug and the book", "there should be 20 px between the mug and the book"],
        ),
        (
            "desk",
            "make both legs of the table 10% longer",
            ["make the 2 table legs 10% longer", "table legs 10% longer each"],
        ),
    ],
)
def test_other_words_same_program(scene: str, plain: str, others: list[str]) -> None:
    wanted = meaning(scene, plain)
    for other in others:
        assert meaning(scene, other) == wanted, other


@pytest.mark.parametrize(
    ("scene", "request_"),
    [
        ("desk", "The gizmo is far too wide - make it 20% narrower"),  # "it" is the gizmo
        ("desk", "move the book to the left until it touches the gizmo"),
        ("desk", "The gizmo of the lamp: make it 10% taller"),
        ("desk", "make the gizmo leg 10% longer"),  # which of two
        ("desk", "the mug by 20% in width"),  # wider or narrower
        ("desk", "the mug 15%"),  # by or to
        ("desk", "shrink the mug to 140%"),
        ("desk", "the mug and the book 30 px further left and right"),
        ("desk", "scale the entire gizmo by 20%"),
    ],
)
def test_rather_refuses(scene: str, request_: str) -> None:
    with pytest.raises(TranslationError):
        translate(scene, request_)


def test_what_is_left_aside_is_told() -> None:
    told = OfflineTranslator().translate("No party today: make the mug 20% wider", SCENES["desk"]).understood
    assert any(line.startswith("left aside") for line in told)


def test_even_spacing_has_equal_gaps_between_the_outer_ones() -> None:
    program = translate("balloons", "space the balloons out evenly")
    assert any("minus(min_x" in line for line in program)
    assert any(line.startswith('stay("Balloons:Left")') for line in program)
    assert any(line.startswith('stay("Balloons:Right")') for line in program)


def test_outwards_depends_on_where_a_thing_is() -> None:
    shapes = Shapes(SCENES["desk"])
    legs = ("Table:Left Leg", "Table:Right Leg")
    assert [bearing(shapes, leg, "out", legs) for leg in legs] == ["left", "right"]
    assert [bearing(shapes, leg, "in", legs) for leg in legs] == ["right", "left"]


def test_a_leg_hangs_from_its_table() -> None:
    """What turns about its upper end swings left clockwise."""
    assert turning(Shapes(SCENES["desk"]), "Table:Left Leg", "left") == 1


def test_open_questions_become_readings() -> None:
    translator = OfflineTranslator().with_readings(3)
    turned = translator.translate("turn the book by 20 degrees", SCENES["desk"]).readings
    assert [r.program[-1] for r in turned][1:] == ['equal(rotation("Book"), 20)', 'equal(rotation("Book"), -20)']
    legs = translator.translate("make the leg of the table 10% longer", SCENES["desk"]).readings
    assert [r.program[0] for r in legs] == ['scale("Table:Left Leg")', 'scale("Table:Right Leg")']
    assert translator.translate("move the book 20 px up", SCENES["desk"]).readings == ()
