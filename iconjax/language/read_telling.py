"""Relations that only tell which thing is meant: "halve the post under the sign", "as wide as the monitor above it"."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from iconjax.errors import TranslationError
from iconjax.language.clauses import Clause
from iconjax.language.context import Context
from iconjax.language.frames import Relation, Slots
from iconjax.language.names import Reference
from iconjax.language.read_turns import turns
from iconjax.language.reading import listed

TELLING = ("on", "inside", "above", "below", "left_of", "right_of", "beside", "touch")
"""Relations that may only tell which thing is meant."""
OPPOSITE_SIDE = {"top": "bottom", "bottom": "top", "left": "right", "right": "left"}


class Teller:
    """Takes out of a clause what only tells things apart."""

    def __init__(self, context: Context) -> None:
        self.context = context

    def described(self, slots: Slots, theme: Reference) -> Iterator[Clause]:
        """Take out relations that only describe: "move the cup on the table left"."""
        shapes = self.context.names.shapes
        goals = bool(
            [s for s in slots.shifts if s.amount]
            or slots.changes
            or slots.amount
            or slots.kinds() & {"rotate", "scale", "orient"}
        )
        resizes = bool(slots.changes or slots.kinds() & {"rotate", "scale", "orient"})
        previous = theme.names
        for index, relation in enumerate(list(slots.relations)):
            if relation.compared and relation.kind in TELLING and not slots.kinds() & {"move"}:
                self._tells(slots, relation, theme)
                continue
            if self._settled(slots, relation):
                continue
            target = self.context.reference(relation.reference, theme.names).names
            part_of_theme = all(any(shapes.part_of(t, n) for n in theme.names) for t in target)
            if resizes and self._only_tells(slots, relation, previous, target):
                slots.relations.remove(relation)  # "halve the post under the sign"
                previous = target
                continue
            if relation.kind in ("around", "bears"):
                # "the girder hanging from it"
                if not self._already(previous, "touch", target):
                    raise TranslationError(f'what "{listed(target)}" has to do with it is not understood')
                slots.relations.remove(relation)
                continue
            if relation.kind in ("left_side", "right_side"):
                self._beside_or_on(relation, theme, target)
            if relation.kind in ("on", "inside") and part_of_theme:
                slots.relations.remove(relation)
                yield Clause("stay", target)
            elif relation.kind in ("on", "inside") and (index > 0 or goals) and len(previous) == len(target) == 1:
                if shapes.lies(previous[0], relation.kind, target[0]):
                    slots.relations.remove(relation)
                elif index > 0:
                    raise TranslationError(
                        f'two places in one clause: "{previous[0]}" is not {relation.kind} "{target[0]}"'
                    )
            previous = target

    def _settled(self, slots: Slots, relation: Relation) -> bool:
        """Whether a relation needs no look at what it leads to."""
        if (slots.changes or "scale" in slots.kinds()) and self._gives(slots, relation):
            return True
        if slots.complaint and relation.reference and relation.kind in TELLING:
            slots.relations.remove(relation)  # "the spring under the horse is too tall"
            return True
        return not relation.reference or (relation.kind == "around" and turns(slots, slots.kinds()))

    def _gives(self, slots: Slots, relation: Relation) -> bool:
        """Whether a relation says at which side a thing grows or shrinks: "20 px taller at the top"."""
        end = relation.reference[0] if len(relation.reference) == 1 else None
        if (
            end is None
            or end.side not in OPPOSITE_SIDE
            or end.owner is not None
            or relation.kind not in ("around", "on")
        ):
            return False
        slots.relations.remove(relation)
        slots.marks["stays"] = OPPOSITE_SIDE[end.side]
        return True

    def _beside_or_on(self, relation: Relation, theme: Reference, target: Sequence[str]) -> None:
        shapes = self.context.names.shapes
        x0, _, x1, _ = shapes.box(target[0])
        if target[0] != "canvas" and any(x0 < shapes.centre(n)[0] < x1 for n in theme.names):
            raise TranslationError(
                f"beside {listed(tuple(target))}, or on one half of it? say left of it or at its left end"
            )
        relation.kind = relation.kind.replace("side", "of")

    def _only_tells(self, slots: Slots, relation: Relation, things: tuple[str, ...], target: tuple[str, ...]) -> bool:
        """Whether a relation in a clause about a size or a turn only says which thing is meant."""
        if relation.kind not in TELLING or "move" in slots.kinds():
            return False
        if self._already(things, relation.kind, target):
            return True
        if len(things) > 1 and any(self._already((n,), relation.kind, target) for n in things):
            kind = relation.kind.replace("_", " ")
            raise TranslationError(f"not all of {listed(things)} are {kind} {listed(tuple(target))}")
        if slots.kinds() == {"scale"} and len(things) == len(target) == 1:
            kind = relation.kind.replace("_", " ")
            raise TranslationError(f"{listed(things)} is not {kind} {listed(target)}")
        return False

    def _already(self, things: Sequence[str], kind: str, target: Sequence[str]) -> bool:
        """Whether a thing is, roughly, in a relation to one other now, or is a part of it."""
        if not target or not things:
            return False
        if len(things) > 1 or len(target) > 1:
            return all(any(self._already((name,), kind, (other,)) for other in target) for name in things)
        shapes, (name, other) = self.context.names.shapes, (things[0], target[0])
        if other in ("canvas", "@ground", "@theme"):
            return False
        near = kind in ("on", "inside") and shapes.lies(name, "touch", other)
        return near or shapes.part_of(name, other) or shapes.lies(name, kind, other)

    def _tells(self, slots: Slots, relation: Relation, theme: Reference) -> None:
        """Take out what only says which other thing a size is compared with: "the monitor above it"."""
        other = self.context.reference(relation.compared, theme.names).names
        own = all(p.pronoun and not p.owner for p in relation.reference)
        where = theme.names if own else self.context.reference(relation.reference, theme.names).names
        if not (len(other) == len(where) == 1) or where[0] in ("@ground", "canvas"):
            raise TranslationError(f'the part of "{relation.kind}" in the request is unclear')
        whole = self.context.names.shapes.part_of(where[0], other[0])
        if not whole and not self.context.names.shapes.lies(other[0], relation.kind, where[0]):
            raise TranslationError(f'"{other[0]}" is not {relation.kind.replace("_", " ")} "{where[0]}"')
        slots.relations.remove(relation)
