"""The words the offline translator knows, read from `lexicon.toml` and inflected by rule."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

VOWELS = "aeiou"


@dataclass(frozen=True)
class Entry:
    """One reading of a word or phrase.

    Attributes:
        category: e.g. "verb", "adjective", "relation".
        value: what it says within its category.
        info: further properties (for verbs and adjectives).
    """

    category: str
    value: str
    info: Mapping[str, Any]


@dataclass(frozen=True)
class Lexicon:
    """All phrases with their readings, and the small tables that are not phrases.

    Attributes:
        phrases: words of a phrase -> its readings.
        words: every single word that occurs in some phrase (used to recognise typing errors).
        synonyms: word -> names that everyday speech uses for the same thing; a name may have several words.
        kinds: word -> more general and more particular words.
        pieces: word -> words of the pieces that pictures often show such a thing in.
        plurals: irregular plural -> singular.
    """

    phrases: Mapping[tuple[str, ...], tuple[Entry, ...]]
    words: frozenset[str]
    synonyms: Mapping[str, frozenset[str]]
    kinds: Mapping[str, frozenset[str]]
    pieces: Mapping[str, frozenset[str]]
    plurals: Mapping[str, str]
    longest: int

    def match(self, words: Sequence[str], start: int, category: str) -> tuple[Entry, int] | None:
        """The longest phrase of `category` that begins at `start`, and where it ends."""
        for end in range(min(len(words), start + self.longest), start, -1):
            for entry in self.phrases.get(tuple(words[start:end]), ()):
                if entry.category == category:
                    return entry, end
        return None

    def knows(self, word: str, categories: Iterable[str]) -> bool:
        """Whether the single word has a reading in one of `categories`."""
        wanted = set(categories)
        return any(e.category in wanted for e in self.phrases.get((word,), ()))

    def entries(self, word: str, category: str) -> tuple[Entry, ...]:
        """The readings of a single word in a category."""
        return tuple(e for e in self.phrases.get((word,), ()) if e.category == category)

    def singular(self, word: str) -> str:
        """The singular of a noun by rule; a word that is no plural comes back as it is."""
        if word in self.plurals:
            return self.plurals[word]
        if len(word) <= 3 or not word.endswith("s") or word.endswith(("ss", "us", "is")):
            return word
        if word.endswith("ies") and len(word) > 4:
            return word[:-3] + "y"
        if word.endswith(("ches", "shes", "xes", "sses", "zes")):
            return word[:-2]
        return word[:-1]


@cache
def lexicon() -> Lexicon:
    """The built-in lexicon, read once."""
    data, things = _read("lexicon.toml"), _read("synonyms.toml")
    phrases: dict[tuple[str, ...], list[Entry]] = {}
    for form, entry in _entries(data):
        phrases.setdefault(tuple(form.replace(",", " ,").split()), []).append(entry)
    groups = (g for theme in things["close"].values() for g in theme)
    return Lexicon(
        {k: tuple(v) for k, v in phrases.items()},
        frozenset(w for k in phrases for w in k),
        _related((a, b) for group in groups for a in group for b in group),
        _related(pair for a, members in things["kinds"].items() for b in members for pair in ((a, b), (b, a))),
        {word: frozenset(pieces) for word, pieces in things["pieces"].items()},
        data["irregular_plural"],
        max(map(len, phrases)),
    )


def _read(name: str) -> dict[str, Any]:
    return tomllib.loads(files("iconjax.language").joinpath(name).read_text(encoding="utf-8"))


def _related(pairs: Iterable[tuple[str, str]]) -> dict[str, frozenset[str]]:
    out: dict[str, set[str]] = {}
    for a, b in pairs:
        out.setdefault(a, set()).update({b} - {a})
    return {k: frozenset(v) for k, v in out.items()}


def _entries(data: Mapping[str, Any]) -> Iterator[tuple[str, Entry]]:
    for verb in data["verb"]:
        for form in verb["forms"]:
            for inflected, participle in _verb_forms(form):
                yield inflected, Entry("verb", verb["kind"], {**verb, "participle": participle, "base": form})
    for adjective in data["adjective"]:
        for form, degree in _adjective_forms(adjective):
            yield form, Entry("adjective", adjective["dim"], {**adjective, "degree": degree})
    for category, table in data.items():
        if category in {"verb", "adjective", "irregular_plural"}:
            continue
        for value, forms in table.items():
            for form in forms:
                yield form, Entry(category, value, {})


def _verb_forms(phrase: str) -> Iterator[tuple[str, bool]]:
    """A verb phrase with its first word inflected; the flag says whether the form is an -ing form."""
    word, _, rest = phrase.partition(" ")
    tail = f" {rest}" if rest else ""
    stem = word[:-1] if word.endswith("e") and not word.endswith("ee") else word
    short = len(word) >= 3 and word[-1] not in VOWELS + "wxy" and word[-2] in VOWELS and word[-3] not in VOWELS
    doubled = word + word[-1] if short and (len(word) <= 4 or word == "transfer") else stem
    yield phrase, False
    yield word + ("es" if word.endswith(("sh", "ch", "x", "ss", "o")) else "s") + tail, False
    for stem_form in {doubled, stem}:
        yield stem_form + "ed" + tail, False
        yield stem_form + "ing" + tail, True


def _adjective_forms(adjective: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    for word in adjective["forms"]:
        yield word, "plain"
        for intensifier in ("more", "less"):
            yield f"{intensifier} {word}", intensifier
        stem = word[:-1] if word.endswith("e") else word[:-1] + "i" if word.endswith("y") else word
        yield stem + "er", "more"
        yield "less " + stem + "er", "less"
    for word in adjective.get("irregular", ()):
        yield word, "more"
