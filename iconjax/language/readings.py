"""From filled slots to clauses: which action is asked, of what, and how."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from iconjax.errors import TranslationError
from iconjax.language.clauses import Clause
from iconjax.language.context import Context
from iconjax.language.frames import Change, Relation, Shift, Slots
from iconjax.language.names import Reference
from iconjax.language.read_keeps import keep, negated
from iconjax.language.read_pairs import align, follow, gap, swap
from iconjax.language.read_places import join, move
from iconjax.language.read_sizes import scale
from iconjax.language.read_turns import rotate, sense_of, turns
from iconjax.language.reading import FOLLOWING, TURNED, listed

TELLING = ("on", "inside", "above", "below", "left_of", "right_of", "beside", "touch")
"""Relations that may only tell which thing is meant."""


class Reader:
    """Reads clauses one after the other, remembering what was spoken of."""

    def __init__(self, context: Context) -> None:
        self.context = context

    def read(self, slots: Slots) -> list[Clause]:
        """The readings of a clause.

        Raises:
            TranslationError: the slots fit no reading.
        """
        if "rest" in slots.marks:
            if (
                slots.kinds() <= {"keep", "make", "move", "scale"}
                and not slots.theme
                and not slots.relations
                and not slots.changes
            ):
                return []
            raise TranslationError('"everything" is not a thing of the picture; name what should change')
        context = self.context
        if len(slots.shifts) == 1 and slots.shifts[0].place and not slots.verbs and not slots.relations:
            return [Clause("side", context.theme(()).names, direction=slots.shifts[0].direction)]
        self._inherit(slots)
        relation = slots.relations[0].kind if slots.relations else ""
        theme = context.theme(slots.theme, relation)
        clauses = list(self._clauses(slots, theme))
        if not clauses:
            raise TranslationError(f"what should happen to {listed(theme.names)} is not understood")
        if slots.connector in ("so", "so that", "such that") and slots.theme and context.themes:
            guessed = all(c.amount is not None and c.amount.mode == "unsaid" for c in clauses)
            other = theme.side is None and not set(theme.names) & {*context.themes[0], "@theme", "@ground"}
            if guessed and other:
                clauses = [Clause("topic", theme.names)]  # what follows from the change before
        context.remember(theme.names, [c.reference for c in clauses])
        if slots.verbs:
            context.verbs = slots.verbs
        return clauses

    def _inherit(self, slots: Slots) -> None:
        """Complete an elliptical clause: "... and the right one squarely on top of that"."""
        if not slots.verbs and self._says(slots) and slots.connector not in (*FOLLOWING, "while"):
            slots.verbs = list(self.context.verbs)

    def _says(self, slots: Slots) -> bool:
        """Whether a clause says anything besides what it is about."""
        return bool(slots.changes or slots.shifts or slots.relations or slots.amount or slots.marks)

    def _clauses(self, slots: Slots, theme: Reference) -> Iterator[Clause]:
        kinds = slots.kinds()
        if slots.theme and kinds <= {"make"} and not self._says(slots) and slots.follows in (":", ","):
            yield Clause("topic", theme.names)
            return
        vague = all(
            a is None or a.vague
            for a in (slots.amount, *(c.amount for c in slots.changes), *(s.amount for s in slots.shifts))
        )
        if slots.follows in ("by", ":") and vague and not slots.relations and (slots.theme or slots.follows == "by"):
            yield Clause("topic", theme.names)
            return
        if slots.negated:
            yield from negated(self.context, slots, theme)
        elif "keep" in kinds or ("fixed" in slots.marks and not slots.changes):
            yield from keep(self.context, slots, theme)
        elif "swap" in kinds:
            yield swap(self.context, theme, slots)
        elif slots.gap or ("apart" in slots.marks and not kinds & {"rotate"}):
            yield gap(self.context, slots, theme)
        elif "align" in kinds and not slots.relations:
            yield align(self.context, slots, theme)
        elif "follow" in kinds or any(r.kind == "with" for r in slots.relations):
            yield from follow(self.context, slots, theme)
        elif kinds & {"join", "part"}:
            yield from join(self.context, slots, theme, "touch" if "join" in kinds else "outside")
        else:
            yield from self._motions(slots, theme)

    def _motions(self, slots: Slots, theme: Reference) -> Iterator[Clause]:
        kinds = slots.kinds()
        self._sort_higher(slots, kinds)
        yield from self._described(slots, theme)
        amount = slots.amount
        if (
            kinds <= {"make"}
            and amount is not None
            and amount.of is not None
            and not slots.changes
            and not slots.shifts
        ):
            slots.changes, slots.amount = [Change(amount.of.dim, 0, amount, same=True)], None
        elif kinds <= {"make"} and amount is not None and amount.unit == "times" and not self._says_place(slots):
            slots.changes, slots.amount = [Change("size", 0, amount, same=True)], None
        if theme.side is not None and (slots.changes or kinds & {"scale", "rotate"}):
            raise TranslationError(f"the {theme.side} of {listed(theme.names)} cannot change by itself")
        found = False
        if turns(slots, kinds):
            yield from rotate(self.context, slots, theme)
            found = True
        if slots.changes or "scale" in kinds:
            yield from scale(self.context, slots, theme)
            found = True
        relations = [r for r in slots.relations if r.kind not in (*TURNED, "around") and not sense_of(r, slots)]
        verbs = any(v.value == "move" for v in slots.verbs)
        if relations or slots.shifts or verbs or kinds & {"center"}:
            idle = (
                found
                and not relations
                and not slots.shifts
                and "rotate" not in kinds
                and any(v.info.get("place") for v in slots.verbs)
            )
            if not idle and (kinds & {"move", "center"} or relations or (slots.shifts and not found)):
                yield from move(self.context, slots, theme, relations)

    def _sort_higher(self, slots: Slots, kinds: set[str]) -> None:
        """ "Higher" and "lower" say a size with a percentage, and a place with a verb of motion."""
        for change in [c for c in slots.changes if c.ambiguous]:
            relative = (
                change.amount is not None and change.amount.unit in ("ratio", "times") and not change.amount.vague
            )
            if "move" in kinds or not relative:
                if "move" not in kinds:
                    raise TranslationError(
                        f'"{change.ambiguous}" may be a place or a height: say move ... up or make ... taller'
                    )
                slots.changes.remove(change)
                slots.shifts.append(Shift("up" if change.ambiguous == "higher" else "down", change.amount))

    def _says_place(self, slots: Slots) -> bool:
        return bool(slots.changes or slots.shifts or slots.relations)

    def _described(self, slots: Slots, theme: Reference) -> Iterator[Clause]:
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
            if not relation.reference or (relation.kind == "around" and turns(slots, slots.kinds())):
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
        if slots.kinds() == {"scale"} and len(things) == len(target) == 1:
            kind = relation.kind.replace("_", " ")
            raise TranslationError(f"{listed(things)} is not {kind} {listed(target)}")
        return False

    def _already(self, things: Sequence[str], kind: str, target: Sequence[str]) -> bool:
        """Whether a thing is, roughly, in a relation to one other now, or is a part of it."""
        if not len(things) == len(target) == 1:
            return False
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
        if not self.context.names.shapes.lies(other[0], relation.kind, where[0]):
            raise TranslationError(f'"{other[0]}" is not {relation.kind.replace("_", " ")} "{where[0]}"')
        slots.relations.remove(relation)
