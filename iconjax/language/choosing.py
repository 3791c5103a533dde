"""Telling apart things of the same name: by what their names say, by where and how large they are, by their pose."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from iconjax.errors import TranslationError
from iconjax.language.hearing import Hearing
from iconjax.language.lexicon import Lexicon
from iconjax.language.shapes import Shapes
from iconjax.language.things import Entity, Phrase

LEANS = 5.0
"""Degrees from upright and level beyond which a thing leans."""
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


class Chooser:
    """Picks, of several things, those that a phrase means.

    Attributes:
        choices: phrase -> the name that is meant where it could be any of several.
        doubts: phrase -> the names that it could be, of phrases that were looked up in vain.
        notes: what was assumed, for the explanation of a reading.
    """

    def __init__(self, shapes: Shapes, lexicon: Lexicon, hearing: Hearing, choices: Mapping[str, str]) -> None:
        self.shapes, self.lexicon, self.hearing, self.notes = shapes, lexicon, hearing, hearing.notes
        self.choices, self.doubts = dict(choices), dict[str, tuple[str, ...]]()

    def narrow(self, found: list[Entity], phrase: Phrase) -> list[Entity]:
        nouns = frozenset(phrase.nouns)
        unsaid = []
        for modifier in phrase.modifiers:
            said = [e for e in found if self.said(e, {modifier}, nouns)]
            if said:
                said = self._literal(said, modifier, phrase)
                found = self._extreme(said, modifier, phrase) if self._superlative(modifier, phrase, said) else said
            else:
                unsaid.append(modifier)
        if phrase.ordinal is not None:
            said = [] if phrase.ordinal_from else [e for e in found if self.said(e, {str(phrase.ordinal)}, nouns)]
            found = said or self._nth(found, phrase)
        for modifier in unsaid:
            found = self._extreme(found, modifier, phrase)
        return self._posed(self._plainest(found, phrase), phrase)

    def _literal(self, said: list[Entity], modifier: str, phrase: Phrase) -> list[Entity]:
        """Of a lower and a bottom rung the one whose word was used."""
        words = {w for w in phrase.text.split() for e in self.lexicon.entries(w, "modifier") if e.value == modifier}
        return [e for e in said if words & e.words] or said

    def _superlative(self, modifier: str, phrase: Phrase, said: Sequence[Entity]) -> bool:
        """Whether "lowest" and the like are left with several that are called lower or bottom ones."""
        words = (w for w in phrase.text.split() if w.endswith(("est", "most")))
        most = any(e.value == modifier for w in words for e in self.lexicon.entries(w, "modifier"))
        return most and len(said) > 1 and not phrase.plural and modifier in GEOMETRIC

    def _plainest(self, found: list[Entity], phrase: Phrase) -> list[Entity]:
        """Of things that all have what a phrase says, the one that says nothing more: the top leaf."""
        if len(found) < 2 or phrase.plural or not phrase.modifiers:
            return found
        extra = [len(e.part_words) for e in found]
        return [found[extra.index(min(extra))]] if extra.count(min(extra)) == 1 else found

    def doubt(self, phrase: Phrase, found: list[Entity]) -> list[Entity]:
        """The one of several things that was chosen beforehand.

        Raises:
            TranslationError: none was; what the phrase could be is kept in `doubts`.
        """
        chosen = [e for e in found if e.name == self.choices.get(phrase.text)]
        if len(chosen) == 1:
            self.notes.append(f'"{phrase.text}" taken for "{chosen[0].name}"')
            return chosen
        self.doubts[phrase.text] = tuple(e.name for e in found)
        raise TranslationError(f'"{phrase.text}" could be any of {listed([e.name for e in found])}')

    def _nth(self, found: list[Entity], phrase: Phrase) -> list[Entity]:
        axis, sign = GEOMETRIC[phrase.ordinal_from or "left"]
        ordered = sorted(found, key=lambda e: sign * self.shapes.centre(e.name)[axis])
        n = phrase.ordinal or 1
        if n > len(ordered):
            raise TranslationError(f'there is no "{phrase.text}": the picture has {len(ordered)} of them')
        return [ordered[n - 1 if n > 0 else n]]

    def _at_ends(self, found: list[Entity], outer: bool) -> list[Entity]:
        """The first and the last of a row, or those between them."""
        centres = [self.shapes.centre(e.name) for e in found]
        axis = (
            0
            if max(x for x, _ in centres) - min(x for x, _ in centres)
            >= max(y for _, y in centres) - min(y for _, y in centres)
            else 1
        )
        row = sorted(found, key=lambda e: self.shapes.centre(e.name)[axis])
        return [row[0], row[-1]] if outer else row[1:-1]

    def _posed(self, found: list[Entity], phrase: Phrase) -> list[Entity]:
        """Of several things the one that leans, or stands, as a description says."""
        for word in phrase.descriptors:
            pose = self.lexicon.match([word], 0, "posed")
            if pose is not None and not phrase.plural and len(found) > 1:
                fitting = [e for e in found if self.shapes.oblique(e.name, LEANS) == (pose[0].value == "leaning")]
                found = fitting if len(fitting) == 1 else found
        return found

    def _extreme(self, found: list[Entity], modifier: str, phrase: Phrase) -> list[Entity]:
        if len(found) < 2:
            return found
        if modifier in ("outer", "inner") and phrase.plural and len(found) > 2:
            return self._at_ends(found, modifier == "outer")
        if modifier == "middle" and len(found) % 2:
            return [sorted(found, key=lambda e: self.shapes.centre(e.name))[len(found) // 2]]
        if modifier not in GEOMETRIC:
            return self.doubt(phrase, found)
        measure, sign = GEOMETRIC[modifier]
        if phrase.plural and len(found) > 2 and measure < 2:
            return self.doubt(phrase, found)

        def key(entity: Entity) -> float:
            x, y = self.shapes.centre(entity.name)
            wide, high = self.shapes.size(entity.name)
            return sign * (x, y, wide * high, high, wide)[measure]

        ordered = sorted(found, key=key)
        least = 0.01 * self.shapes.scene.size
        if measure < 2 and key(ordered[1]) - key(ordered[0]) < least:
            return self.doubt(phrase, found)
        return ordered[:1]

    def only_tells_apart(self, entity: Entity, nouns: frozenset[str]) -> bool:
        kinds = {"modifier", "ordinal", "number"}
        left = entity.part_words - (self.hearing.cover(nouns, entity.words) or frozenset())
        return all(w.isdigit() or self.lexicon.knows(w, kinds) for w in left)

    def said(self, entity: Entity, wanted: set[str], nouns: frozenset[str]) -> bool:
        left = entity.words - (self.hearing.cover(nouns, entity.words) or frozenset())
        return all(any(self._means(w, m) for w in left) for m in wanted)

    def _means(self, word: str, modifier: str) -> bool:
        entries = self.lexicon.phrases.get((word,), ())
        ordinals = any(e.category in {"ordinal", "number"} and e.value == modifier for e in entries)
        return word == modifier or ordinals or any(e.category == "modifier" and e.value == modifier for e in entries)


def listed(names: Sequence[str]) -> str:
    """Names in quotes."""
    return ", ".join(f'"{n}"' for n in names)
