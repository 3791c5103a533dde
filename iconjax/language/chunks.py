"""A request cut into typed pieces: noun phrases, amounts, verbs, relations, separators."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from iconjax.errors import TranslationError
from iconjax.language.lexicon import Entry, Lexicon
from iconjax.language.likening import says_nothing
from iconjax.language.names import Names
from iconjax.language.senses import ANNOUNCING, OPENERS, Senses


@dataclass(frozen=True)
class Chunk:
    """A piece of a request.

    Attributes:
        kind: "phrase", "amount", "that_much", "measure", "as", "than", "same", "too", "unknown" or a lexicon category.
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


Cut = tuple[str, str, Any, int]
"""Kind, value and data of a piece, and where it ends; the kind "stop" for words without news."""


def chunk(words: Sequence[str], lexicon: Lexicon, names: Names, things_first: bool = False) -> list[Chunk]:
    """Cut a request into pieces, left to right, the longest reading first.

    Args:
        things_first: a word that is a verb and the name of something in the picture is taken for the name.

    Raises:
        TranslationError: the request asks for something that is not a change of place, pose or size.
    """
    cutter = _Cutter(words, lexicon, names, things_first)
    i = 0
    while i < len(words):
        kind, value, data, end = cutter.cut(i)
        text = " ".join(words[i:end]).replace(" 's", "'s")
        if kind == "unsupported":
            raise TranslationError(f'"{text}": {value}')
        if kind != "stop":
            cutter.out.append(Chunk(kind, value, data, text, i, end))
        i = end
    return cutter.out


