"""What a clause leaves to its neighbours to say: directions, extents and amounts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from copy import copy
from dataclasses import replace
from itertools import pairwise

from iconjax.errors import TranslationError
from iconjax.language.clauses import Amount
from iconjax.language.frames import Change, Shift, Slots
from iconjax.language.lexicon import Entry
from iconjax.language.measures import AS_SAID, known_verb

SOFT = (",", "and", "&", "as well as")
"""Connectors of clauses that run in parallel."""
HARD = (".", ";", "!", "?")
"""Connectors between sentences."""
LEAST_PERCENT = 5.0
"""Bare numbers below are factors, beside a percentage too."""
CONVERSE = {
    **{kind: kind for kind in ("touch", "outside", "overlap", "beside", "parallel", "perpendicular")},
    "above": "below",
    "below": "above",
    "left_of": "right_of",
    "right_of": "left_of",
}
"""Relation of A to B -> that of B to A."""


def complete(clauses: list[Slots]) -> list[Slots]:
    """Clauses with what they leave to their neighbours filled in.

    Raises:
        TranslationError: "that much", and no amount was said.
    """
    for before, slots in list(pairwise(clauses)):
        if _headline(before, slots):
            before.verbs, before.changes, before.shifts, before.relations = [], [], [], []
            before.follows = ":"
            clauses[:] = [c for c in clauses if c is not before or c.theme]
        if before.marks.get("apart") and not _amounts(before) and slots.gap and _amounts(slots) and not _turns(before):
            before.verbs, before.marks, before.follows = [], {}, ":"  # "closer together, so that the gap is 20 px"
        if _only_amount(before, slots):
            clauses[:] = [c for c in clauses if c is not slots]
        elif slots.connector in SOFT and _leads_up(before, slots):
            slots.theme, slots.connector = before.theme, before.connector
            slots.verbs = slots.verbs or before.verbs
            clauses[:] = [c for c in clauses if c is not before]
        elif slots.connector in SOFT:
            _repeat(before, slots)
            _gap(before, slots)
            _same_unit(before, slots)
        elif slots.connector in ("until", "till"):
            _about_the_mover(slots)
        _moves(before, slots)
    _own_verbs(clauses)
    for before, slots in reversed(list(pairwise(clauses))):
        if slots.connector in SOFT:
            _share(before, slots)
    _as_said(clauses)
    return clauses


def _as_said(clauses: Sequence[Slots]) -> None:
    """ "That much longer": by the amount said before."""
    said: Amount | None = None
    for slots in clauses:
        for holder in _holders(slots):
            amount = holder.amount
            if amount is not None and amount.unit == AS_SAID:
                if said is None:
                    raise TranslationError("how much is meant is not said")
                holder.amount = said
            elif amount is not None:
                said = amount


def _own_verbs(clauses: Sequence[Slots]) -> None:
    """A new sentence about sizes or places needs no verb of the one before, nor what comes after what stays."""
    done: list[Entry] = []
    for before, slots in pairwise(clauses):
        stays = before.negated or "keep" in before.kinds()
        done = before.verbs if before.verbs and not stays else done
        says = slots.changes or slots.shifts
        sized = any(c.amount is not None and c.amount.unit in ("ratio", "times") for c in slots.changes)
        apart = stays or sized or slots.connector in (*HARD, ":")
        if not slots.verbs and slots.connector != "while" and says and apart:
            inherits = slots.connector in SOFT and done and not sized
            slots.verbs = list(done) if inherits else [known_verb("make")]


def _moves(before: Slots, slots: Slots) -> None:
    """ "Rotate it 20 degrees, then 10 px up": a distance is none of the verb before."""
    measured = [s for s in slots.shifts if s.amount is not None and s.amount.unit == "px"]
    if not slots.verbs and measured and "rotate" in before.kinds():
        slots.verbs = [known_verb("move")]


def _headline(before: Slots, slots: Slots) -> bool:
    """ "Bigger wheels! About twice as big", "make the crown wider: each leaf by 20 %", "the cable slopes. Level it"."""
    related = any(r.reference for r in before.relations)
    if slots.connector == "," and _measures(before, slots):
        return True
    if _amounts(before) or related or before.marks or before.negated or before.complaint or before.kinds() & {"keep"}:
        return False
    if slots.connector == ":":
        return not before.changes or not any(c.same or c.reference for c in before.changes)
    if slots.connector not in HARD or before.shifts or (not before.declares and before.verbs):
        return False
    if slots.theme and not (slots.theme[0].pronoun and not slots.theme[0].owner):
        return False
    if before.verbs:
        return not before.changes and not before.kinds() & {"make"}
    dims = {c.dim for c in slots.changes}
    return all(c.dim in dims and not c.same for c in before.changes)


def _turns(slots: Slots) -> bool:
    return "rotate" in slots.kinds()


def _measures(before: Slots, slots: Slots) -> bool:
    """ "Thicker trunk, 160 px wide": the second says how large it should come out."""
    bare = not _amounts(before) and before.kinds() <= {"make"} and not before.shifts and not before.relations
    if not bare or slots.theme or slots.verbs or not before.theme or before.negated or before.marks:
        return False
    told = [c for c in slots.changes if c.amount is not None and c.amount.unit == "px" and c.same and not c.amount.of]
    graded = [c for c in before.changes if c.sign and not c.same]
    alike = len(told) == len(graded) == 1 and (graded[0].dim in ("size", "thick", told[0].dim) or told[0].dim == "size")
    return alike and len(slots.changes) == len(before.changes) == 1


def _only_amount(before: Slots, slots: Slots) -> bool:
    """ "Bigger wheels! 15 % on each": an amount alone measures the change before."""
    says = slots.verbs or slots.changes or slots.shifts or slots.relations or slots.marks or slots.negated
    every = all(p.pronoun == "them" for p in slots.theme)
    amount = slots.amount
    if says or not every or amount is None or amount.unit not in ("ratio", "times") or slots.connector not in HARD:
        return False
    if _amounts(before) or len(before.changes) != 1 or not before.changes[0].sign or before.changes[0].reference:
        return False
    before.changes[0].amount = amount
    return True


def _leads_up(before: Slots, slots: Slots) -> bool:
    """ "Take the mug and move it 20 px up", "move the mug, up by 20 px": the first only says what it is about."""
    bare = {v.value for v in before.verbs} == {"move"} and not any(v.info.get("direction") for v in before.verbs)
    says = before.changes or before.shifts or before.relations or before.marks or before.amount or before.negated
    if not bare or not before.theme or says:
        return False
    pronoun = len(slots.theme) == 1 and slots.theme[0].pronoun and not slots.theme[0].owner
    return bool(pronoun and slots.verbs) or not (slots.theme or slots.verbs or slots.marks)


def _about_the_mover(slots: Slots) -> None:
    """ "(Move A left) until B no longer touches it": the aim is A's all the same."""
    if len(slots.relations) != 1 or not slots.theme or slots.theme[0].pronoun or slots.theme[0].owner is not None:
        return
    relation = slots.relations[0]
    mover = len(relation.reference) == 1 and relation.reference[0].pronoun == "it" and not relation.reference[0].owner
    if mover and relation.kind in CONVERSE:
        relation.kind, relation.reference, slots.theme = CONVERSE[relation.kind], slots.theme, ()


