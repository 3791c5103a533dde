"""What a clause says once all its pieces are known: particles, what is cut off, relations to nothing."""

from __future__ import annotations

from dataclasses import replace

from iconjax.errors import TranslationError
from iconjax.language.frames import Change, Relation, Shift, Slots
from iconjax.language.lexicon import lexicon
from iconjax.language.names import Phrase

LONE = ("parallel", "perpendicular", "flush", "touch", "overlap", "outside")
"""Relations that need no other thing where the clause is about two."""


def finish(slots: Slots, last: Change | Shift | None) -> None:
    """Settle in place what only the whole clause can tell.

    Raises:
        TranslationError: something is missing.
    """
    last = _particles(slots, last)
    _aligned_sides(slots)
    _companions(slots)
    _cut_off(slots)
    if "keep" in slots.kinds() and slots.kinds() & {"rotate", "scale", "swap", "orient", "align"} and not slots.negated:
        raise TranslationError("something should stay and change at once")
    for relation in [r for r in slots.relations if not r.reference and r.kind not in LONE]:
        last = _dangling(slots, relation)
    if slots.amount is not None and last is not None and last.amount is None:
        last.amount, slots.amount = slots.amount, None
    _brought_to_size(slots)
    _told_lengths(slots)
    _added_sizes(slots)
    _measured_spots(slots)


def _particles(slots: Slots, last: Change | Shift | None) -> Change | Shift | None:
    """ "Stand the ladder | up": a verb whose second word comes behind what it is about."""
    for shift in [s for s in slots.shifts if s.amount is None and s.direction in ("up", "down")]:
        for at, verb in enumerate(slots.verbs):
            got = lexicon().match([str(verb.info["base"]), shift.direction], 0, "verb")
            if got is not None and got[1] == 2 and got[0].value not in (verb.value, "move"):
                slots.verbs[at] = got[0]
                slots.shifts.remove(shift)
                return None if last is shift else last
    return last


def _aligned_sides(slots: Slots) -> None:
    """ "Left-align A with B": the direction is the side of both."""
    if slots.kinds() != {"align"} or len(slots.shifts) != 1 or slots.shifts[0].amount is not None:
        return
    side = {"left": "left", "right": "right", "up": "top", "down": "bottom"}.get(slots.shifts[0].direction)
    if side is not None:
        slots.theme, slots.shifts = _on_side(slots.theme, side), []
        for relation in slots.relations:
            relation.reference = _on_side(relation.reference, side)


def _on_side(things: tuple[Phrase, ...], side: str) -> tuple[Phrase, ...]:
    return tuple(p if p.side else Phrase("", side=side, owner=p) for p in things)


def _companions(slots: Slots) -> None:
    """ "Move the mug with the book 20 px to the left": both move."""
    others = [r for r in slots.relations if r.kind == "with" and r.reference]
    if others and slots.theme and "move" in slots.kinds() and any(s.amount for s in slots.shifts):
        slots.relations = [r for r in slots.relations if r not in others]
        slots.theme = (*slots.theme, *(p for r in others for p in r.reference))
        slots.marks["together"] = "with"


def _told_lengths(slots: Slots) -> None:
    """ "Height: 80 px", "its width should be 40 px": a length that nothing grows or shrinks by is the new one."""
    for change in slots.changes:
        amount = change.amount
        told = amount is not None and amount.unit == "px" and not amount.mode and not change.sign
        if amount is not None and told and not change.same and "scale" not in slots.kinds():
            change.amount = replace(amount, mode="to")


def _brought_to_size(slots: Slots) -> None:
    """ "Bring it down to 70 % of its height": a part of its own size is no place."""
    amount = slots.amount or next((s.amount for s in slots.shifts if s.amount is not None), None)
    if slots.kinds() != {"move"} or slots.changes or amount is None or amount.mode != "to" or amount.of is None:
        return
    if amount.of.dim != "gap" and all(p.pronoun and not p.owner for p in amount.of.owners):
        slots.changes, slots.amount, slots.shifts = [Change(amount.of.dim, 0, amount)], None, []
        slots.verbs = []


def _added_sizes(slots: Slots) -> None:
    """ "Wider by the width of the door" adds one thing's size to another's, which no reading does."""
    amounts = [c.amount for c in slots.changes] + ([slots.amount] if "scale" in slots.kinds() else [])
    for amount in amounts:
        if amount is not None and amount.mode == "by" and amount.of is not None and amount.of.owners:
            own = all(p.pronoun and not p.owner for p in amount.of.owners)
            if not own:
                raise TranslationError("to add one thing's size to another's is not understood: name an amount")


def _cut_off(slots: Slots) -> None:
    """ "Cut a third off the pole": what is cut is the theme."""
    shrinks = any(v.value == "scale" and int(v.info.get("sign", 0)) < 0 for v in slots.verbs)
    offs = [r for r in slots.relations if r.kind == "outside"]
    if shrinks and len(offs) == 1 and not slots.theme and slots.amount is not None:
        slots.relations.remove(offs[0])
        slots.theme = offs[0].reference
        slots.marks["off"] = "off"
    elif any(v.value == "scale" and str(v.info["base"]).endswith(" off") for v in slots.verbs):
        slots.marks["off"] = "off"


def _dangling(slots: Slots, relation: Relation) -> Shift:
    """ "The one above": without another thing, a relation is a direction or nothing."""
    directions = {"above": "up", "below": "down"}
    if relation.kind not in directions:
        raise TranslationError(f'"{relation.kind}" what? the request does not say')
    slots.relations.remove(relation)
    shift, slots.amount = Shift(directions[relation.kind], slots.amount), None
    slots.shifts.append(shift)
    return shift


def _measured_spots(slots: Slots) -> None:
    """A spot that the picture does not tell apart has no size to compare with."""
    amounts = [slots.amount, *(c.amount for c in slots.changes)]
    owners = [p for a in amounts if a is not None and a.of is not None for p in a.of.owners]
    for phrase in (*owners, *(p for c in slots.changes for p in c.reference)):
        if phrase.loose:
            raise TranslationError(f'"{phrase.loose}" is not one of the things in the picture')
