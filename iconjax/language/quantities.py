"""Amounts and measures: "by a third", "45 degrees", "half the width of the table", "1 1/2 times"."""

from __future__ import annotations

import re
from dataclasses import replace

from iconjax.language.clauses import Amount, Quantity
from iconjax.language.names import Phrase
from iconjax.language.phrases import DETERMINERS, POSSESSIVES, PhraseReader

FILLERS = frozenset(
    {
        "original",
        "current",
        "present",
        "full",
        "total",
        "own",
        "old",
        "whole",
        "initial",
        "previous",
        "former",
        "entire",
        "exact",
        "precise",
        "very",
    }
)
DECIMAL = re.compile(r"\d+(\.\d+)?$")


class QuantityReader:
    """Reads amounts and measures at given places of a request."""

    def __init__(self, phrases: PhraseReader) -> None:
        self.phrases, self.words, self.lexicon = phrases, phrases.words, phrases.lexicon

    def number(self, i: int) -> tuple[float, int] | None:
        """A plain number in digits or words: 40, minus 10, twenty five, 1 1/2, one and a half."""
        sign = 1.0
        if self.phrases.word(i) == "minus" and DECIMAL.match(self.phrases.word(i + 1)):
            sign, i = -1.0, i + 1
        word = self.phrases.word(i)
        if DECIMAL.match(word):
            value, i = float(word), i + 1
            if self.phrases.word(i) == "/" and DECIMAL.match(self.phrases.word(i + 1)):
                return (sign * value / float(self.words[i + 1]), i + 2) if float(self.words[i + 1]) else None
            if (
                self.phrases.word(i + 1) == "/"
                and DECIMAL.match(self.phrases.word(i))
                and float(self.phrases.word(i + 2) or 0)
            ):
                return sign * (value + float(self.words[i]) / float(self.words[i + 2])), i + 3
            return sign * value, i
        got = self.lexicon.match([word], 0, "number")
        if got is None or (word in ("a", "an") and self.phrases.word(i + 1) != "hundred"):
            return None
        value, i = float(got[0].value), i + 1
        unit = self.lexicon.match([self.phrases.word(i)], 0, "number")
        if (
            value >= 20
            and unit is not None
            and 0 < float(unit[0].value) < 10
            and self.phrases.word(i) not in ("a", "an")
        ):
            value, i = value + float(unit[0].value), i + 1
        elif self.phrases.word(i) == "hundred":
            value, i = value * 100, i + 1
        if self.words[i : i + 3] == ["and", "a", "half"]:
            value, i = value + 0.5, i + 3
        elif self.words[i : i + 3] == ["and", "a", "quarter"]:
            value, i = value + 0.25, i + 3
        return value, i

    def amount(self, i: int) -> tuple[Amount, int] | None:
        """An amount with its unit and, where it says so, what it is a part of."""
        got = self._plain(i)
        if got is None:
            return None
        amount, i = got
        if amount.unit in ("ratio", "times"):
            j = i + 1 if self.phrases.word(i) == "of" else i
            measure = self.measure(j)
            manner = self.phrases.word(j).endswith(("ly", "wise", "ways"))  # "15 % vertically"
            bare = self.lexicon.knows(self.phrases.word(i - 1), {"unit"}) and self._bare(i)
            if measure is not None and not manner and not bare:
                return replace(amount, of=measure[0]), measure[1]
        return amount, i

    def _bare(self, i: int) -> bool:
        """Whether a measure at `i` stands without "of" or an article: "30 % height" is no share of a height."""
        return self.phrases.word(i) not in ("of", *DETERMINERS, *POSSESSIVES)

    def _plain(self, i: int) -> tuple[Amount, int] | None:
        vague = self.lexicon.match(self.words, i, "vague")
        if vague is not None:
            return Amount(float(vague[0].value), "ratio", vague=True), vague[1]
        if self.words[i : i + 3] == ["a", "right", "angle"]:
            return Amount(90.0, "deg"), i + 3
        multiple = self.lexicon.match(self.words, i, "multiple")
        if multiple is not None:
            return Amount(float(multiple[0].value), "times"), multiple[1]
        return self._fraction(i) or self._counted(i)

    def doubled(self, i: int) -> tuple[Amount, int] | None:
        """ "(to) double its height", "(make it) triple the width of the door"."""
        got = self.lexicon.match([self.phrases.word(i)], 0, "verb")
        measure = self.measure(i + 1) if got is not None and float(got[0].info.get("factor", 0)) > 1 else None
        if got is None or measure is None or got[0].info["base"] != self.words[i]:
            return None
        return Amount(float(got[0].info["factor"]), "times", of=measure[0]), measure[1]

    def _fraction(self, i: int) -> tuple[Amount, int] | None:
        start, top = i, 1.0
        if self.phrases.word(i) in ("a", "an", "one", "the"):
            i += 1
        else:
            number = self.number(i)
            if number is not None and number[0] == int(number[0]) and number[0] < 10:
                top, i = number
        got = self.lexicon.match([self.phrases.word(i)], 0, "fraction")
        if got is None or self.phrases.word(start) == "the":
            return None
        bare = start == i and self.phrases.word(i) not in ("half", "quarter")
        if bare or (self.lexicon.knows(self.words[i], {"ordinal"}) and self.phrases.read(i) is not None and start == i):
            return None
        value, i = top / float(got[0].value), i + 1
        if self.words[i : i + 2] == ["again", "as"]:
            return Amount(1 + value, "times"), i + 1
        j = i + 1 if self.phrases.word(i) in ("a", "of", "an") else i
        unit = self.lexicon.match([self.phrases.word(j)], 0, "unit")
        if unit is not None and unit[0].value == "turn":
            return Amount(360.0 * value, "deg"), j + 1
        if self.phrases.word(j) in ("circle",):
            return Amount(360.0 * value, "deg"), j + 1
        return Amount(value, "ratio"), i

    def _counted(self, i: int) -> tuple[Amount, int] | None:
        number = self.number(i)
        if number is None:
            return None
        value, j = number
        got = self.lexicon.match(self.words, j, "unit")
        if got is None:
            digits = DECIMAL.match(self.words[j - 1]) is not None
            unit = "ratio" if "/" in self.words[i:j] and value < 1 else "none"
            return (Amount(value, unit), j) if digits else None
        unit = got[0].value
        if unit == "percent":
            return Amount(value / 100, "ratio"), got[1]
        if unit == "turn":
            return Amount(360.0 * value, "deg"), got[1]
        return Amount(value, unit), got[1]

    def measure(self, i: int) -> tuple[Quantity, int] | None:
        """A measure: "its height", "the width of X", "X's size", "the gap between X and Y"."""
        owners: tuple[Phrase, ...] = ()
        j = i
        if self.phrases.word(i) in POSSESSIVES:
            owners, j = (Phrase(self.words[i], pronoun="them" if self.words[i] == "their" else "it"),), i + 1
        elif self.phrases.word(i) in DETERMINERS:
            j = i + 1
        j = self._after_fillers(j)
        gap = self.lexicon.match(self.words, j, "distance")
        if gap is not None and self.phrases.word(gap[1]) in ("between", "from", "of"):
            return self._gap(gap[1] + 1)
        got = self.lexicon.match(self.words, j, "dim")
        if got is None or (j == i and self._verbish(j)):
            return None if owners else self._owned(i)
        if self.phrases.word(got[1]) == "of":
            of = self._owners(got[1] + 1)
            if of is not None:
                return Quantity(got[0].value, of[0]), of[1]
        return Quantity(got[0].value, owners), got[1]

    def _owned(self, i: int) -> tuple[Quantity, int] | None:
        """ "X's size"."""
        whole = self.phrases.read(i)
        if whole is None or self.phrases.word(whole[1]) != "'s":
            return None
        got = self.lexicon.match(self.words, self._after_fillers(whole[1] + 1), "dim")
        return None if got is None else (Quantity(got[0].value, (whole[0],)), got[1])

    def _owners(self, i: int) -> tuple[tuple[Phrase, ...], int] | None:
        """ "(the width of) the door and the window"."""
        first = self.phrases.read(i)
        if first is None:
            return None
        owners: list[Phrase] = [first[0]]
        end = first[1]
        while self.phrases.word(end) == "and":
            more = self.phrases.read(end + 1)
            if more is None or self.lexicon.match(self.words, more[1], "verb") is not None:
                break
            owners.append(more[0])
            end = more[1]
        return tuple(owners), end

    def _after_fillers(self, i: int) -> int:
        while self.phrases.word(i) in FILLERS:
            i += 1
        return i

    def _verbish(self, i: int) -> bool:
        """Whether "scale" or "size" opens a clause, and so is a verb."""
        opens = i == 0 or self.words[i - 1] in ("and", ",", "then", ".", ";")
        return self.words[i] in ("scale", "size") and opens

    def _gap(self, i: int) -> tuple[Quantity, int] | None:
        first = self.phrases.read(i)
        if first is None:
            return None
        owners: tuple[Phrase, ...] = (first[0],)
        end = first[1]
        if self.phrases.word(end) in ("and", "to", "from"):
            second = self.phrases.read(end + 1)
            if second is not None:
                owners, end = (*owners, second[0]), second[1]
        return Quantity("gap", owners), end
