"""The thesaurus: words that mean the same are alike, words that do not are not."""

from __future__ import annotations

import pytest

from iconjax.language.thesaurus import closest_noun, likeness, speech, verb_like

ALIKE = [
    ("handle", "grip"), ("vessel", "boat"), ("blossom", "flower"), ("windshield", "windscreen"), ("crate", "box"),
    ("couch", "sofa"), ("stalk", "stem"), ("parcel", "package"), ("faucet", "tap"), ("automobile", "car"),
    ("lorry", "truck"), ("spire", "tower"), ("rod", "stick"), ("cap", "hat"), ("shaft", "rod"),
]  # fmt: skip
UNLIKE = [
    ("wheel", "door"), ("bread", "cup"), ("flame", "wax"), ("roof", "wall"), ("base", "top"), ("handle", "blade"),
    ("star", "moon"), ("left", "right"), ("tree", "flower"), ("cat", "dog"), ("window", "door"), ("arm", "head"),
]  # fmt: skip


@pytest.mark.parametrize(("word", "other"), ALIKE)
def test_words_for_one_thing_are_alike_either_way(word, other):
    assert likeness(word, other) >= 0.6
    assert likeness(word, other) == likeness(other, word)


@pytest.mark.parametrize(("word", "other"), UNLIKE)
def test_different_things_are_not(word, other):
    assert likeness(word, other) < 0.6


def test_plurals_count_as_their_singular():
    assert likeness("blossoms", "flower") == likeness("blossom", "flower")


def test_the_closest_has_to_be_clear_of_the_next():
    assert closest_noun("blossom", ["flower", "pot", "table"]) == ("flower", likeness("blossom", "flower"))
    assert closest_noun("blossom", ["flower", "bloom"]) is None
    assert closest_noun("xyzzy", ["flower"]) is None
    assert closest_noun("blossom", []) is None


def test_parts_of_speech():
    assert speech("neatly") == {"adv"}
    assert speech("shiny") == {"adj"}
    assert "verb" in speech("hoisted")
    assert speech("xyzzy") == frozenset()


def test_verbs_that_share_a_sense():
    assert verb_like("hoist", {"lift"}) == "lift"
    assert verb_like("hoisted", {"lift"}) == "lift"
    assert verb_like("eat", {"lift", "move"}) is None
