"""Readings of turning: angles, senses, pivots, level and upright."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from iconjax.errors import TranslationError
from iconjax.language.clauses import Amount, Clause
from iconjax.language.context import Context
from iconjax.language.frames import Relation, Slots
from iconjax.language.names import Reference
from iconjax.language.reading import FOLLOWING, TURNED, followed, listed

PULLING = frozenset(
    {"pull", "push", "nudge", "drag", "tug", "yank", "shove", "kick", "bring", "swing over", "come", "go"}
)
"""Verbs of motion that with an angle mean a turn."""


def turns(slots: Slots, kinds: set[str]) -> bool:
    amounts = [slots.amount, *(s.amount for s in slots.shifts)]
    return bool(
        kinds & {"rotate", "orient", "point"}
        or {"sense", "orient", "upside_down"} & set(slots.marks)
        or any(a is not None and a.unit == "deg" for a in amounts)
        or any(r.kind in TURNED for r in slots.relations)
    )


def sense_of(relation: Relation, slots: Slots) -> bool:
    degrees = slots.amount is not None and slots.amount.unit == "deg"
    return relation.kind in ("away", "toward") and degrees


def rotate(context: Context, slots: Slots, theme: Reference) -> Iterator[Clause]:
    """How far and which way a thing turns, until it lies how, and about what."""
    names = theme.names
    amount, direction = _amount_and_sense(slots)
    orient, direction = _orientation(slots, direction)
    for relation in [r for r in slots.relations if r.kind == "around"]:
        yield hinge(context, relation, names)
    relative = next((r for r in slots.relations if sense_of(r, slots)), None)
    aimed = next((r for r in slots.relations if r.kind in TURNED), None)
    if relative is not None:
        target = context.reference(relative.reference, names)
        yield Clause("rotate", names, amount, direction=relative.kind, reference=target.names)
    elif aimed is not None:
        yield turned(context, aimed, names)
    elif "upside_down" in slots.marks:
        yield Clause("rotate", names, Amount(180.0, "deg"), direction="cw")
    elif orient and (amount is None or amount.unit != "deg"):
        if theme.side is not None:
            raise TranslationError(f"how {listed(names)} lies when its {theme.side} is {orient} is not clear")
        manner = frozenset({"follow"}) if slots.connector in FOLLOWING else frozenset()
        yield Clause("turn" if followed(slots) else "orient", names, relation=orient, manner=manner)
        slots.verbs = [v for v in slots.verbs if v.value != "move"]
    else:
        turn = _by_angle(slots, names, amount, direction)
        if turn.action == "rotate" and amount is not None and not (slots.shifts or slots.relations):
            # "pull the lever 12 degrees to the left"
            slots.verbs = [v for v in slots.verbs if v.value != "move" or v.info.get("base") not in PULLING]
        yield replace(turn, manner=turn.manner | ({"together"} if "together" in slots.marks else set()))
    if len(names) > 1 and "together" in slots.marks:
        yield Clause("together", names)


def _amount_and_sense(slots: Slots) -> tuple[Amount | None, str]:
    """The angle, and cw, ccw, up, down or ""; "raise the arm by 20 degrees" turns it."""
    amount, direction = slots.amount, slots.marks.get("sense", "")
    shift = slots.shifts[0] if slots.shifts and (amount is None or amount.unit != "px") else None
    if shift is not None:
        turning = shift.amount is None or shift.amount.unit == "deg"
        if turning or "move" not in slots.kinds():
            amount = amount or shift.amount
            direction = direction or {"left": "ccw", "right": "cw"}.get(shift.direction, shift.direction)
            slots.shifts = slots.shifts[1:]
    lifting = next((v.info["direction"] for v in slots.verbs if v.info.get("direction")), "")
    if "apart" in slots.marks and not direction and len(slots.theme) >= 1:
        direction = "in" if slots.marks["apart"] == "closer" else "out"
        slots.marks = {k: v for k, v in slots.marks.items() if k != "apart"}
    if lifting:
        slots.verbs = [v for v in slots.verbs if v.value != "move"]
    return amount, direction or lifting


def _orientation(slots: Slots, direction: str) -> tuple[str, str]:
    """How the thing lies in the end ("level", "upright", "straight" or ""), and the sense that is left."""
    said = next((v.info["orient"] for v in slots.verbs if v.info.get("orient")), "")
    orient = slots.marks.get("orient") or said
    if orient:
        return orient, direction
    if "point" in slots.kinds():
        ways = {"up": "upright", "down": "upright", "cw": "level", "ccw": "level"}
        if direction not in ways:
            raise TranslationError("where it should point is not understood: say up, down, left or right")
        return ways[direction], ""
    return ("straight" if "orient" in slots.kinds() and not followed(slots) else ""), direction


def _by_angle(slots: Slots, names: tuple[str, ...], amount: Amount | None, direction: str) -> Clause:
    if amount is not None and not amount.vague:
        if amount.unit not in ("deg", "none"):
            raise TranslationError("an angle is needed: say by how many degrees")
        if amount.mode == "to" and direction:
            raise TranslationError(
                "an angle to turn to and a sense of turning do not go together: say by how many degrees"
            )
        return Clause("rotate", names, replace(amount, unit="deg"), direction=direction)
    if followed(slots) or "move" in slots.kinds() or slots.relations:
        return Clause("turn", names)
    if amount is None and direction not in ("cw", "ccw"):
        raise TranslationError(
            f'how far {listed(names)} should turn is not said: add an angle, e.g. "by 30 degrees clockwise"'
        )
    degrees = 30.0 if amount is None else 10.0 if amount.value < 0.3 else 45.0
    said = Amount(degrees, "deg", "" if amount is not None else "unsaid", vague=True)
    return Clause("rotate", names, said, direction=direction)


def hinge(context: Context, relation: Relation, names: tuple[str, ...]) -> Clause:
    target = context.reference(relation.reference, names)
    pivot = names if target.names == ("@theme",) or set(target.names) == set(names) else target.names
    if pivot == ("@ground",) or pivot == ("canvas",):
        raise TranslationError("a pivot has to be a part of the picture")
    return Clause("hinge", names, reference=pivot, side=target.side)


def turned(context: Context, relation: Relation, names: tuple[str, ...]) -> Clause:
    if not relation.reference:
        if len(names) != 2:
            raise TranslationError(f'"{relation.kind}" to what? the request does not say')
        return Clause("orient", names[:1], relation=relation.kind, reference=names[1:])
    return Clause(
        "orient",
        names,
        relation=relation.kind,
        reference=context.reference(relation.reference, names).names,
    )
