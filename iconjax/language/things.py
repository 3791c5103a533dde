"""Noun phrases, the things that have names, and what a phrase turned out to mean."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Entity:
    """Something with a name: an object, or one part of it."""

    name: str
    object_words: frozenset[str]
    part_words: frozenset[str]
    whole: bool

    @property
    def words(self) -> frozenset[str]:
        """All words of the name."""
        return self.object_words | self.part_words


@dataclass(frozen=True)
class Phrase:
    """A noun phrase as written.

    Attributes:
        nouns: words that name the thing, singular; empty for "the left one".
        modifiers: sides, sizes and the like, by their meaning.
        ordinal: 1 for the first, -1 for the last, None.
        ordinal_from: side from which ordinals count, where the request says so.
        plural: more than one is meant, or one of every kind ("each").
        pronoun: "it", "them", "its" or None.
        indefinite: "one"/"another" of several, or "other": what is left over.
        owner: the phrase after "of" or before "'s".
        side: a side of the thing rather than the thing.
        special: "canvas" or "ground".
        count: "the two birds".
        ignored: words about the thing that nothing in the picture confirms; only whole objects may have them.
        foreign: the words in `ignored` name an owner that the picture does not know ("of the joystick").
        loose: a spot on the thing that the picture does not tell apart ("the rim", "the hand"); it can be met,
            not changed.
        descriptors: words that describe ("red", "leaning"); they count only where several things are left.
        text: as written.
    """

    text: str
    nouns: tuple[str, ...] = ()
    modifiers: tuple[str, ...] = ()
    ordinal: int | None = None
    ordinal_from: str = ""
    plural: bool = False
    pronoun: str | None = None
    indefinite: str | None = None
    owner: Phrase | None = None
    side: str | None = None
    special: str | None = None
    count: int | None = None
    ignored: tuple[str, ...] = ()
    foreign: bool = False
    loose: str = ""
    descriptors: tuple[str, ...] = ()


@dataclass(frozen=True)
class Reference:
    """What a phrase turned out to mean: names, and perhaps a side of them."""

    names: tuple[str, ...]
    side: str | None = None
