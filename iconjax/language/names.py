"""Finding the things of a picture that a noun phrase speaks of."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from iconjax.errors import TranslationError
from iconjax.language.lexicon import Lexicon
from iconjax.language.shapes import Shapes
from iconjax.language.words import mend
from iconjax.scene.types import Scene

ADJECTIVAL = ("ed", "ing", "ish", "ous", "ive", "ful", "less", "ical", "most")
"""Endings of adjectives: such words describe, and name nothing."""
THINGS = frozenset({"loose", "joint", "partlike", "kind"})
"""Categories of words that are names of things only, and mean nothing where the picture has no such thing."""
GEOMETRIC = {
    "left": (0, 1),
    "right": (0, -1),
    "top": (1, 1),
    "bottom": (1, -1),
    "biggest": (2, -1),
    "smallest": (2, 1),
    "tallest": (3, -1),
    "shortest": (3, 1),
    "widest": (4, -1),
}
"""Modifier -> (measure: centre x, centre y, area, height, width; the sign that puts the meant one first)."""


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


@dataclass(frozen=True)
class Reference:
    """What a phrase turned out to mean: names, and perhaps a side of them."""

    names: tuple[str, ...]
    side: str | None = None


class Names:
    """The names of a scene and how people call them."""

    def __init__(self, scene: Scene, lexicon: Lexicon) -> None:
        self.scene, self.lexicon, self.shapes = scene, lexicon, Shapes(scene)
        self.notes: list[str] = []
        self.objects = [Entity(o, self._words(o), frozenset(), True) for o in scene.objects]
        self.parts = [
            Entity(s.name, self._words(s.object), self._words(s.part), False)
            for s in scene.segments
            if s.part is not None
        ]
        self.vocabulary = frozenset(w for e in (*self.objects, *self.parts) for w in e.words)
        self._things = frozenset(
            w[0] for w, e in lexicon.phrases.items() if len(w) == 1 and {x.category for x in e} <= THINGS
        )
        self._heard: dict[str, tuple[str, ...] | None] = {}

    def _words(self, label: str) -> frozenset[str]:
        words = re.findall(r"[a-zà-öø-ÿ]+|\d+", label.lower())
        return frozenset(self.lexicon.singular(w) for w in words)

    def hear(self, word: str) -> tuple[str, ...] | None:
        """Words of the scene's vocabulary that a written word stands for; None where it names nothing."""
        if word not in self._heard:
            self._heard[word] = self._hear(word)
        return self._heard[word]

    def _hear(self, word: str) -> tuple[str, ...] | None:
        singular = self.lexicon.singular(word)
        for form in (singular, word):
            if form in self.vocabulary:
                return (form,)
        for cut in range(3, len(singular) - 2):
            both = {singular[:cut], singular[cut:]}
            if both <= self.vocabulary:
                if any(both <= e.words for e in (*self.objects, *self.parts)):
                    return (singular[:cut], singular[cut:])
                self.notes.append(f'"{word}" read as "{singular[cut:]}"')
                return (singular[cut:],)
        if self.lexicon.knows(word, {"stop", "verb", "relation", "mode", "number", "unit", "pronoun"}):
            return None
        near = mend(singular, self.vocabulary) if word not in self.lexicon.words else None
        if near is not None and word in (near + "d", near + "ed"):
            return None  # "striped" describes, and is no stripe
        if near is None:
            same = self.lexicon.synonyms.get(singular, frozenset()) & self.vocabulary
            near = next(iter(same)) if len(same) == 1 else None
        if near is None and len(singular) > 2 and word not in self.lexicon.words - self._things:
            # "the cup" of a picture with a teacup
            tails = [v for v in self.vocabulary if v.endswith(singular) and len(v) > len(singular) + 2]
            near = tails[0] if len(tails) == 1 else None
        if near is not None:
            self.notes.append(f'"{word}" read as "{near}"')
            return (near,)
        return None

    # ---- resolving ----

    def resolve(self, phrase: Phrase, within: Sequence[str] = ()) -> tuple[str, ...]:
        """Names of what a phrase without pronouns means; `within` restricts it to the parts of these things.

        Raises:
            TranslationError: nothing fits, or several things do.
        """
        found = self._candidates(phrase, within)
        if not found:
            raise TranslationError(f'there is no "{phrase.text}"{_of(within)} in the picture')
        found = self._narrow(found, phrase)
        if phrase.indefinite is None and len(found) > 1 and not phrase.plural:
            raise TranslationError(f'"{phrase.text}" could be any of {_listed([e.name for e in found])}')
        if phrase.ignored and not (len(found) == 1 and self._may_ignore(found[0], phrase)):
            raise TranslationError(f'"{" ".join(phrase.ignored)}" is not understood')
        if phrase.ignored:
            self.notes.append(f'"{phrase.text}" taken for "{found[0].name}", the only one in the picture')
        names = tuple(e.name for e in found)
        if phrase.count is not None and len(names) == 1:
            names = self.members_if_collection(names[0])
        if phrase.count is not None and len(names) != phrase.count:
            raise TranslationError(f'"{phrase.text}" could be {phrase.count} of {_listed(names)}')
        if phrase.plural and len(names) == 1:
            names = self.members_if_collection(names[0])
            if len(names) == 1 and phrase.text.startswith("both "):
                raise TranslationError(f'"{phrase.text}" are two, and the picture has "{names[0]}" only')
        return names

    def _may_ignore(self, entity: Entity, phrase: Phrase) -> bool:
        """Whether words that name nothing here may be left out, because the thing is the only such one.

        A part is not: "the elephant's trunk" is no tree's. But where the object is itself called by the name of a
        part ("Stick:Shaft"), the whole has no name in the picture, and the words name that.
        """
        if entity.whole:
            return True
        if phrase.foreign:
            return all(self.lexicon.knows(w, {"partlike"}) for w in entity.object_words)
        return all(w.endswith(ADJECTIVAL) for w in phrase.ignored)

    def members_if_collection(self, name: str) -> tuple[str, ...]:
        """The parts of an object that is a collection ("Candles:Left", "Candles:Right"), or its name."""
        parts = [e for e in self.parts if self.scene.segments[self.scene.members(e.name)[0]].object == name]
        collective = self.lexicon.singular(name.lower().split()[-1]) != name.lower().split()[-1]
        telling = {"modifier", "ordinal", "number"}
        counted = all(w.isdigit() or self.lexicon.knows(w, telling) for e in parts for w in e.part_words)
        return tuple(e.name for e in parts) if collective and counted and len(parts) > 1 else (name,)

    def like(self, phrase: Phrase) -> tuple[str, ...]:
        """Names of everything that a phrase without its modifiers may mean."""
        return tuple(e.name for e in self._candidates(phrase, ()))

    def _candidates(self, phrase: Phrase, within: Sequence[str]) -> list[Entity]:
        nouns = frozenset(phrase.nouns)
        parts = self.parts
        if within:
            inside = {i for name in within for i in self.scene.members(name)}
            own = [e for e in parts if set(self.scene.members(e.name)) <= inside]
            tiers = [[e for e in own if nouns and nouns == e.part_words]]
            tiers.append([e for e in own if nouns & e.part_words and nouns <= e.words])
            # "the man's cane" may be a thing of its own
            tiers.append([e for e in self.objects if nouns == e.object_words and not set(within) & {e.name}])
            tiers.append([e for e in self.objects if nouns <= e.object_words and e.name not in within])
        else:
            tiers = [
                [e for e in self.objects if nouns == e.object_words],
                [e for e in parts if nouns == e.part_words or nouns == e.words],
                [e for e in self.objects if nouns <= e.object_words],
                [e for e in parts if nouns <= e.words and nouns & e.part_words],
                [e for e in parts if nouns <= e.words],
            ]
        found = next((t for t in tiers if t), [])
        wanted = set(phrase.modifiers) | ({str(phrase.ordinal)} if phrase.ordinal else set())
        if wanted and nouns and not any(self._said(e, wanted, nouns) for e in found):
            # "the left bubble" of "Bubbles:Left": the part's whole name is the modifier
            telling = [e for e in parts if nouns <= e.words and self._said(e, wanted, nouns)]
            found = [e for e in telling if self._only_tells_apart(e, nouns)] or found
        return found

    def _only_tells_apart(self, entity: Entity, nouns: frozenset[str]) -> bool:
        kinds = {"modifier", "ordinal", "number"}
        return all(w.isdigit() or self.lexicon.knows(w, kinds) for w in entity.part_words - nouns)

    def _said(self, entity: Entity, wanted: set[str], nouns: frozenset[str]) -> bool:
        return all(any(self._means(w, m) for w in entity.words - nouns) for m in wanted)

    def _means(self, word: str, modifier: str) -> bool:
        entries = self.lexicon.phrases.get((word,), ())
        ordinals = any(e.category in {"ordinal", "number"} and e.value == modifier for e in entries)
        return word == modifier or ordinals or any(e.category == "modifier" and e.value == modifier for e in entries)

    def _narrow(self, found: list[Entity], phrase: Phrase) -> list[Entity]:
        nouns = frozenset(phrase.nouns)
        unsaid = []
        for modifier in phrase.modifiers:
            said = [e for e in found if self._said(e, {modifier}, nouns)]
            if said:
                found = said
            else:
                unsaid.append(modifier)
        if phrase.ordinal is not None:
            said = [] if phrase.ordinal_from else [e for e in found if self._said(e, {str(phrase.ordinal)}, nouns)]
            found = said or self._nth(found, phrase)
        for modifier in unsaid:
            found = self._extreme(found, modifier, phrase)
        return found

    def _nth(self, found: list[Entity], phrase: Phrase) -> list[Entity]:
        axis, sign = GEOMETRIC[phrase.ordinal_from or "left"]
        ordered = sorted(found, key=lambda e: sign * self.shapes.centre(e.name)[axis])
        n = phrase.ordinal or 1
        if n > len(ordered):
            raise TranslationError(f'there is no "{phrase.text}": the picture has {len(ordered)} of them')
        return [ordered[n - 1 if n > 0 else n]]

    def _extreme(self, found: list[Entity], modifier: str, phrase: Phrase) -> list[Entity]:
        if len(found) < 2:
            return found
        if modifier == "middle" and len(found) % 2:
            return [sorted(found, key=lambda e: self.shapes.centre(e.name))[len(found) // 2]]
        if modifier not in GEOMETRIC:
            raise TranslationError(f'"{phrase.text}" could be any of {_listed([e.name for e in found])}')
        measure, sign = GEOMETRIC[modifier]
        if phrase.plural and len(found) > 2 and measure < 2:
            raise TranslationError(f'"{phrase.text}" could be any of {_listed([e.name for e in found])}')

        def key(entity: Entity) -> float:
            x, y = self.shapes.centre(entity.name)
            wide, high = self.shapes.size(entity.name)
            return sign * (x, y, wide * high, high, wide)[measure]

        ordered = sorted(found, key=key)
        least = 0.01 * self.scene.size
        if measure < 2 and key(ordered[1]) - key(ordered[0]) < least:
            raise TranslationError(f'"{phrase.text}" could be any of {_listed([e.name for e in found])}')
        return ordered[:1]


def _of(within: Sequence[str]) -> str:
    return f" of {_listed(list(within))}" if within else ""


def _listed(names: Sequence[str]) -> str:
    return ", ".join(f'"{n}"' for n in names)
