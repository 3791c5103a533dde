"""How the things of a picture are found by what people call them."""

from __future__ import annotations

import pytest
from test_language_requests import SCENES

from iconjax.errors import TranslationError
from iconjax.language.context import Context
from iconjax.language.lexicon import lexicon
from iconjax.language.names import Names
from iconjax.language.phrases import PhraseReader
from iconjax.language.words import mend, tokenise


def find(scene: str, text: str) -> tuple[str, ...]:
    names = Names(SCENES[scene], lexicon())
    words = tokenise(text)
    got = PhraseReader(words, lexicon(), names).read(0)
    assert got is not None and got[1] == len(words), got
    return Context(names).one(got[0]).names


@pytest.mark.parametrize(
    ("scene", "text", "names"),
    [
        ("desk", "the lamp", ["Lamp"]),
        ("desk", "THE LAMPSHADE", ["Lamp:Shade"]),
        ("desk", "lamp's shade", ["Lamp:Shade"]),
        ("desk", "the shade of the lamp", ["Lamp:Shade"]),
        ("desk", "both legs of the table", ["Table:Left Leg", "Table:Right Leg"]),
        ("desk", "the table top", ["Table:Top"]),
        ("house", "the window on the right", ["House:Right Window"]),
        ("house", "all the windows", ["House:Left Window", "House:Right Window"]),
        ("cake", "the second candle from the right", ["Candle #2"]),
        ("cake", "the first candle from the right", ["Candle #3"]),
        ("cake", "the leftmost candle", ["Candle #1"]),
        ("cake", "the middle candle", ["Candle #2"]),
        ("bridge", "the last pillar", ["Bridge:Third Pillar"]),
        ("bridge", "the middle pillar", ["Bridge:Second Pillar"]),
        ("balloons", "the balloons", ["Balloons:Left", "Balloons:Middle", "Balloons:Right"]),
        ("balloons", "the middle balloon", ["Balloons:Middle"]),
        ("street", "the car's wheels", ["Car:Rear Wheel", "Car:Front Wheel"]),
        ("street", "the car's tyres", ["Car:Rear Wheel", "Car:Front Wheel"]),
        ("birds", "the beak of the left bird", ["Left Bird:Beak"]),
        ("birds", "the two birds", ["Left Bird", "Right Bird"]),
        ("desk", "the picture", ["canvas"]),
    ],
)  # fmt: skip
def test_finds(scene: str, text: str, names: list[str]) -> None:
    assert find(scene, text) == tuple(names)


@pytest.mark.parametrize(
    ("scene", "text"),
    [("desk", "the leg"), ("birds", "the bird"), ("birds", "the beak"), ("desk", "the leg of the lamp")],
)
def test_ambiguous_or_missing(scene: str, text: str) -> None:
    with pytest.raises(TranslationError):
        find(scene, text)


def test_mend() -> None:
    known = ["candle", "handle", "shade", "plane"]
    assert mend("cnadle", known) == "candle"
    assert mend("candel", known) == "candle"
    assert mend("shde", known) == "shade"
    assert mend("plate", known) is None  # another word, not a slip
    assert mend("andle", known) is None  # two are as near
