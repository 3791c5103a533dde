"""Finding the things of a picture that a noun phrase speaks of."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from iconjax.errors import TranslationError
from iconjax.language.choosing import Chooser, listed
from iconjax.language.hearing import Hearing, label_words
from iconjax.language.lexicon import Lexicon
from iconjax.language.shapes import Shapes
from iconjax.language.things import Entity, Phrase, Reference
from iconjax.scene.types import Scene

__all__ = ["THINGS", "Entity", "Names", "Phrase", "Reference"]
THINGS = frozenset({"loose", "joint", "partlike", "kind", "end", "upright_thing", "portion"})
"""Categories of words that are names of things only, and mean nothing where the picture has no such thing."""


class Names:
    """The names of a scene and how people call them.

    Attributes:
        chooser: tells apart what has the same name; its `doubts` say what a phrase could be.
        trailing: a piece of a thing that was spoken of as a whole (the hub of a wheel) -> its main piece (the tyre).
    """

    def __init__(self, scene: Scene, lexicon: Lexicon, choices: Mapping[str, str] | None = None) -> None:
        self.scene, self.lexicon, self.shapes = scene, lexicon, Shapes(scene)
        self.objects = [Entity(o, label_words(o, lexicon), frozenset(), True) for o in scene.objects]
        self.parts = [
            Entity(s.name, label_words(s.object, lexicon), label_words(s.part, lexicon), False)
            for s in scene.segments
            if s.part is not None
        ]
        things = frozenset(
            w[0] for w, e in lexicon.phrases.items() if len(w) == 1 and {x.category for x in e} <= THINGS
        )
        labels = [*scene.objects, *(s.part for s in scene.segments if s.part is not None)]
        self.trailing: dict[str, str] = {}
        self.hearing = Hearing([e.words for e in (*self.objects, *self.parts)], lexicon, things, labels)
        self.chooser = Chooser(self.shapes, lexicon, self.hearing, choices or {})

    @property
    def doubts(self) -> dict[str, tuple[str, ...]]:
        """Phrase -> the names that it could be, of phrases that were looked up in vain."""
        return self.chooser.doubts

    @property
    def notes(self) -> list[str]:
        """What was read as something else, for the explanation of a reading."""
        return self.hearing.notes

    @property
    def vocabulary(self) -> frozenset[str]:
        """Every word of a label, in the singular."""
        return self.hearing.vocabulary

    def hear(self, word: str) -> tuple[str, ...] | None:
        """The nouns that a written word stands for, all at once; None where it names nothing here."""
        return self.hearing.hear(word)

    # ---- resolving ----

    def resolve(self, phrase: Phrase, within: Sequence[str] = ()) -> tuple[str, ...]:
        """Names of what a phrase without pronouns means; `within` restricts it to the parts of these things.

        Raises:
            TranslationError: nothing fits, or several things do.
        """
        found = self._candidates(phrase, within)
        if not found and len(phrase.nouns) > 1:
            found = self._by_last_noun(phrase, within)
        if not found:
            raise TranslationError(f'there is no "{phrase.text}"{_of(within)} in the picture')
        if phrase.ignored and not phrase.plural and len(found) == 1:
            members = self.members_if_collection(found[0].name)
            found = found if len(members) == 1 else [e for e in self.parts if e.name in members]
        pieces = self._in_pieces(found, phrase)
        found = self.chooser.narrow([group[0] for group in pieces.values()] if pieces else found, phrase)
        if phrase.indefinite is None and len(found) > 1 and not phrase.plural:
            found = self.chooser.doubt(phrase, found)
        few = len(found) == 1 or (phrase.plural and not phrase.foreign and len(phrase.ignored) == 1)
        if phrase.ignored and not (few and all(self._may_ignore(e, phrase) for e in found)):
            raise TranslationError(f'"{" ".join(phrase.ignored)}" is not understood')
        if phrase.ignored:
            told = f"{listed([e.name for e in found])}, the only {'one' if len(found) == 1 else 'ones'} in the picture"
            self.notes.append(f'"{phrase.text}" taken for {told}')
        names = tuple(e.name for e in found)
        self.trailing.update({e.name: group[0].name for group in pieces.values() for e in group[1:]})
        if pieces and phrase.count in (None, len(names)):
            return tuple(e.name for group in pieces.values() if group[0] in found for e in group)
        if phrase.count is not None and len(names) == 1:
            names = self.members_if_collection(names[0])
        if phrase.count is not None and len(names) != phrase.count:
            raise TranslationError(f'"{phrase.text}" could be {phrase.count} of {listed(names)}')
        if phrase.plural and len(names) == 1:
            names = self.members_if_collection(names[0])
            if len(names) == 1 and phrase.text.startswith("both "):
                raise TranslationError(f'"{phrase.text}" are two, and the picture has "{names[0]}" only')
        return names

    def _in_pieces(
        self, found: list[Entity], phrase: Phrase
    ) -> dict[tuple[frozenset[str], frozenset[str]], list[Entity]]:
        """Things that the picture shows in pieces, each with its largest piece first: tyre and hub of every wheel."""
        names = [n for n in phrase.nouns if self.lexicon.pieces.get(n) and n not in self.vocabulary]
        if len(phrase.nouns) != 1 or not names or any(e.whole for e in found):
            return {}
        groups: dict[tuple[frozenset[str], frozenset[str]], list[Entity]] = {}
        for entity in sorted(found, key=lambda e: -self.shapes.size(e.name)[0]):
            used = self.hearing.cover(names, entity.words) or frozenset()
            groups.setdefault((entity.object_words, entity.part_words - used), []).append(entity)
        return groups if any(len(g) > 1 for g in groups.values()) else {}

    def _by_last_noun(self, phrase: Phrase, within: Sequence[str]) -> list[Entity]:
        """The beach umbrella, of a beach and an umbrella that are things of their own."""
        found = self._candidates(replace(phrase, nouns=phrase.nouns[-1:]), within)
        if not found or not all(e.whole for e in found):
            return []
        self.notes.append(f'"{phrase.text}" read as "{phrase.nouns[-1]}"')
        return found

    def _may_ignore(self, entity: Entity, phrase: Phrase) -> bool:
        """Whether words that name nothing here may be left out, because the thing is the only such one.

        A part is not: "the elephant's trunk" is no tree's. But where the object is itself called by the name of a
        part ("Stick:Shaft"), the whole has no name in the picture, and the words name that.
        """
        if entity.whole:
            return True
        if phrase.foreign:
            return all(self.lexicon.knows(w, {"partlike"}) for w in entity.object_words)
        return True

    def members_if_collection(self, name: str) -> tuple[str, ...]:
        """The parts of an object that is a collection ("Candles:Left", "Candles:Right"), or its name."""
        parts = [e for e in self.parts if self.scene.segments[self.scene.members(e.name)[0]].object == name]
        collective = self.lexicon.singular(name.lower().split()[-1]) != name.lower().split()[-1]
        telling = {"modifier", "ordinal", "number", "descriptor", "orient"}
        counted = all(w.isdigit() or self.lexicon.knows(w, telling) for e in parts for w in e.part_words)
        return tuple(e.name for e in parts) if collective and counted and len(parts) > 1 else (name,)

    def like(self, phrase: Phrase) -> tuple[str, ...]:
        """Names of everything that a phrase without its modifiers may mean."""
        return tuple(e.name for e in self._candidates(phrase, ()))

    def _candidates(self, phrase: Phrase, within: Sequence[str]) -> list[Entity]:
        nouns = frozenset(phrase.nouns)
        parts, cover = self.parts, self.hearing.cover
        if within:
            inside = {i for name in within for i in self.scene.members(name)}
            own = [e for e in parts if set(self.scene.members(e.name)) <= inside]
            tiers = [[e for e in own if nouns and cover(nouns, e.part_words) == e.part_words]]
            tiers.append([e for e in own if (cover(nouns, e.words) or frozenset()) & e.part_words])
            # "the man's cane" may be a thing of its own
            others = [e for e in self.objects if e.name not in within]
            tiers.append([e for e in others if cover(nouns, e.object_words) == e.object_words])
            tiers.append([e for e in others if cover(nouns, e.object_words) is not None])
        else:
            tiers = [
                [e for e in self.objects if cover(nouns, e.object_words) == e.object_words],
                [e for e in parts if cover(nouns, e.part_words) == e.part_words or cover(nouns, e.words) == e.words],
                [e for e in self.objects if cover(nouns, e.object_words) is not None],
                [e for e in parts if (cover(nouns, e.words) or frozenset()) & e.part_words],
                [e for e in parts if cover(nouns, e.words) is not None],
            ]
        found = next((t for t in tiers if t), [])
        wanted = set(phrase.modifiers) | ({str(phrase.ordinal)} if phrase.ordinal else set())
        if wanted and nouns and not any(self.chooser.said(e, wanted, nouns) for e in found):
            # "the left bubble" of "Bubbles:Left": the part's whole name is the modifier
            telling = [e for e in parts if cover(nouns, e.words) is not None and self.chooser.said(e, wanted, nouns)]
            found = [e for e in telling if self.chooser.only_tells_apart(e, nouns)] or found
        if wanted and not phrase.plural and len(found) == 1 and found[0].whole:
            # "the rightmost sprinkle" of "Sprinkles:1", "Sprinkles:2"
            members = self.members_if_collection(found[0].name)
            found = [e for e in parts if e.name in members] or found
        return found


def _of(within: Sequence[str]) -> str:
    return f" of {listed(list(within))}" if within else ""
