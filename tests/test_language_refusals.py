"""What the offline translator refuses, and what it says about it: a wrong reading is worse than none."""

from __future__ import annotations

import pytest
from test_language_requests import SCENES, translate

from iconjax.errors import TranslationError
from iconjax.language.offline import OfflineTranslator


@pytest.mark.parametrize(
    ("scene", "request_", "says"),
    [
        ("desk", "make it happier", "happier"),
        ("desk", "make the mug and the elephant bigger", "elephant"),
        ("desk", "make the mug 20% wider and shinier", "shinier"),
        ("house", "make the window wider", "House:Left Window"),
        ("house", "move the chimney to the left side of the roof", "beside"),
        ("house", "move the sun", "direction"),
        ("house", "rotate the sun", "angle"),
        ("house", "resize the tree", "how much"),
        ("house", "shrink the tree by 100%", "leave nothing"),
        ("house", "stretch the tree by 20%", "which way"),
        ("house", "make the door 20 px higher", "may be"),
        ("house", "make the house's crown 20% wider", "crown"),
        ("house", "move the tree behind the house", "in front or behind"),
        ("house", "paint the door", "colours"),
        ("house", "move the fifth window up by 10 px", "fifth window"),
        ("birds", "swap the nest", "two things"),
        ("birds", "make the three birds 10% bigger", "three birds"),
        ("cake", "keep the cake where it is", "what should change"),
        ("dog", "the head of the cat should be larger", "cat"),
        ("house", "level the sun", "long direction"),
        ("bridge", "", ""),
        ("bridge", "?!", ""),
    ],
)  # fmt: skip
def test_says_why(scene: str, request_: str, says: str) -> None:
    with pytest.raises(TranslationError) as caught:
        translate(scene, request_)
    message = str(caught.value)
    assert says in message
    assert "\n" not in message
    assert "The picture knows: " in message


def test_refusal_says_what_was_understood() -> None:
    with pytest.raises(TranslationError, match=r"Understood: Lamp: height becomes 1.2 times"):
        translate("desk", "Make the lamp 20% taller, then move the mug")


def test_guesses_are_told() -> None:
    """An amount that the request does not name is chosen, and the reading says so."""
    translation = OfflineTranslator().translate("make the lamp taller", SCENES["desk"])
    assert "names no amount" in translation.understood[0]


def test_mended_words_are_told() -> None:
    translation = OfflineTranslator().translate("shrnik the aple by 30%", SCENES["kitchen"])
    assert any('"aple" read as "apple"' in line for line in translation.understood)


def test_synonyms_are_told() -> None:
    translation = OfflineTranslator().translate("make the automobile 30% longer", SCENES["street"])
    assert any('"automobile" read as "car"' in line for line in translation.understood)
    assert translation.program[0] == 'scale("Car")'


@pytest.mark.parametrize(
    ("scene", "request_", "says"),
    [
        ("desk", "make the mug 20% wider, as if it weighed 2 kilos", "kilos"),
        ("desk", "shrink the mug on the book by 30%", "is not on"),
        ("desk", "put the mug on the table, on the left", "left"),
        ("house", "make the tree's crown as wide as the hole in the door", "hole"),
        ("house", "lower the left end of the fence to the ground", "left"),
        ("house", "make both suns 20% bigger", "are two"),
    ],
)
def test_rather_refuses_than_guesses(scene: str, request_: str, says: str) -> None:
    with pytest.raises(TranslationError) as caught:
        translate(scene, request_)
    assert says in str(caught.value)


def test_asides_are_told() -> None:
    """What only explains is left out, and the reading says so."""
    translation = OfflineTranslator().translate("tilt the lamp 10 degrees, as though it was drunk", SCENES["desk"])
    assert translation.program == (
        'rotate("Lamp")',
        'equal(angle("Lamp", old("Lamp")), 10)',
    )
    assert any("only explains" in line for line in translation.understood)
