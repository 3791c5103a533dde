"""The core of a noun phrase: modifiers, ordinals and nouns."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from iconjax.language.lexicon import Lexicon
from iconjax.language.names import THINGS, Names, Phrase

GRAMMAR = frozenset(
    {
        "verb", "relation", "direction", "adjective", "dim", "mode", "separator", "sense", "orient", "fixed",
        "stop", "pronoun", "side", "number", "fraction", "multiple", "unit", "apart", "distance", "places",
        "squarely", "vague",
    }
)  # fmt: skip
"""Categories that win over a name when nothing announces a noun."""
PLACED = {
    ("on", "top"): ("top", 2),
    ("at", "the", "top"): ("top", 3),
    ("at", "the", "very", "top"): ("top", 4),
    ("at", "the", "bottom"): ("bottom", 3),
    ("at", "the", "very", "bottom"): ("bottom", 4),
    ("in", "the", "middle"): ("middle", 3),
}
"""Places behind a noun that tell like things apart -> the modifier that says the same, and their length."""
MODAL = frozenset({"make", "let", "have", "want", "should", "must", "shall", "would", "to", "can", "could"})
MOST_STRANGE = 2
ANAPHORS = frozenset({"one", "ones", "other", "others"})


class NounReader:
    """Reads the core of noun phrases at given places of a request."""

    def __init__(self, words: Sequence[str], lexicon: Lexicon, names: Names) -> None:
        self.words, self.lexicon, self.names = words, lexicon, names

    def word(self, i: int) -> str:
        """The word at `i`, or "" beyond the end."""
        return self.words[i] if 0 <= i < len(self.words) else ""

    def body(self, i: int, announced: bool) -> tuple[Phrase, int] | None:
        """Modifiers and nouns at `i`; `announced` says that a determiner or owner came before."""
        strange = self._strange_before(i, announced)
        i += len(strange)
        special = self._special(i, announced)
        if special is not None:
            return Phrase("", special=special), i + 1
        phrase, start = Phrase("", ignored=strange), i
        while announced or self.noun_follows(i) or self._bare_one(i):
            if announced and self._elliptical(i):
                return self._alone(phrase, i), i + 1
            step = self._premodifier(i)
            if step is None:
                break
            phrase, i, announced = _described(phrase, *step), i + 1, True
        if self.word(i) in ANAPHORS and (announced or i > start):
            other = phrase.indefinite or ("other" if self.word(i).startswith("other") else None)
            one = with_(phrase, indefinite=other, plural=self.word(i).endswith("s"))
            return self._one_at(one, i + 1) if announced and not other else (one, i + 1)
        return self._nouns(phrase, i, announced)

    def _nouns(self, phrase: Phrase, i: int, announced: bool) -> tuple[Phrase, int] | None:
        nouns: list[str] = []
        plural = False
        while self.noun_at(i, announced and not nouns) or (nouns and self._goes_on(nouns, i)):
            nouns.extend(self.names.hear(self.word(i)) or ())
            plural = self.lexicon.singular(self.word(i)) != self.word(i)
            i += 1
        if not nouns:
            return (phrase, i) if phrase.indefinite else None
        if all(self.lexicon.knows(n, {"modifier", "ordinal"}) for n in nouns) and not self._is_name(nouns):
            return None  # "the right" alone is no thing
        kind = self.word(i)
        if kind and self.names.hear(kind) is None and self.lexicon.knows(kind, {"kind"}):
            phrase, i = with_(phrase, ignored=(*phrase.ignored, kind)), i + 1  # "the palm tree"
        return self._from_side(with_(phrase, nouns=tuple(dict.fromkeys(nouns)), plural=plural), i)

    def _special(self, i: int, announced: bool) -> str | None:
        """The picture or the ground, where they are no things of the picture."""
        if self.word(i) and not self.names.hear(self.word(i)):
            if self.lexicon.knows(self.word(i), {"canvas"}):
                return "canvas"
            if announced and self.lexicon.knows(self.word(i), {"ground"}):
                return "ground"
        return None

    def _alone(self, phrase: Phrase, i: int) -> Phrase:
        ordinal = self.lexicon.match([self.word(i)], 0, "ordinal")
        if ordinal is not None:
            return with_(phrase, ordinal=int(ordinal[0].value))
        side = self.lexicon.match([self.word(i)], 0, "modifier")
        return phrase if side is None else with_(phrase, modifiers=(side[0].value,))

    def _is_name(self, nouns: Sequence[str]) -> bool:
        every = (*self.names.objects, *self.names.parts)
        cover = self.names.hearing.cover
        return any(cover(nouns, words) == words for e in every for words in (e.part_words, e.object_words) if words)

    def _from_side(self, phrase: Phrase, i: int) -> tuple[Phrase, int]:
        """ "... from the right", "... on the left" after a noun that needs telling apart."""
        if phrase.ordinal is not None and self.word(i) == "from" and self.word(i + 1) == "the":
            got = self.lexicon.match(self.words, i + 2, "modifier")
            if got is not None and got[0].value in ("left", "right", "top", "bottom"):
                return with_(phrase, ordinal_from=got[0].value), got[1]
        for place, (modifier, end) in PLACED.items():
            apart = not phrase.plural and not phrase.modifiers and self.word(i + end) != "of"
            if tuple(self.words[i : i + end]) == place and apart and len(self.names.like(phrase)) > 1:
                return with_(phrase, modifiers=(modifier,)), i + end
        where = self.lexicon.match(self.words, i, "direction") if self.word(i) == "on" else None
        if where is None or where[0].value not in ("left", "right") or self.word(where[1]) == "of":
            return phrase, i
        if self.noun_follows(where[1]):
            return phrase, i
        if phrase.plural or phrase.modifiers or len(self.names.like(phrase)) < 2:
            return phrase, i
        return with_(phrase, modifiers=(where[0].value,)), where[1]

    def _one_at(self, phrase: Phrase, i: int) -> tuple[Phrase, int]:
        """ "The one | on the right"."""
        where = self.lexicon.match(self.words, i, "direction") if self.word(i) in ("on", "to") else None
        side = where[0].value if where is not None else ""
        sided = {"left": "left", "right": "right"}.get(side, "")
        if not sided or where is None or phrase.modifiers or self.word(where[1]) == "of" or self.noun_follows(where[1]):
            return phrase, i
        return with_(phrase, modifiers=(sided,)), where[1]

    def _goes_on(self, nouns: Sequence[str], i: int) -> bool:
        """Whether the word at `i`, though it has other uses, completes a name: "the table | top"."""
        heard = self.names.hear(self.word(i))
        if (
            heard is None
            or self._amount(i)
            or self.lexicon.knows(self.word(i), {"direction", "adjective", "relation", "mode", "stop"})
        ):
            return False
        cover = self.names.hearing.cover
        parts = self.names.parts
        return any(cover((*nouns, *heard), e.words) and cover(heard, e.part_words) for e in parts)

    def _strange_before(self, i: int, announced: bool) -> tuple[str, ...]:
        """Words that mean nothing here, before a noun: "the beach | ball", "squeaky toy | cart"."""
        if not announced and not self._opens(i):
            return ()
        for count in range(1, MOST_STRANGE + 1):
            if not self.strange(i + count - 1):
                return ()
            if self.noun_follows(i + count):
                return tuple(self.words[i : i + count])
        return ()

    def _opens(self, i: int) -> bool:
        """Whether a thing without article may be named at `i`: at the start, after a separator or a verb."""
        return i == 0 or self.lexicon.knows(self.words[i - 1], {"separator", "verb", "quantifier"})

    def strange(self, i: int) -> tuple[str, ...]:
        """The word at `i` where it means nothing at all here."""
        word = self.word(i)
        meanings = {e.category for e in self.lexicon.phrases.get((word,), ())}
        if self.word(i - 1) in ("the", "a", "an", "its", "their") and self.noun_at(i + 1, False):
            meanings -= {"verb"}  # "the lift gate"
        grammar = bool(meanings - THINGS) or (
            not meanings and word in self.lexicon.words and (word,) not in self.lexicon.phrases
        )
        known = grammar or self.names.hear(word) is not None
        return () if known or not word.isalpha() else (word,)

    def _elliptical(self, i: int) -> bool:
        """ "the first | and the last candle", "the left | and the right window", "on the second"."""
        if self.lexicon.knows(self.word(i), {"ordinal"}) and self.word(i + 1) in ("", ".", ";", ","):
            return True
        if not self.lexicon.knows(self.word(i), {"ordinal", "modifier"}) or self.word(i + 1) != "and":
            return False
        following = i + 3 if self.word(i + 2) == "the" else i + 2
        return self.lexicon.knows(self.word(following), {"ordinal", "modifier"}) and self.noun_at(following + 1, True)

    def _premodifier(self, i: int) -> tuple[str, str] | None:
        word = self.word(i)
        following = self.noun_follows(i + 1) or self.word(i + 1) in ("one", "ones")
        if not following and word not in ("other",):
            return None
        if word == "other" and (self.noun_at(i + 1, True) or self.word(i + 1) in ("one", "ones")):
            return ("other", "other")
        for category in ("modifier", "ordinal"):
            got = self.lexicon.match([word], 0, category)
            if got is not None:
                return category, got[0].value
        if self.lexicon.knows(word, {"descriptor"}) and not self.names.hear(word):
            return ("descriptor", word)
        return None

    def noun_follows(self, i: int) -> bool:
        """Whether, after more modifiers, a noun comes."""
        while self.lexicon.knows(self.word(i), {"modifier", "ordinal", "descriptor"}) and not self.noun_at(i, False):
            i += 1
        return self.noun_at(i, True)

    def noun_at(self, i: int, announced: bool) -> bool:
        """Whether the word at `i` names something; words of the grammar do only where a noun is announced."""
        word = self.word(i)
        if not word or self.names.hear(word) is None or self._amount(i):
            return False
        if announced or self._bare(i):
            return True
        return not self.lexicon.knows(word, GRAMMAR)

    def _amount(self, i: int) -> bool:
        """Whether a number, though a label has it ("Piece 2"), is an amount: "2 px", "2 times", or after no noun."""
        if not self.word(i).isdigit():
            return False
        before = self.word(i - 1) if i else ""
        numbering = bool(before) and not before.isdigit() and self.names.hear(before) is not None
        return not numbering or self.lexicon.match(self.words, i + 1, "unit") is not None

    def _bare_one(self, i: int) -> bool:
        """Whether "left one", "big one" opens a phrase without an article."""
        telling = self.lexicon.knows(self.word(i), {"modifier", "ordinal"}) or self.word(i) == "other"
        return telling and self.word(i + 1) in ("one", "ones") and self._opens(i)

    def _bare(self, i: int) -> bool:
        """Whether a label's word that may be a verb is a noun here: "widen | stand", "stand half as tall"."""
        word, after = self.word(i), self.word(i + 1)
        if not self._opens(i) or self.lexicon.singular(word) not in self.names.vocabulary:
            return False
        kinds = {e.category for e in self.lexicon.phrases.get((word,), ())}
        if after == "of" and kinds <= {"side", *THINGS}:
            return True  # "base of the lamp", where it has one
        if not kinds or not kinds <= {"verb", *THINGS, "descriptor", "synonym"}:
            return False
        if i > 0 and self.lexicon.knows(self.words[i - 1], {"verb"}) and self.words[i - 1] not in MODAL:
            return not self.lexicon.knows(after, {"pronoun"}) and after not in ("the", "a", "an", "its")
        return self.lexicon.knows(after, {"number", "fraction", "multiple", "adjective", "mode"}) or after.isdigit()


def with_(phrase: Phrase, **changes: object) -> Phrase:
    """A phrase with some attributes changed."""
    return replace(phrase, **changes)  # type: ignore[arg-type]


def _described(phrase: Phrase, kind: str, value: str) -> Phrase:
    """A phrase with one more word before its noun."""
    match kind:
        case "modifier":
            return with_(phrase, modifiers=(*phrase.modifiers, value))
        case "ordinal":
            return with_(phrase, ordinal=int(value))
        case "other":
            return with_(phrase, indefinite="other")
        case "descriptor":
            return with_(phrase, descriptors=(*phrase.descriptors, value))
    return phrase
