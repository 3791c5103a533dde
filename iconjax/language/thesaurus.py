"""Words that the lexicon does not know, looked up in a thesaurus (WordNet 3.1, see `thesaurus.NOTICE`).

An unknown noun is only ever compared with names that the picture has; whoever asks has to be told what was made of it.
`eval/thesaurus.py` rebuilds the data.
"""

from __future__ import annotations

import gzip
from collections.abc import Container, Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

SAME, STEP, SISTER = 1.0, 0.12, 0.12
"""Likeness of one sense; loss for each step up or down; further loss where a step up is followed by one down."""
PART = 0.62
"""Likeness of a part and the whole that it is by nature a part of."""
RARER = 0.06
"""Loss for each more frequent sense of either word that is passed over."""
SENSES, CLIMB = 4, 3
"""Senses of a word that count, and steps that are climbed from each."""
COMMON = 2
"""Most frequent senses of an unknown verb that count."""
BROAD = 6
"""Kinds with a path of fewer steps to the root ("device", "structure") are too broad to make sisters alike."""
LEAST, CLEAR = 0.6, 0.1
"""Least likeness that counts, and how far ahead of the runner-up the closest has to be."""
ENDINGS = (("ies", "y"), ("ves", "f"), ("ves", "fe"), ("es", ""), ("s", ""), ("ied", "y"), ("ed", ""), ("ed", "e"),
           ("ing", ""), ("ing", "e"), ("er", ""), ("er", "e"), ("est", ""), ("est", "e"), ("men", "man"))  # fmt: skip


@dataclass(frozen=True)
class Thesaurus:
    """The data, indexed.

    Attributes:
        kind: for each noun sense the sense it is a kind of, -1 at the top.
        wholes: the senses it is a part of.
        senses: noun -> (rank, sense), the most frequent first.
        verbs: verb -> verbs that share one of its most frequent senses.
        speech: part of speech -> its words.
    """

    kind: tuple[int, ...]
    wholes: dict[int, tuple[int, ...]]
    senses: dict[str, list[tuple[int, int]]]
    verbs: dict[str, list[str]]
    speech: dict[str, frozenset[str]]

    def depth(self, sense: int) -> int:
        """Steps from a sense to the top."""
        steps = 0
        while self.kind[sense] >= 0 and steps < 30:
            sense, steps = self.kind[sense], steps + 1
        return steps

    def above(self, sense: int) -> Iterator[int]:
        """The sense and what it is a kind of, some steps up."""
        for _ in range(CLIMB + 1):
            yield sense
            sense = self.kind[sense]
            if sense < 0:
                return


@cache
def _data() -> Thesaurus:
    raw = files("iconjax.language").joinpath("thesaurus.txt.gz").read_bytes()
    sections: dict[str, list[str]] = {}
    for line in gzip.decompress(raw).decode("utf-8").splitlines():
        if line.startswith("# "):
            rows = sections.setdefault(line[2:], [])
        else:
            rows.append(line)
    kind, wholes, senses = [], {}, dict[str, list[tuple[int, int]]]()
    for number, line in enumerate(sections["nouns"]):
        up, part, lemmas = line.split(";")
        kind.append(int(up) if up else -1)
        if part:
            wholes[number] = tuple(map(int, part.split(",")))
        for lemma in lemmas.split():
            word, rank = lemma.rsplit(":", 1)
            senses.setdefault(word, []).append((int(rank), number))
    verbs: dict[str, list[str]] = {}
    for line in sections["verbs"]:
        group = [lemma.rsplit(":", 1)[0] for lemma in line.split()]
        common = [lemma.rsplit(":", 1)[0] for lemma in line.split() if int(lemma.rsplit(":", 1)[1]) < COMMON]
        for verb in common:
            verbs.setdefault(verb, []).extend(v for v in group if v != verb)
    speech = {name: frozenset(sections[name][0].split()) for name in ("noun", "verb", "adj", "adv")}
    return Thesaurus(tuple(kind), wholes, {w: sorted(s)[:SENSES] for w, s in senses.items()}, verbs, speech)


def _forms(word: str) -> Iterator[str]:
    """The word and what it may be an inflected form of."""
    yield word
    for ending, base in ENDINGS:
        if word.endswith(ending) and len(word) > len(ending) + 1:
            stem = word.removesuffix(ending) + base
            yield stem
            if len(stem) > 3 and stem[-1] == stem[-2]:
                yield stem[:-1]


def speech(word: str) -> frozenset[str]:
    """Parts of speech that a word, in any of its forms, can be: of "noun", "verb", "adj", "adv"."""
    data, word = _data(), word.lower()
    found = {name for name, words in data.speech.items() if word in words}
    if not found:
        found = {name for form in _forms(word) for name, words in data.speech.items() if form in words}
    return frozenset(found)


def _senses(word: str) -> list[tuple[int, int]]:
    data = _data()
    for form in _forms(word.lower().replace(" ", "_").replace("-", "_")):
        if form in data.senses:
            return data.senses[form]
    return []


def likeness(word: str, other: str) -> float:
    """How alike two nouns are, 0 to 1: 1 for one sense, less for a kind of it, for a sister, for its part or whole."""
    best = 0.0
    for rank, a in _senses(word):
        for rank_b, b in _senses(other):
            best = max(best, _alike(a, b) - RARER * (rank + rank_b))
    return best


def _alike(a: int, b: int) -> float:
    data = _data()
    if a in data.wholes.get(b, ()) or b in data.wholes.get(a, ()):
        return PART
    up_a, up_b = list(data.above(a)), list(data.above(b))
    shared = next((s for s in up_a if s in up_b), None)
    if shared is None:
        return 0.0
    i, j = up_a.index(shared), up_b.index(shared)
    if i and j and data.depth(shared) < BROAD:
        return 0.0
    return SAME - STEP * (i + j) - (SISTER if i and j else 0.0)


def closest_noun(word: str, candidates: Iterable[str]) -> tuple[str, float] | None:
    """The candidate that an unknown noun is most like, with how much; None where none is, or two are about equally."""
    ranked = sorted(((likeness(word, c), c) for c in set(candidates)), reverse=True)
    if not ranked or ranked[0][0] < LEAST:
        return None
    if len(ranked) > 1 and ranked[0][0] - ranked[1][0] < CLEAR:
        return None
    return ranked[0][1], ranked[0][0]


def verb_like(word: str, known: Container[str]) -> str | None:
    """A known verb (in its base form) that shares a common sense with an unknown one."""
    data = _data()
    for form in _forms(word.lower()):
        for other in data.verbs.get(form, ()):
            if other in known:
                return other
    return None
