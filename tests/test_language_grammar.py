"""The grammar of requests: what must hold for any wording, and the forms that it reads alike."""

from __future__ import annotations

import itertools
from typing import Any

import pytest
from test_language_requests import DATA, SCENES, canonical, translate

from iconjax.errors import TranslationError
from iconjax.language.chunks import Chunk, chunk
from iconjax.language.grammar import parser, parses, terminal
from iconjax.language.lexicon import lexicon
from iconjax.language.names import Names
from iconjax.language.offline import OfflineTranslator
from iconjax.language.phrases import PhraseReader
from iconjax.language.ranking import best_trees
from iconjax.language.senses import CATEGORIES
from iconjax.language.words import tokenise

WITHOUT_TERMINAL = {"unsupported", "side"}
"""Categories that refuse a request, and that only stand inside noun phrases."""
INDEPENDENT = (
    "make the roof 10% wider",
    "move the sun 30 px to the left",
    "turn the tree by 12 degrees clockwise",
    "make the door half as tall as the house",
    "raise the fence by 20 px",
)


def meaning(scene: str, request: str) -> frozenset[Any]:
    return frozenset(canonical(line) for line in translate(scene, request))


def pieces(scene: str, request: str) -> list[Chunk]:
    return chunk(tokenise(request), lexicon(), Names(SCENES[scene], lexicon()))


def terminals() -> set[str]:
    return {symbol.name for rule in parser().rules for symbol in rule.expansion if symbol.is_term}


@pytest.mark.parametrize("joint", [", ", " and ", ". ", "; ", " then "])
def test_order_of_independent_clauses(joint: str) -> None:
    for chosen in itertools.combinations(INDEPENDENT[:4], 3):
        assert len({meaning("house", joint.join(order)) for order in itertools.permutations(chosen)}) == 1


def test_clauses_add_up() -> None:
    """Two requests in one are the two requests."""
    for one, other in itertools.combinations(INDEPENDENT, 2):
        assert meaning("house", f"{one} and {other}") == meaning("house", one) | meaning("house", other)


@pytest.mark.parametrize("request_", INDEPENDENT)
@pytest.mark.parametrize("form", ["please {}", "{} please", "just {}", "could you {}?", "{}, please!", "{}."])
def test_politeness_changes_nothing(request_: str, form: str) -> None:
    assert meaning("house", form.format(request_)) == meaning("house", request_)


def test_every_terminal_is_produced() -> None:
    declared = terminals()
    produced = set()
    for case in DATA["requests"]:
        names = Names(SCENES[case["scene"]], lexicon())
        try:
            produced |= {terminal(c) for c in chunk(tokenise(case["request"]), lexicon(), names) if c.kind != "unknown"}
        except TranslationError:
            continue
    extra = ("make the mug that much wider itself", "it is 20% wider as well", "the gap between the mug and the book")
    extra = (*extra, "until it is as wide as the mug with the book", "both by 20 px: same")
    extra = (*extra, "match the mug wider than the book, wide like the book")
    for request in extra:
        produced |= {terminal(c) for c in pieces("desk", request)}
    assert produced == declared


def test_every_category_is_a_terminal() -> None:
    declared = terminals()
    entries = {e for several in lexicon().phrases.values() for e in map(_hashable, several) if e[0] in CATEGORIES}
    for category, value, info in entries:
        if category not in WITHOUT_TERMINAL:
            entry = next(e for es in lexicon().phrases.values() for e in es if _hashable(e) == (category, value, info))
            kind = "without" if value == "without" else category
            assert terminal(Chunk(kind, value, entry, value, 0, 1)) in declared


def _hashable(entry: Any) -> tuple[str, str, str]:
    return entry.category, entry.value, repr(sorted((k, v) for k, v in entry.info.items() if k == "degree"))


def test_parses_come_best_first() -> None:
    request = "move the sun above the house and the tree and the fence up by 10 px, by 20 px"
    forest: Any = parser().parse(pieces("house", request))
    ranked = best_trees(forest, 50, 12)
    ranks = [rank for rank, _ in ranked]
    assert len(ranked) > 5
    assert ranks == sorted(ranks, reverse=True)
    assert len({str(tree) for _, tree in ranked}) == len(ranked)
    assert [rank for rank, _ in best_trees(forest, 3, 12)] == ranks[:3]


def test_every_piece_is_in_every_parse() -> None:
    for request in ("put the tree next to the house and the fence to the left of the sun", " and ".join(INDEPENDENT)):
        cut = pieces("house", request)
        for tree in parses(cut):
            assert [t.value for t in tree.scan_values(lambda _: True)] == cut


@pytest.mark.parametrize(
    ("scene", "request_", "first", "second"),
    [
        (
            "house",
            "put the tree next to the house and the fence to the left of the sun",
            'on_left("Fence", "Sun")',
            'on_left("Tree", "Sun")',
        ),
        (
            "house",
            "move the sun above the house and the tree up by 10 px",
            'equal(minus(center_y("Tree"), center_y(old("Tree"))), -10)',
            'on_top("Sun", "Tree")',
        ),
    ],
)
def test_ambiguous_attachment_gives_both_readings(scene: str, request_: str, first: str, second: str) -> None:
    translation = OfflineTranslator(readings=4).translate(request_, SCENES[scene])
    assert translation.program == translation.readings[0].program
    assert len({r.gloss for r in translation.readings}) == len(translation.readings) > 1
    wanted = canonical(first), canonical(second)
    assert wanted[0] in map(canonical, translation.readings[0].program)
    assert wanted[1] not in map(canonical, translation.readings[0].program)
    assert any(wanted[1] in map(canonical, r.program) for r in translation.readings[1:])


