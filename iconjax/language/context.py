"""What was spoken of so far, and how pronouns and ellipses find it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from iconjax.errors import TranslationError
from iconjax.language.bearings import side_facing
from iconjax.language.lexicon import Entry
from iconjax.language.names import Names, Phrase, Reference

NEAREST = {"left_of": (0, 1), "right_of": (0, -1), "above": (1, 1), "on": (1, 1), "below": (1, -1)}
"""Relation -> which of several like things is nearest to it: axis, and sign of the coordinate to minimise."""


@dataclass
class Context:
    """The memory of one request.

    Attributes:
        names: the names of the scene.
        themes: what earlier clauses were about, the latest first.
        mentions: everything mentioned, the latest first.
        last: the last phrase with a noun in the place of a theme, for "the right one".
        related: the last phrase with a noun in the place of a reference.
        beside: what the phrase before in the same list means.
        verbs: verbs of the last clause that had some, for clauses without.
        direction: direction that an "until" clause inherits.
        sign: 1 where the last change of size was one to larger, -1 to smaller.
        complained: extent of which the clause before said that it is wrong.
    """

    names: Names
    themes: list[tuple[str, ...]] = field(default_factory=list)
    mentions: list[tuple[str, ...]] = field(default_factory=list)
    last: Phrase | None = None
    related: Phrase | None = None
    beside: tuple[str, ...] = ()
    verbs: list[Entry] = field(default_factory=list)
    direction: str = ""
    complained: str = ""
    sign: int = 0
    used: set[str] = field(default_factory=set)

    def remember(self, theme: Sequence[str], references: Sequence[tuple[str, ...]]) -> None:
        """Note what a clause spoke of."""
        for names in (*references, tuple(theme)):
            if names and names[0] not in ("canvas", "@ground"):
                self.mentions.insert(0, names)
        if theme:
            self.themes.insert(0, tuple(theme))
            self.used |= set(theme)

    @property
    def spoken(self) -> set[str]:
        """Every name mentioned so far."""
        return {n for m in self.mentions for n in m}

    def theme(self, phrases: Sequence[Phrase], relation: str = "") -> Reference:
        """What the phrases in the place of the theme mean; without any, the theme of the clause before."""
        if not phrases:
            if not self.themes:
                raise TranslationError("the request does not say what should change")
            return Reference(self.themes[0])
        if spot := next((p.loose for p in phrases if p.loose), ""):
            raise TranslationError(f'"{spot}" is not one of the things in the picture')
        found = self._all(phrases, (), relation)
        self.last = next((p for p in phrases if p.nouns), self.last)
        return found

    def reference(self, phrases: Sequence[Phrase], theme: Sequence[str]) -> Reference:
        """What the phrases after a relation mean."""
        return self.led(self._all(phrases, theme, ""))

    def _meant(self, phrase: Phrase, theme: Sequence[str]) -> tuple[str, ...]:
        """ "(From the left lamp to) the right one": of the kind of what something was last related to."""
        last = self.related
        if phrase.nouns or phrase.indefinite not in (None, "one") or not phrase.modifiers or not theme or last is None:
            return ()
        try:
            found = self.names.resolve(replace(phrase, nouns=last.nouns, indefinite=None))
        except TranslationError:
            return ()
        return found if not set(found) & set(theme) else ()

    def led(self, reference: Reference) -> Reference:
        """Without the pieces of a thing that its main piece stands for."""
        kept = tuple(n for n in reference.names if self.names.trailing.get(n) not in reference.names)
        return replace(reference, names=kept)

    def _all(self, phrases: Sequence[Phrase], theme: Sequence[str], relation: str) -> Reference:
        if not phrases:
            raise TranslationError("what it should be related to is not said")
        found: list[Reference] = []
        for index, phrase in enumerate(phrases):
            bare = not phrase.nouns and not phrase.pronoun and not phrase.special and not phrase.side
            if bare and index + 1 < len(phrases):
                phrase = replace(phrase, nouns=phrases[-1].nouns, owner=phrase.owner or phrases[-1].owner)
            self.beside = found[-1].names if found else ()
            found.append(self.one(phrase, theme, relation))
        self.beside = ()
        if found[0].side and phrases[0].text.split(" of ")[0].endswith("s"):
            found = [replace(f, side=found[0].side) for f in found]  # "the tops of A and B"
        sides = {f.side for f in found}
        if len(sides) > 1:
            raise TranslationError("a side of one thing and the whole of another cannot be told of together")
        return Reference(tuple(dict.fromkeys(n for f in found for n in f.names)), sides.pop())

    def one(self, phrase: Phrase, theme: Sequence[str] = (), relation: str = "") -> Reference:
        """What one phrase means."""
        if phrase.loose:
            self.names.notes.append(f'"{phrase.text}" taken for all of it')
        if phrase.special is not None:
            return Reference(("canvas" if phrase.special == "canvas" else "@ground",))
        if phrase.pronoun is not None:
            return Reference(self._pronoun(phrase, theme))
        owner = phrase.owner
        if owner is not None and owner.pronoun is not None and owner.owner is None and phrase.side is None:
            return self._possessed(phrase, theme, relation)
        owners = self.one(owner, theme).names if owner is not None else ()
        if phrase.side is not None:
            return self._sided(phrase, phrase.side, owners)
        if owners == ("canvas",) or owners == ("@ground",):
            owners = ()
        if meant := self._meant(phrase, theme):
            return Reference(meant)
        if theme and phrase.nouns and not phrase.owner:
            self.related = phrase
        if not phrase.nouns:
            if self.last is None:
                raise TranslationError(f'"{phrase.text}" does not say which thing is meant')
            phrase = replace(phrase, nouns=self.last.nouns)
            if phrase.owner is None and self.last.owner is not None:
                owners = self.one(self.last.owner, theme).names
        return Reference(self._choose(phrase, self._named(phrase, owners), theme, relation))

    def _sided(self, phrase: Phrase, side: str, owners: tuple[str, ...]) -> Reference:
        if not owners:
            corner = len(side) > 6 or "edge" in phrase.text or "border" in phrase.text
            owners = ("canvas",) if corner else ("@theme",)
        return Reference(owners, side_facing(self.names.shapes, owners, side))

    def _possessed(self, phrase: Phrase, theme: Sequence[str], relation: str) -> Reference:
        """ "Its roof": of the theme where it has one, else of what was mentioned before."""
        failure: TranslationError | None = None
        for owners in (
            ([self.beside] if self.beside else [])
            + ([tuple(theme)] if theme else [])
            + (self.mentions if theme else [*self.themes, *self.mentions])
        ):
            try:
                return Reference(self._choose(phrase, self._named(phrase, owners), theme, relation))
            except TranslationError as error:
                failure = failure or error
        near = self._near(phrase, theme) if failure is not None and theme else ()
        if near:
            return Reference(near)
        side = self._as_side(phrase)
        if failure is not None and side and theme:
            return Reference(tuple(theme), side)
        if failure is None:  # "make its arms longer": nothing was spoken of, but only one thing may have arms
            return Reference(self._choose(phrase, self._named(phrase, ()), theme, relation))
        raise failure

    def _near(self, phrase: Phrase, theme: Sequence[str]) -> tuple[str, ...]:
        """The one thing of a name that touches the theme: a blossom's "its stalk"."""
        try:
            found = self._named(phrase, ())
        except TranslationError:
            return ()
        shapes = self.names.shapes
        return found if len(found) == 1 and all(shapes.lies(found[0], "touch", n) for n in theme) else ()

    def _as_side(self, phrase: Phrase) -> str:
        """The side that a noun may also mean: "its foot" of a thing that has no such part."""
        alone = len(phrase.nouns) == 1 and not phrase.modifiers and not phrase.ordinal
        got = self.names.lexicon.match(list(phrase.nouns), 0, "side") if alone else None
        return got[0].value if got is not None else ""

    def _named(self, phrase: Phrase, owners: Sequence[str]) -> tuple[str, ...]:
        if phrase.indefinite:
            phrase = replace(phrase, plural=True)
        if phrase.count is not None and self.mentions:
            # "the three boxes" may be those spoken of before
            every = self.names.resolve(replace(phrase, count=None), owners)
            before = tuple(n for n in every if n in self.spoken)
            if len(every) != phrase.count == len(before):
                return before
        try:
            return self.names.resolve(phrase, owners)
        except TranslationError:
            if len(owners) == 1 and (own := self._called_after(phrase, owners[0])):
                return own
            if not owners and (found := self._of_theme(phrase)):
                return found
            objects = tuple(dict.fromkeys(s.object for o in owners for s in self.names.shapes.segments(o)))
            if not owners or set(objects) == set(owners):
                raise
            return self.names.resolve(phrase, objects)

    def _called_after(self, phrase: Phrase, owner: str) -> tuple[str, ...]:
        """The one of several like things that bears the owner's name: a door's window is the "Door Window"."""
        own = {w for e in self.names.parts if e.name == owner for w in e.part_words}
        like = [n for n in self.names.like(phrase) if n != owner]
        named = [e.name for e in self.names.parts if e.name in like and own and own <= e.part_words]
        return (named[0],) if len(named) == 1 and not phrase.modifiers and not phrase.plural else ()

    def _of_theme(self, phrase: Phrase) -> tuple[str, ...]:
        """What a phrase that could be several things means among the parts of what was spoken of last: "the wax"."""
        for theme in self.themes[:2]:
            objects = tuple(dict.fromkeys(s.object for n in theme for s in self.names.shapes.segments(n)))
            wider = replace(phrase, plural=len(theme) > 1 or phrase.plural)
            for owners in (theme, objects):
                try:
                    found = self.names.resolve(wider, owners)
                except TranslationError:
                    continue
                if len(found) <= max(len(theme), 1) or phrase.plural:
                    return found
        return ()

    def _choose(self, phrase: Phrase, names: tuple[str, ...], theme: Sequence[str], relation: str) -> tuple[str, ...]:
        if phrase.indefinite is None:
            return names
        left = [n for n in names if n not in self.used and n not in theme]
        if not left or (phrase.indefinite == "other" and len(left) > 1 and not phrase.plural):
            raise TranslationError(f'"{phrase.text}" does not say which thing is meant')
        if phrase.indefinite == "other":
            return tuple(left)
        if relation in NEAREST:
            axis, sign = NEAREST[relation]
            left.sort(key=lambda n: sign * self.names.shapes.centre(n)[axis])
        return (left[0],)

    def _pronoun(self, phrase: Phrase, theme: Sequence[str]) -> tuple[str, ...]:
        if not theme:
            known = self.themes
        else:
            known = [m for m in self.mentions if not set(m) & set(theme)]
            if not known and phrase.text in ("it", "its", "their", "his", "her"):
                known = [tuple(theme)]
        fitting = [m for m in known if (len(m) > 1) == (phrase.pronoun == "them")] or known
        if not fitting:
            raise TranslationError(f'"{phrase.text or phrase.pronoun}" does not say which thing is meant')
        return fitting[0]
