"""A request cut into typed pieces: noun phrases, amounts, verbs, relations, separators."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from iconjax.errors import TranslationError
from iconjax.language.lexicon import Entry, Lexicon
from iconjax.language.names import Names
from iconjax.language.phrases import PhraseReader
from iconjax.language.quantities import QuantityReader

CATEGORIES = (
    "unsupported",
    "separator",
    "instead",
    "apart",
    "upside_down",
    "relation",
    "fixed",
    "sense",
    "dim_idiom",
    "direction",
    "orient",
    "squarely",
    "together",
    "mutual",
    "rest",
    "mode",
    "places",
    "adjective",
    "dim",
    "verb",
    "side",
)
"""Categories in the order in which they win where they match equally long phrases."""
OPENERS = ("separator", "without", "verb", "mode")


@dataclass(frozen=True)
class Chunk:
    """A piece of a request.

    Attributes:
        kind: "phrase", "amount", "measure", "as", "than", "same", "too", "unknown" or a lexicon category.
        value: the lexicon's value, or "".
        data: the Phrase, Amount, Quantity or lexicon entry.
        text: as written.
        start: position of its first word.
        end: position behind its last word.
    """

    kind: str
    value: str
    data: Any
    text: str
    start: int
    end: int


def chunk(words: Sequence[str], lexicon: Lexicon, names: Names) -> list[Chunk]:
    """Cut a request into pieces, left to right, the longest reading first.

    Raises:
        TranslationError: the request asks for something that is not a change of place, pose or size.
    """
    phrases = PhraseReader(words, lexicon, names)
    quantities = QuantityReader(phrases)
    out: list[Chunk] = []
    i = 0
    while i < len(words):
        kind, value, data, end = _next(words, i, out, lexicon, names, phrases, quantities)
        if kind == "unsupported":
            raise TranslationError(f'"{" ".join(words[i:end])}": {value}')
        if kind != "stop":
            out.append(Chunk(kind, value, data, " ".join(words[i:end]).replace(" 's", "'s"), i, end))
        i = end
    return out


def _next(
    words: Sequence[str],
    i: int,
    out: list[Chunk],
    lexicon: Lexicon,
    names: Names,
    phrases: PhraseReader,
    quantities: QuantityReader,
) -> tuple[str, str, Any, int]:
    word = words[i]
    previous = out[-1].kind if out else "separator"
    if out and out[-1].value == "keep":
        previous = "keep"
    lexical = _lexical(words, i, previous, lexicon, phrases)
    reach = lexical[1] if lexical is not None else i
    amount = quantities.amount(i)
    if amount is None and previous in ("mode", "phrase"):
        amount = quantities.doubled(i)
    if (
        amount is not None
        and amount[1] >= reach
        and not (amount[0].unit == "none" and phrases.noun_at(amount[1], False))
    ):
        return "amount", "", amount[0], amount[1]
    measure = quantities.measure(i)
    if measure is not None and measure[1] > reach:
        return "measure", "", measure[0], measure[1]
    phrase = phrases.read(i)
    if out and _connects(words, i, lexicon):
        return "stop", "", None, i + 1
    if phrase is not None and phrase[1] > reach:
        return "phrase", "", phrase[0], phrase[1]
    if (
        phrase is not None
        and phrase[1] == reach
        and lexical is not None
        and lexical[0].category not in OPENERS
        and not lexicon.knows(word, {"direction", "adjective", "relation", "mode", "orient"})
    ):
        return "phrase", "", phrase[0], phrase[1]
    if word in ("as", "than", "same", "too") and reach <= i + 1:
        return word, "", None, i + 1
    if lexical is not None:
        return _meaning(i, *lexical, words, quantities, phrases)
    if lexicon.knows(word, {"stop"}) or word in ("whole", "entire", "both"):
        stop = lexicon.match(words, i, "stop")
        return "stop", "", None, stop[1] if stop else i + 1
    return "unknown", "", None, i + 1


def _meaning(
    i: int, entry: Entry, end: int, words: Sequence[str], quantities: QuantityReader, phrases: PhraseReader
) -> tuple[str, str, Any, int]:
    """What a lexical reading comes to where it stands."""
    if entry.value == "around" and _natural(words, end, phrases.lexicon, phrases.names):
        return "stop", "", None, end + 2
    if _idle(entry, end, words, quantities, phrases):
        return "stop", "", None, end
    announced = i > 0 and words[i - 1] in ("the", "a", "an", "its", "their")
    if entry.category == "verb" and entry.value != "make" and announced:
        return "unknown", "", None, end  # "the wind": a thing that the picture does not have
    return ("without" if entry.value == "without" else entry.category), entry.value, entry, end


def _lexical(
    words: Sequence[str], i: int, previous: str, lexicon: Lexicon, phrases: PhraseReader
) -> tuple[Entry, int] | None:
    """The longest lexical reading; among equals a verb wins where a clause begins, else CATEGORIES."""
    best: tuple[Entry, int] | None = None
    order = [c for c in CATEGORIES if c != "verb"]
    opening = previous in OPENERS or not lexicon.knows(words[i], set(order) - {"side", "places"})
    if previous == "keep" and (fixed := lexicon.match(words, i, "fixed")) is not None:
        return fixed
    order = ["verb", *order] if opening else [*order, "verb"]
    stops = lexicon.match(words, i, "stop")
    for category in order:
        got = lexicon.match(words, i, category)
        if got is None or (best is not None and got[1] <= best[1]):
            continue
        if category == "direction" and _announces(words, got[1], lexicon, phrases):
            continue
        if category == "adjective" and _turning(words, i, got[1], lexicon):
            continue
        if category == "unsupported" and names_noun(phrases, i):
            continue
        best = got
    if best is not None and stops is not None and stops[1] > best[1]:
        return None
    return best


def _announces(words: Sequence[str], end: int, lexicon: Lexicon, phrases: PhraseReader) -> bool:
    """Whether what looks like a direction goes on to name something: "to the left | leg"."""
    if not lexicon.knows(words[end - 1], {"modifier"}):
        return False
    if words[end : end + 1] == ["of"] and words[end - 1] in ("top", "bottom"):
        return True
    sides = (lexicon.match(words, at, "side") for at in (end - 1, end - 2) if at >= 0)
    return phrases.noun_at(end, False) or any(s is not None and s[1] > end for s in sides)


def _turning(words: Sequence[str], i: int, end: int, lexicon: Lexicon) -> bool:
    """Whether what may be an adjective is the verb: "have it lean | 15 degrees"."""
    verb = lexicon.match(words[:end], i, "verb")
    if verb is None or verb[0].value != "rotate":
        return False
    angle = any(
        lexicon.knows(w, {"unit"}) and lexicon.match([w], 0, "unit")[0].value == "deg"  # type: ignore[index]
        for w in words[end : end + 4]
    )
    return angle or any(lexicon.match(words, end, c) is not None for c in ("direction", "sense"))


def names_noun(phrases: PhraseReader, i: int) -> bool:
    """Whether the word at `i` names something in the picture."""
    return phrases.names.hear(phrases.words[i]) is not None


def _connects(words: Sequence[str], i: int, lexicon: Lexicon) -> bool:
    """Whether the word at `i` only leads to "is" and the like: "a leg that | is longer"."""
    verb = lexicon.match(words, i + 1, "verb")
    return words[i] in ("that", "which", "who") and verb is not None and verb[0].value == "make"


def _natural(words: Sequence[str], end: int, lexicon: Lexicon, names: Names) -> bool:
    """Whether a pivot is named that the picture does not know: "at the hinge", where it turns anyhow."""
    if words[end : end + 1] not in (["the"], ["its"]) or end + 1 >= len(words):
        return False
    spot, last = words[end + 1], end + 2 >= len(words) or lexicon.match(words, end + 2, "separator") is not None
    if not (last and lexicon.knows(spot, {"joint"}) and names.hear(spot) is None):
        return False
    names.notes.append(f'"{spot}" taken for where it is joined')
    return True


def _idle(entry: Entry, end: int, words: Sequence[str], quantities: QuantityReader, phrases: PhraseReader) -> bool:
    """Prepositions that here only introduce an amount or a measure: "in height", "about 20", "at last"."""
    following = phrases.word(end)
    if entry.category == "relation" and entry.value in ("around", "inside", "on", "along"):
        nothing = phrases.read(end) is None
        return (
            quantities.amount(end) is not None
            or (quantities.measure(end) is not None)
            or (nothing and following != "")
            or (nothing and following == "")
        )
    return entry.category == "side"