def test_one_reading_is_the_default() -> None:
    request = "put the tree next to the house and the fence to the left of the sun"
    several = OfflineTranslator().with_readings(3).translate(request, SCENES["house"])
    one = OfflineTranslator().translate(request, SCENES["house"])
    assert one.readings == ()
    assert one.program == several.program
    assert len(several.readings) > 1


def test_an_unclear_word_is_named() -> None:
    with pytest.raises(TranslationError, match="Words not understood: the book"):
        translate("desk", "shrink the mug by 20 % the book")


ALIKE = [
    # adverbials and aims in front
    ("desk", "narrow the table by 40 %", "by 40 %, narrow the table", "by 40 % narrow the table"),
    ("desk", "raise the mug until it touches the lamp", "until it touches the lamp, raise the mug"),
    ("house", "put the tree to the left of the house", "to the left of the house, put the tree"),
    # things first, without verbs, as a heading, in the passive, as a question
    ("desk", "move the mug 30 px to the left", "mug 30 px left", "mug: left 30 px", "30 px to the left: the mug"),
    ("desk", "shift the mug left by 30 px", "the mug should be moved to the left by 30 px"),
    ("desk", "move the mug up 20 px", "could the mug be moved 20 px up?", "take the mug and move it 20 px up"),
    ("house", "make the roof 10% wider and the door 20% taller", "roof 10% wider, door 20% taller"),
    ("house", "make the roof 10% wider and the door 20% taller", "roof: 10% wider, door: 20% taller"),
    ("desk", "make the lamp 30% taller", "I want a 30% taller lamp", "I'd like a lamp that is 30% taller"),
    ("desk", "set the height of the mug to 80 px", "mug: height 80 px", "let the height of the mug be 80 px"),
    # descriptions that lead up to what should change
    ("house", "make the door 20% bigger", "the door is tiny: make it 20% bigger", "the door is too small. 20% bigger"),
    ("desk", "make the mug 20% bigger", "bigger mug! 20% bigger", "make the mug bigger: 20%"),
    ("desk", "tilt the lamp by 10 degrees clockwise", "the lamp leans. tilt it by 10 degrees clockwise"),
    # amounts said afterwards
    ("desk", "make the mug 20% bigger", "make the mug bigger, by 20%", "make the mug a bit bigger, 20 %"),
    ("desk", "scale the mug to 70%", "mug smaller, 70%", "mug smaller, to 70 %"),
    # what neighbours leave to each other
    ("house", "move the sun up by 10 px and move the tree up by 20 px", "move the sun up by 10 and the tree by 20 px"),
    ("house", "raise the sun by 20 px and lower the fence by 20 px", "raise the sun and lower the fence by 20 px"),
    ("house", "widen the sun by 20% and widen the tree by 20%", "make the sun 20% wider and the tree as well"),
    ("house", "widen the sun by 20% and widen the tree by 20%", "make the sun 20% wider and the tree"),
    ("house", "turn the tree by 10 degrees clockwise", "turn the tree clockwise by 10 degrees"),
    ("house", "raise the roof by 30 px and the sun by 30 px", "raise the roof by 30 px and the sun that much"),
    ("desk", "swap the mug and the book", "swap the mug with the book"),
    # as spoken
    ("desk", "make the mug 20% wider and lower the book by 10 px", "make the mug 20% wider lower the book by 10 px"),
    # what stays
    ("house", "widen the tree by 20%, keep its height", "make the tree 20% wider but not taller"),
    ("house", "widen the tree by 20%, keep its height", "tree 20% wider, same height"),
    ("house", "widen the tree by 20%, keep its height", "tree 20% wider, height unchanged"),
    ("desk", "move the mug left until it touches the lamp", "move the mug left until the lamp touches it"),
    ("desk", "align the left sides of the mug and the book", "left-align the mug and the book"),
    ("desk", "make the mug 20% wider and keep the lamp", "make the mug 20% wider, not the lamp"),
    ("desk", "cut the lamp's pole by 20%, its base stays", "cut the lamp's pole by 20%, with its base staying put"),
]  # fmt: skip


@pytest.mark.parametrize("case", ALIKE, ids=lambda c: c[-1])
def test_reads_alike(case: tuple[str, ...]) -> None:
    scene, *requests = case
    assert len({meaning(scene, request) for request in requests}) == 1


@pytest.mark.parametrize(
    ("scene", "request_"),
    [
        ("desk", "move the mug the book"),
        ("desk", "make the mug 20% wider than it is tall"),
        ("desk", "make the mug as tall as the lamp 20%"),
        ("desk", "the mug is tall"),
        ("desk", "make the lamp taller. make the mug 20% wider"),
        ("desk", "move the mug to the left, the book"),
        ("desk", "raise the roof that much"),
        ("house", "turn the tree and move the sun to the left by 20 degrees"),
        ("desk", "lamp"),
        ("desk", "20 %"),
    ],
)
def test_what_is_left_open_is_refused(scene: str, request_: str) -> None:
    with pytest.raises(TranslationError):
        translate(scene, request_)


def test_a_part_is_told_apart_by_its_whole() -> None:
    """ "The body on the vase" is the vase's, of the several bodies."""
    words = tokenise("the handle on the mug")
    reader = PhraseReader(words, lexicon(), Names(SCENES["desk"], lexicon()))
    got = reader.read(0)
    assert got is not None and got[0].owner is None  # there is only one handle: a place, perhaps
    assert meaning("flower", "make the body on the vase 20% wider") == meaning(
        "flower", "make the body of the vase 20% wider"
    )
