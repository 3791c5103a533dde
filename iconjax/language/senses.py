"""Which reading of the lexicon is meant where words have several: by what is before and behind them."""

from __future__ import annotations

from collections.abc import Sequence

from iconjax.language.lexicon import Entry, Lexicon
from iconjax.language.likening import known_verb_like
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
ANNOUNCING = frozenset({"the", "a", "an", "its", "their"})


class Senses:
    """The readings that the lexicon has for the words of a request, chosen by their surroundings."""

    def __init__(self, words: Sequence[str], lexicon: Lexicon, names: Names) -> None:
        self.words, self.lexicon, self.names = words, lexicon, names
        self.phrases = PhraseReader(words, lexicon, names)
        self.quantities = QuantityReader(self.phrases)

    def lexical(self, i: int, previous: str) -> tuple[Entry, int] | None:
        """The longest lexical reading; among equals a verb wins where a clause begins, else CATEGORIES."""
        words, lexicon = self.words, self.lexicon
        order = [c for c in CATEGORIES if c != "verb"]
        opening = previous in OPENERS or not lexicon.knows(words[i], set(order) - {"side", "places"})
        if previous == "keep" and (fixed := lexicon.match(words, i, "fixed")) is not None:
            return fixed
        best: tuple[Entry, int] | None = None
        for category in ["verb", *order] if opening else [*order, "verb"]:
            got = lexicon.match(words, i, category)
            if got is not None and (best is None or got[1] > best[1]) and not self._bars(i, got):
                best = got
        if best is None and previous in OPENERS:
            best = self._verb_like(i)
        stops = lexicon.match(words, i, "stop")
        return None if best is not None and stops is not None and stops[1] > best[1] else best

    def _verb_like(self, i: int) -> tuple[Entry, int] | None:
        """An unknown verb as the one of the lexicon that shares a sense with it."""
        word = self.words[i]
        if not word.isalpha() or word in self.lexicon.words or self.names.hear(word) is not None:
            return None
        entry = known_verb_like(word, self.lexicon)
        if entry is None:
            return None
        self.names.notes.append(f'"{word}" read as "{entry.info["base"]}"')
        return entry, i + 1

    def _bars(self, i: int, got: tuple[Entry, int]) -> bool:
        """Whether what follows shows that a reading is not meant."""
        match got[0].category:
            case "direction":
                return self._announces(got[1])
            case "adjective":
                return self._turning(i, got[1]) or self._takes(i, got)
            case "unsupported":
                return self.names.hear(self.words[i]) is not None
        return False

    def _announces(self, end: int) -> bool:
        """Whether what looks like a direction goes on to name something: "to the left | leg"."""
        words, lexicon = self.words, self.lexicon
        if not lexicon.knows(words[end - 1], {"modifier"}):
            return False
        if words[end : end + 1] == ["of"] and words[end - 1] in ("top", "bottom"):
            return True
        sides = (lexicon.match(words, at, "side") for at in (end - 1, end - 2) if at >= 0)
        if words[end : end + 1] in (["one"], ["ones"]):
            return True  # "towards the middle | one"
        return self.phrases.noun_at(end, False) or any(s is not None and s[1] > end for s in sides)

    def _takes(self, i: int, got: tuple[Entry, int]) -> bool:
        """Whether what may be an adjective is the verb: "by 40 % narrow | the table"."""
        verb = self.lexicon.match(self.words, i, "verb")
        return verb is not None and verb[1] == got[1] and self.phrases.word(got[1]) in ANNOUNCING

    def _turning(self, i: int, end: int) -> bool:
        """Whether what may be an adjective is the verb: "have it lean | 15 degrees"."""
        verb = self.lexicon.match(self.words[:end], i, "verb")
        if verb is None or verb[0].value != "rotate":
            return False
        units = (self.lexicon.match([w], 0, "unit") for w in self.words[end : end + 4])
        angle = any(u is not None and u[0].value == "deg" for u in units)
        return angle or any(self.lexicon.match(self.words, end, c) is not None for c in ("direction", "sense"))

    def connects(self, i: int) -> bool:
        """Whether the word at `i` only leads to "is" and the like: "a leg that | is longer"."""
        verb = self.lexicon.match(self.words, i + 1, "verb")
        return self.words[i] in ("that", "which", "who") and verb is not None and verb[0].value == "make"

    def natural(self, end: int) -> bool:
        """Whether a pivot is named that the picture does not know: "at the hinge", where it turns anyhow."""
        words = self.words
        if words[end : end + 1] not in (["the"], ["its"]) or end + 1 >= len(words):
            return False
        spot, ends = words[end + 1], end + 2 >= len(words)
        last = ends or self.lexicon.match(words, end + 2, "separator") is not None
        if not (last and self.lexicon.knows(spot, {"joint"}) and self.names.hear(spot) is None):
            return False
        self.names.notes.append(f'"{spot}" taken for where it is joined')
        return True

    def idle(self, entry: Entry, end: int) -> bool:
        """Prepositions that here only introduce an amount or a measure: "in height", "about 20", "at last"."""
        if entry.category == "relation" and entry.value in ("around", "inside", "on", "along"):
            measured = self.quantities.amount(end) is not None or self.quantities.measure(end) is not None
            return measured or self.phrases.read(end) is None
        return entry.category == "side"
