"""What written words stand for among the words of a picture's labels: themselves, synonyms, slips of the keyboard."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise

from iconjax.language.lexicon import Lexicon
from iconjax.language.likening import closest, heads, nominal
from iconjax.language.words import mend

Words = frozenset[str]
DEAF = frozenset({"stop", "relation", "mode", "number", "unit", "pronoun", "quantifier", "modifier", "ordinal"})
"""Categories of words that never are another name for a thing; where a label has them, they are heard all the same."""
SHORTEST_TAIL = 3
MOST_SINGLE = 2
"""Names of an object in the plural and of its parts where it is a single thing all the same ("Headphones")."""


def label_words(label: str, lexicon: Lexicon) -> Words:
    """The words of a label in lower case and in the singular."""
    return frozenset(lexicon.singular(w) for w in re.findall(r"[a-zà-öø-ÿ]+|\d+", label.lower()))


class Hearing:
    """Hears what a written word means among the words of a scene's labels.

    Attributes:
        vocabulary: every word of a label, in the singular.
        notes: what was read as something else, for the explanation of a reading.
        nominal: words of the request that mean nothing here and stand where a noun is due.
        perhaps: unknown noun -> the names that it may mean, where that is open.
    """

    def __init__(
        self, named: Iterable[Words], lexicon: Lexicon, known_as_things: Words, labels: Iterable[str] = ()
    ) -> None:
        self.named, self.lexicon, self._things = tuple(named), lexicon, known_as_things
        self.vocabulary = frozenset(w for words in self.named for w in words)
        self.notes: list[str] = []
        self._heard: dict[str, tuple[str, ...] | None] = {}
        self._senses: dict[str, tuple[Words, ...]] = {}
        self._labels = tuple(labels)
        self.nominal: Words = frozenset()
        self._said: tuple[str, ...] = ()
        self._used: Words = frozenset()
        self.perhaps: dict[str, tuple[str, ...]] = {}

    def listen(self, words: Sequence[str]) -> None:
        """Take in a request, so that unknown words that stand for nouns in it are likened to the picture's names."""
        self._said = tuple(words)
        self._used = frozenset(self.lexicon.singular(w) for w in words) & self.vocabulary
        self.nominal = nominal(words, self.lexicon, [self.hear(w) is not None for w in words])
        self._heard = {w: nouns for w, nouns in self._heard.items() if nouns is not None}

    def hear(self, word: str) -> tuple[str, ...] | None:
        """The nouns that a written word stands for, all at once; None where it names nothing here."""
        if word not in self._heard:
            self._heard[word] = self._hear(word)
        return self._heard[word]

    def senses(self, noun: str) -> tuple[Words, ...]:
        """The sets of label words, each of which a noun that was heard may mean."""
        return self._senses.get(noun, (frozenset({noun}),))

    def cover(self, nouns: Iterable[str], words: Words) -> Words | None:
        """The words of a name that nouns speak of; None where one of them speaks of none."""
        used: set[str] = set()
        for noun in nouns:
            meant = [s for s in self.senses(noun) if s <= words]
            if not meant:
                return None
            used.update(*meant)
        return frozenset(used)

    def _hear(self, word: str) -> tuple[str, ...] | None:
        singular = self.lexicon.singular(word)
        for form in (singular, word):
            if form in self.vocabulary:
                return (form,)
        compound = self._compound(singular)
        if compound is not None:
            return compound
        if self.lexicon.knows(word, DEAF):
            return None
        spoken = singular.replace("-", " ")  # "rabbit-ear" is a name of two words
        close = self.lexicon.synonyms.get(spoken, frozenset()) | self.lexicon.pieces.get(spoken, frozenset())
        grammar = word in self.lexicon.words and word not in self._things
        near = mend(singular, self.vocabulary) if not grammar and not close else None
        if near is not None and word in (near + "d", near + "ed"):
            return None  # "striped" describes, and is no stripe
        if near is not None:
            return self._note(word, near, (frozenset({near}),))
        senses = self._known(close)
        if not grammar and len(singular) >= SHORTEST_TAIL and (not senses or len(singular) > SHORTEST_TAIL):
            # "the cup" of a picture with a teacup
            senses += [frozenset({v}) for v in self.vocabulary if v.endswith(singular) and len(v) > len(singular) + 2]
        senses = senses or self._known(self.lexicon.kinds.get(singular, frozenset()))
        if not senses and word in self.nominal and not grammar:
            senses = self._likened(word)
        return self._note(word, singular, tuple(senses)) if senses else None

    def _known(self, names: Iterable[str]) -> list[Words]:
        """Those of the names whose words all belong to one label."""
        out = []
        for name in sorted(names):
            words = frozenset(self.lexicon.singular(w) for w in name.split())
            if any(words <= label for label in self.named):
                out.append(words)
        return out

    def _likened(self, word: str) -> list[Words]:
        """The name of the picture that an unknown noun is clearly most like."""
        names = heads(self._labels, self.lexicon)
        if self.lexicon.singular(word) != word:
            names = {name: words for name, words in names.items() if self._several(words)}
        found = closest(word, names, self._used, self._agreeing(word, names))
        if len(found) > 1:
            self.perhaps[word] = found
        return [names[found[0]]] if len(found) == 1 else []

    def _agreeing(self, word: str, names: Mapping[str, Words]) -> Words:
        """The names of things in whose labels the word before a noun stands, or of as many as it says."""
        before = {b for b, w in pairwise(self._said) if w == word}
        numbers = {e.value for b in before for e in self.lexicon.entries(b, "number")}
        wanted = {e.value for b in before for e in self.lexicon.entries(b, "modifier")}
        out = set()
        for name, words in names.items():
            called = [label_words(label, self.lexicon) for label in self._labels]
            called = [label for label in called if words <= label]
            sides = {e.value for label in called for w in label for e in self.lexicon.entries(w, "modifier")}
            if (wanted and wanted <= sides) or str(len(called)) in numbers - {"1"}:
                out.add(name)
        return frozenset(out)

    def _several(self, words: Words) -> bool:
        """Whether several things are called so, or a collection of several is: "Baubles"."""
        called = [label for label in self._labels if words <= label_words(label, self.lexicon)]
        if len(called) > 1:
            return True
        last = called[0].lower().split()[-1]
        return self.lexicon.singular(last) != last and sum(words <= label for label in self.named) > MOST_SINGLE

    def _note(self, word: str, noun: str, senses: Sequence[Words]) -> tuple[str, ...]:
        self._senses[noun] = tuple(senses)
        said = (f'"{" ".join(sorted(s))}"' for s in senses)
        self.notes.append(f'"{word}" read as {" or ".join(said)}')
        return (noun,)

    def _compound(self, singular: str) -> tuple[str, ...] | None:
        """ "Lampshade", where the labels have a lamp and a shade."""
        for cut in range(3, len(singular) - 2):
            both = {singular[:cut], singular[cut:]}
            if both <= self.vocabulary:
                if any(both <= words for words in self.named):
                    return (singular[:cut], singular[cut:])
                self.notes.append(f'"{singular}" read as "{singular[cut:]}"')
                return (singular[cut:],)
        return None