def _holders(slots: Slots) -> Iterator[Slots | Change | Shift]:
    return iter((slots, *slots.changes, *slots.shifts))


def _amounts(slots: Slots) -> list[Amount]:
    return [h.amount for h in _holders(slots) if h.amount is not None]


def _gap(before: Slots, slots: Slots) -> None:
    """ "Move A up by 10 px and B by 20 px": the second says only what and how much."""
    says = slots.verbs or slots.changes or slots.shifts or slots.relations or slots.marks or slots.negated
    if says or not slots.theme or slots.amount is None or before.complaint:
        return
    if before.shifts:
        slots.shifts = [Shift(s.direction, slots.amount, s.place) for s in before.shifts]
        slots.amount = None
    elif before.changes and not before.kinds() & {"keep"}:
        slots.changes = [Change(c.dim, c.sign, slots.amount, c.same, ambiguous=c.ambiguous) for c in before.changes]
        slots.amount = None
    if "sense" in before.marks:
        slots.marks["sense"] = before.marks["sense"]


def _repeat(before: Slots, slots: Slots) -> None:
    """ "... and the lamp (too)": all that was said before."""
    says = slots.verbs or slots.changes or slots.shifts or slots.relations or slots.marks or slots.negated
    last = slots.connector == "and" and not slots.follows  # "... and the lamp"
    if (slots.complaint or last) and slots.theme and not says and slots.amount is None:
        for field in ("verbs", "changes", "shifts", "relations"):
            setattr(slots, field, [copy(one) for one in getattr(before, field)])
        slots.amount, slots.marks, slots.complaint = before.amount, dict(before.marks), False


def _same_unit(before: Slots, slots: Slots) -> None:
    """ "Up by 10 and down by 20 px", "10 wider and 20 % taller": a bare number has the unit of its neighbour."""
    pairs: Sequence[tuple[Slots, Slots]] = ((before, slots), (slots, before))
    for bare, other in pairs:
        for one, two in ((bare.changes, other.changes), (bare.shifts, other.shifts), ([bare], [other])):
            units = {h.amount.unit for h in two if h.amount is not None} - {"none"}
            unit = next(iter(units)) if len(units) == 1 else ""
            for holder in one:
                amount = holder.amount
                if amount is None or amount.unit != "none" or unit not in ("px", "deg", "ratio"):
                    continue
                if unit != "ratio":
                    holder.amount = replace(amount, unit=unit)
                elif amount.value >= LEAST_PERCENT:
                    holder.amount = replace(amount, unit=unit, value=amount.value / 100)


def _share(before: Slots, slots: Slots) -> None:
    """ "Raise A and lower B by 10 px": an amount at the end may hold for both."""
    amounts = _amounts(slots)
    if _amounts(before) or not slots.trailing or len(set(amounts)) != 1 or amounts[0].of is not None:
        return
    open_shift = [s for s in before.shifts if not s.place]
    open_change = [c for c in before.changes if c.sign and not c.same and not c.reference]
    lifts = any(v.info.get("direction") for v in before.verbs)
    grows = any(v.value == "scale" and v.info.get("sign") and "factor" not in v.info for v in before.verbs)
    alike = (bool(slots.changes) or "scale" in slots.kinds()) == (bool(before.changes) or grows)
    if before.relations or before.negated or not alike:
        return
    if open_shift or open_change:
        for shift in open_shift:
            shift.amount = amounts[0]
        for change in open_change:
            change.amount = amounts[0]
    elif lifts or grows or "rotate" in before.kinds():
        before.amount = amounts[0]
    before.trailing = True