class _Cutter:
    """Cuts one piece after another."""

    def __init__(self, words: Sequence[str], lexicon: Lexicon, names: Names, things_first: bool) -> None:
        self.words, self.lexicon, self.names, self.things_first = words, lexicon, names, things_first
        self.senses = Senses(words, lexicon, names)
        self.phrases, self.quantities = self.senses.phrases, self.senses.quantities
        self.out: list[Chunk] = []

    @property
    def previous(self) -> str:
        """The kind of the piece before; "keep" for verbs that say that something stays."""
        if not self.out:
            return "separator"
        return "keep" if self.out[-1].value == "keep" else self.out[-1].kind

    def cut(self, i: int) -> Cut:
        """The piece that begins at the word `i`."""
        lexical = self.senses.lexical(i, self.previous)
        reach = lexical[1] if lexical is not None else i
        found = self._quantity(i, reach)
        if found is None and self.out and self.senses.connects(i):
            return "stop", "", None, i + 1
        return found or self._thing(i, lexical, reach) or self._word(i, lexical, reach)

    def _quantity(self, i: int, reach: int) -> Cut | None:
        """An amount or a measure."""
        if self.words[i] in ("that", "this", "as") and self.phrases.word(i + 1) == "much":
            return "that_much", "", None, i + 2
        amount = self.quantities.amount(i)
        if amount is None and (self.previous in ("mode", "phrase") or self.previous == "verb" == self._made(i)):
            amount = self.quantities.doubled(i)
        if amount is not None and amount[1] >= reach:
            counts = amount[0].unit == "none" and self.phrases.noun_at(amount[1], False)
            if not counts:
                return "amount", "", amount[0], amount[1]
        measure = self.quantities.measure(i)
        if measure is not None and measure[1] > reach:
            return "measure", "", measure[0], measure[1]
        return None

    def _made(self, i: int) -> str:
        return "verb" if self.out[-1].value == "make" else ""

    def _thing(self, i: int, lexical: tuple[Entry, int] | None, reach: int) -> Cut | None:
        """A noun phrase."""
        asked = self._attributive(i)
        if asked is not None:
            return asked
        if self._only_leads(i):
            return "stop", "", None, i + 1
        phrase = self.phrases.read(i)
        if lexical is not None and self._rather_names(i, lexical[0]):
            phrase = phrase or self.phrases.body(i, True)
            reach = i
        if phrase is None or phrase[1] < reach:
            return None
        if phrase[1] > reach:
            return "phrase", "", phrase[0], phrase[1]
        other = {"direction", "adjective", "relation", "mode", "orient"}
        named = lexical is not None and (lexical[0].category not in OPENERS or lexical[0].category == "verb")
        if named and not self.lexicon.knows(self.words[i], other):
            return "phrase", "", phrase[0], phrase[1]
        return None

    def _only_leads(self, i: int) -> bool:
        """Whether the word at `i` only leads to things: "both | the sun and the tree", "I want that | the ..."."""
        first = self.phrases.read(i + 1)
        if first is None:
            return False
        if self.words[i] == "both":
            return self.phrases.word(first[1]) == "and" and self.phrases.read(first[1] + 1) is not None
        article = self.phrases.word(i + 1) in (*ANNOUNCING, "it", "they", "both")
        return self.words[i] == "that" and article and self.previous in ("verb", "mode", "separator")

    def _rather_names(self, i: int, entry: Entry) -> bool:
        """Whether a word with another use is the name of something: "foot | as wide as the bowl"."""
        if self.names.hear(self.words[i]) is None:
            return False
        opens = self.previous in ("separator", "without", "verb")
        if opens and entry.category == "relation" and self._full_name(i):
            return True
        return (self.things_first and entry.category == "verb") or (opens and entry.category == "side")

    def _full_name(self, i: int) -> bool:
        """Whether two words are all of a name: "contact strip | twice as wide"."""
        pair = frozenset(self.lexicon.singular(w) for w in self.words[i : i + 2])
        every = (*self.names.objects, *self.names.parts)
        return len(pair) == 2 and any(pair in (e.part_words, e.object_words) for e in every)

    def _attributive(self, i: int) -> Cut | None:
        """ "(I want) a | wider | table": the comparative asks for a change, unless it tells one thing from another."""
        article = self.words[i] in ("a", "an")
        got = self.lexicon.match(self.words, i + article, "adjective")
        if got is None or got[0].info["degree"] == "plain" or not self.phrases.noun_follows(got[1]):
            return None
        sides = {e.value for w in self.words[i + article : got[1]] for e in self.lexicon.phrases.get((w,), ())}
        told = self.phrases.read(got[1])
        if sides & {"top", "bottom"} or told is None:
            return None
        if not told[0].plural and not article and len(self.names.like(told[0])) > 1:
            return None
        return ("stop", "", None, i + 1) if article else (got[0].category, got[0].value, got[0], got[1])

    def _word(self, i: int, lexical: tuple[Entry, int] | None, reach: int) -> Cut:
        """What the lexicon says."""
        word = self.words[i]
        if word == "as" and self.phrases.word(i + 1) == "well" and self.phrases.word(i + 2) != "as":
            return "too", "", None, i + 2
        if word == "with" and lexical is None and self.phrases.read(i + 1) is not None:
            return "with", "with", None, i + 1
        if word == "like" and self.previous in ("adjective", "orient") and self.phrases.read(i + 1) is not None:
            return "like", "", None, i + 1
        if word in ("as", "than", "same", "too") and reach <= i + 1:
            return word, "", None, i + 1
        if lexical is not None:
            return self._meaning(i, *lexical)
        if self.lexicon.knows(word, {"stop"}) or word in ("whole", "entire", "both"):
            stop = self.lexicon.match(self.words, i, "stop")
            return "stop", "", None, stop[1] if stop else i + 1
        if word.isalpha() and word not in self.lexicon.words and says_nothing(word, self.phrases.noun_follows(i + 1)):
            self.names.notes.append(f'"{word}" passed over')
            return "stop", "", None, i + 1
        return "unknown", "", None, i + 1

    def _meaning(self, i: int, entry: Entry, end: int) -> Cut:
        """What a lexical reading comes to where it stands."""
        if entry.value == "around" and self.senses.natural(end):
            return "stop", "", None, end + 2
        if self.senses.idle(entry, end):
            return "stop", "", None, end
        announced = i > 0 and self.words[i - 1] in ANNOUNCING
        if entry.category == "verb" and entry.value != "make" and announced:
            return "unknown", "", None, end  # "the wind": a thing that the picture does not have
        return ("without" if entry.value == "without" else entry.category), entry.value, entry, end
