"""From filled slots to clauses: which action is asked, of what, and how."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from iconjax.errors import TranslationError
from iconjax.language.clauses import Amount, Clause
from iconjax.language.context import Context
from iconjax.language.frames import Change, Shift, Slots
from iconjax.language.names import Reference
from iconjax.language.read_keeps import keep, negated
from iconjax.language.read_pairs import align, follow, gap, space, swap
from iconjax.language.read_places import join, move
from iconjax.language.read_sizes import scale
from iconjax.language.read_telling import Teller
from iconjax.language.read_turns import rotate, sense_of, turns
from iconjax.language.reading import FOLLOWING, TURNED, listed

SETTLING = frozenset({"end up", "come out", "turn out"})
"""Verbs with which "higher" is a place."""


ENDS = frozenset({"", "edge", "end", "ends", "corner"})
"""Spots at which a gap is another one than that of the things themselves."""


def _is_factor(amount: Amount) -> bool:
    """Whether an amount alone says a size: "the jib to 130 %", "twice"."""
    return amount.unit == "times" or (amount.unit == "ratio" and amount.mode == "to" and not amount.vague)


class Reader:
    """Reads clauses one after the other, remembering what was spoken of."""

    def __init__(self, context: Context) -> None:
        self.context = context
        self.complete = False  # whether the clause before says by how much something changes

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
        if slots.gap:
            slots.theme = tuple(replace(p, loose="") if p.loose not in ENDS else p for p in slots.theme)
        relation = slots.relations[0].kind if slots.relations else ""
        theme = context.theme(slots.theme, relation)
        clauses = self._whole(list(self._clauses(slots, theme)))
        if not clauses:
            raise TranslationError(f"what should happen to {listed(theme.names)} is not understood")
        if slots.connector in ("so", "so that", "such that") and slots.theme and context.themes:
            guessed = all(c.amount is not None and c.amount.mode == "unsaid" for c in clauses)
            other = theme.side is None and not set(theme.names) & {*context.themes[0], "@theme", "@ground"}
            if guessed and (other or self.complete):
                clauses = [Clause("topic", theme.names)]  # what follows from the change before
        self.complete = any(c.amount is not None and not c.amount.vague for c in clauses)
        context.remember(theme.names, [c.reference for c in clauses])
        if slots.verbs:
            context.verbs = slots.verbs
        return clauses

    def _whole(self, clauses: list[Clause]) -> list[Clause]:
        """Clauses about a thing in pieces: places and poses are those of its main piece, with which the others go."""
        trailing = self.context.names.trailing
        out = []
        for clause in clauses:
            lead = self.context.led(Reference(clause.theme)).names
            if len(lead) < len(clause.theme) and clause.action in ("place", "orient", "rotate", "swap", "gap", "align"):
                out.append(replace(clause, theme=lead))
                groups = ((n, *(t for t in clause.theme if trailing.get(t) == n)) for n in lead)
                out.extend(Clause("together", group) for group in groups if len(group) > 1)
            else:
                out.append(clause)
        return out

    def _inherit(self, slots: Slots) -> None:
        """Complete an elliptical clause: "... and the right one squarely on top of that"."""
        meets = bool(slots.relations) and any(p.side for p in slots.theme)  # "... and its right end is flush with B"
        if not slots.verbs and self._says(slots) and not meets and slots.connector not in (*FOLLOWING, "while"):
            slots.verbs = list(self.context.verbs)

    def _says(self, slots: Slots) -> bool:
        """Whether a clause says anything besides what it is about."""
        return bool(slots.changes or slots.shifts or slots.relations or slots.amount or slots.marks)

    def _clauses(self, slots: Slots, theme: Reference) -> Iterator[Clause]:
        kinds = slots.kinds()
        if slots.theme and kinds <= {"make"} and not self._says(slots) and slots.follows in (":", ","):
            yield Clause("topic", theme.names)
            return
        if slots.complaint and slots.changes:
            self.context.complained = slots.changes[0].dim
        vague = all(
            a is None or a.vague
            for a in (slots.amount, *(c.amount for c in slots.changes), *(s.amount for s in slots.shifts))
        )
        if slots.follows in ("by", ":") and vague and not slots.relations and (slots.theme or slots.follows == "by"):
            self.context.complained = slots.changes[0].dim if slots.complaint and slots.changes else ""
            yield Clause("topic", theme.names)
            return
        if slots.negated:
            yield from negated(self.context, slots, theme)
        elif "keep" in kinds or ("fixed" in slots.marks and not slots.changes):
            yield from keep(self.context, slots, theme)
        elif "space" in kinds:
            yield space(self.context, theme, slots)
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
        self._lowered_in_size(slots)
        kinds = slots.kinds()
        yield from Teller(self.context).described(slots, theme)
        amount = slots.amount
        if (
            kinds <= {"make"}
            and amount is not None
            and amount.of is not None
            and not slots.changes
            and not slots.shifts
        ):
            slots.changes, slots.amount = [Change(amount.of.dim, 0, amount, same=True)], None
        elif kinds <= {"make"} and self._of_complaint(slots):
            assert amount is not None
            slots.changes, slots.amount = [Change(self.context.complained, 0, replace(amount, mode="to"))], None
        elif kinds <= {"make"} and amount is not None and _is_factor(amount) and not self._says_place(slots):
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

    def _lowered_in_size(self, slots: Slots) -> None:
        """ "(The blossom is too big.) Take it down by 20 %": a size, where one was complained of."""
        lifting = next((v for v in slots.verbs if v.info.get("direction") in ("up", "down")), None)
        shift = next((s for s in slots.shifts if s.direction in ("up", "down")), None)
        amount = slots.amount or (shift.amount if shift is not None else None)
        if not self.context.complained or (lifting is None and shift is None) or slots.relations or slots.changes:
            return
        if amount is None or amount.unit != "ratio" or amount.vague or amount.of is not None:
            return
        way = shift.direction if shift is not None else str(lifting.info["direction"]) if lifting is not None else ""
        slots.changes = [Change(self.context.complained, 1 if way == "up" else -1, amount)]
        slots.verbs, slots.shifts, slots.amount = [v for v in slots.verbs if v.value != "move"], [], None

    def _of_complaint(self, slots: Slots) -> bool:
        """ "(The pole is too tall.) Two thirds of it would do": the extent is the one complained of."""
        amount = slots.amount
        share = amount is not None and amount.unit in ("ratio", "times") and not amount.vague and amount.mode != "by"
        return share and bool(self.context.complained) and not self._says_place(slots)

    def _sort_higher(self, slots: Slots, kinds: set[str]) -> None:
        """ "Higher" and "lower" say a size with a percentage, and a place with a verb of motion."""
        for change in [c for c in slots.changes if c.ambiguous]:
            relative = (
                change.amount is not None and change.amount.unit in ("ratio", "times") and not change.amount.vague
            )
            if "move" in kinds or not relative:
                if "move" not in kinds and slots.verbs and not self._settles(slots):
                    raise TranslationError(
                        f'"{change.ambiguous}" may be a place or a height: say move ... up or make ... taller'
                    )
                slots.changes.remove(change)
                slots.shifts.append(Shift("up" if change.ambiguous == "higher" else "down", change.amount))

    def _settles(self, slots: Slots) -> bool:
        """Whether the verb says where something comes to be: "ends up 20 px higher"."""
        return any(str(v.info.get("base")) in SETTLING for v in slots.verbs)

    def _says_place(self, slots: Slots) -> bool:
        return bool(slots.changes or slots.shifts or slots.relations)
