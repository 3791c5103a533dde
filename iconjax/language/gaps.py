"""What is said of the space between two things, brought into one plain form: "the gap between A and B"."""

from __future__ import annotations

import re
from collections.abc import Sequence

from iconjax.language.lexicon import Lexicon
from iconjax.language.names import Names
from iconjax.language.phrases import PhraseReader

SPACES = frozenset({"gap", "space", "distance", "clearance", "air", "room", "margin", "spacing", "gaps", "breathing"})
SENTENCE = frozenset({".", ";", "!", "?", ":"})
THAT = ("that", "this", "the", "their", "its", "it")
CHANGES = {
    "open": "increase", "widen": "increase", "enlarge": "increase", "extend": "increase", "stretch": "increase",
    "close": "reduce", "narrow": "reduce", "shrink": "reduce", "tighten": "reduce", "shorten": "reduce",
}  # fmt: skip
"""Verbs of other things -> what they ask of a gap."""
OF_NOW = re.compile(
    r"\b(twice|times|thrice|%|half|thirds|quarters|percent) (?:of )?what it (?:is|was)"
    r"(?: now| today| right now)?(?= [.;:,!?]|$)"
)
FACING = (("bottom", "top"), ("right", "left"), ("top", "bottom"), ("left", "right"))


def gaps_named(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "There's hardly any air between A and B. Open that gap up to twice what it is." is about the gap of A and B."""
    at = next((i for i, w in enumerate(words) if w in SPACES and words[i + 1 : i + 2] == ["between"]), None)
    if at is None or names.hear(words[at]) is not None:
        return words
    last = next((i for i in range(at, len(words)) if words[i] in SENTENCE), len(words))
    start = max((i + 1 for i in range(at) if words[i] in SENTENCE), default=0)
    pair = _pair(words, at + 2, lexicon, names)
    later = words[last + 1 :]
    if pair is None or not later or _measured(words[start:last], lexicon):
        return words
    told = ["the", "gap", "between", *words[at + 2 : pair]]
    where = _back(later, lexicon, names)
    if where is None or start > 0:
        return words
    names.notes.append(f'left aside: "{" ".join(words[start:last])}"')
    return [*later[: where[0]], *told, *later[where[1] :]]


def _pair(words: Sequence[str], i: int, lexicon: Lexicon, names: Names) -> int | None:
    """The end of "A and B" at `i`."""
    reader = PhraseReader(words, lexicon, names)
    first = reader.read(i)
    if first is None:
        return None
    if first[0].plural:
        return first[1]
    second = reader.read(first[1] + 1) if list(words[first[1] : first[1] + 1]) == ["and"] else None
    return second[1] if second is not None else None


def _back(words: Sequence[str], lexicon: Lexicon, names: Names) -> tuple[int, int] | None:
    """Where words speak of a space said before: "that gap", "it" before any other thing."""
    for i, word in enumerate(words):
        if word in SPACES and names.hear(word) is None:
            return (
                None if list(words[i + 1 : i + 2]) == ["between"] else (i - (words[i - 1] in THAT if i else 0), i + 1)
            )
        if word == "it":
            return i, i + 1
        if names.hear(word) is not None and not lexicon.knows(word, {"verb", "adjective", "direction"}):
            return None
    return None


def _measured(words: Sequence[str], lexicon: Lexicon) -> bool:
    amounts = {"number", "fraction", "multiple", "unit"}
    return any(w.isdigit() or (w not in ("a", "an", "one") and lexicon.knows(w, amounts)) for w in words)


def gap_of(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "A gap of 100 px from A to B" is a gap between A and B that should be 100 px; facing sides go without saying."""
    text = " ".join(words)
    found = re.search(
        r"(?:(?:so that|leaving|with|to|have|leave|make|keep) )?(?:there (?:is|are|remains) )?"
        rf"(?:a |an |the )?(?:{'|'.join(SPACES)}) of (\d+(?:\.\d+)? (?:px|pixels)) (from|between) ([^.;:,!?]+)",
        text,
    )
    if found is None:
        return words
    things = found[3] if found[2] == "between" else re.sub(r" to ", " and ", found[3], count=1)
    plain = f"the gap between {things} should be {found[1]}"
    before = text[: found.start()].rstrip(" ,")
    return f"{before} {';' if before and before[-1].isalnum() else ''} {plain} {text[found.end() :]}".split()


def without_facing(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "The gap between the bottom of A and the top of B" is that between A and B."""
    for at, word in enumerate(words):
        if word not in SPACES or words[at + 1 : at + 2] not in (["between"], ["from"]):
            continue
        first = _side(words, at + 2, lexicon)
        joint = next((k for k in range(at + 3, len(words)) if words[k] in ("and", "to")), len(words))
        second = _side(words, joint + 1, lexicon)
        if first is None or second is None or (first[0], second[0]) not in FACING:
            continue
        return [*words[: at + 1], "between", *words[first[1] : joint], "and", *words[second[1] :]]
    return words


def _side(words: Sequence[str], i: int, lexicon: Lexicon) -> tuple[str, int] | None:
    """The side in "the underside of" at `i`, and where the thing begins."""
    i += list(words[i : i + 1]) == ["the"]
    got = lexicon.match(words, i, "side") if i < len(words) else None
    return (got[0].value, got[1] + 1) if got is not None and list(words[got[1] : got[1] + 1]) == ["of"] else None


def gap_verbs(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "Open the gap up to twice what it is now": increase it to twice."""
    at = next(
        (i for i, w in enumerate(words) if w in ("gap", "distance", "space") and words[i + 1 : i + 2] == ["between"]), 0
    )
    verb = next((i for i in range(max(0, at - 2), at) if words[i] in CHANGES), None)
    if verb is None:
        return words
    rest = " ".join(words[at:])
    rest = re.sub(r" (?:up|down|out) (?=to |by )", " ", OF_NOW.sub(r"\1", rest), count=1)
    return [*words[:verb], CHANGES[words[verb]], *words[verb + 1 : at], *rest.split()]
