"""Readings of moving: distances, directions, places."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from iconjax.errors import TranslationError
from iconjax.language.clauses import Amount, Clause
from iconjax.language.context import Context
from iconjax.language.frames import Relation, Shift, Slots
from iconjax.language.names import Reference
from iconjax.language.reading import FOLLOWING, followed, is_own, listed

PLUMB = re.compile(r"\b(?:right|directly|straight|exactly|plumb) (?:above|below|over|under|underneath|beneath)\b")
"""What asks for the middles to be one above the other."""
MEASURED = ("away", "toward", "above", "below", "left_of", "right_of")
"""Relations that may carry a distance."""


def move(context: Context, slots: Slots, theme: Reference, relations: list[Relation]) -> Iterator[Clause]:
    """Distances first, then places; the motion alone where the next clause says where to."""
    names = theme.names
    sides = [s for s in slots.shifts if s.place and s.amount is None]
    slots.shifts = [s for s in slots.shifts if s not in sides]
    shifts = _shifts(slots, names, relations)
    direction = _way(context, slots, names, shifts, relations)
    yield from _distances(context, slots, names, shifts, relations)
    context.direction = direction if followed(slots) else ""
    targets = [r for r in relations if r.kind != "along"]
    kinds = ("toward", "away", *(("to",) if slots.follows in ("until", "till") else ()))
    nearing = [r for r in targets if r.kind in kinds and slots.amount is None and r.reference]
    if nearing and followed(slots):
        # "bring it closer to the cup until ...": how far, the next clause says
        for relation in nearing:
            reached = context.reference(relation.reference, names).names
            context.mentions.insert(0, reached)
            targets.remove(relation)
    for relation in targets:
        clause = related(context, relation, theme, direction, slots)
        if sides and clause.relation in ("beside", "touch"):
            clause = replace(clause, relation="beside", manner=clause.manner | {f"at {sides[0].direction}"})
            clause = replace(clause, manner=clause.manner | ({"touching"} if relation.kind != "beside" else set()))
        yield clause
    centering = "center" in slots.kinds()
    if centering or "squarely" in slots.marks:
        yield from centred(context, targets, theme, slots)
    if followed(slots) and not targets and not centering and not any(s.amount for s in shifts):
        yield Clause("go", names)
        if len(names) > 1 and "together" in slots.marks:
            yield Clause("together", names)
    elif not (
        shifts or targets or centering or "squarely" in slots.marks or ("rotate" in slots.kinds() and slots.connector)
    ):
        raise TranslationError(
            f"where {listed(names)} should go is not said: add a direction and a distance, or a place"
        )


def _shifts(slots: Slots, names: tuple[str, ...], relations: list[Relation]) -> list[Shift]:
    """The directions of a clause, with that of its verb ("raise")."""
    lifting = next((v.info["direction"] for v in slots.verbs if v.info.get("direction")), "")
    shifts = slots.shifts
    if lifting and not any(s.direction in ("up", "down") for s in shifts):
        shifts = [Shift(lifting, slots.amount), *shifts]
        slots.amount = None
    if slots.amount is not None and not any(r.kind in MEASURED for r in relations):
        raise TranslationError(f"which way {listed(names)} should move is not said: add left, right, up or down")
    return shifts


def _way(context: Context, slots: Slots, names: tuple[str, ...], shifts: list[Shift], relations: list[Relation]) -> str:
    """The direction that a move to a place keeps to, or "": of the clause, a rail, or the clause before."""
    direction = shifts[0].direction if len(shifts) == 1 else ""
    for relation in relations:
        if relation.kind == "along" and relation.reference:
            rail = along(context, context.reference(relation.reference, names))
            direction = rail if rail.startswith("along ") or not direction else direction
    return direction or (context.direction if slots.connector in FOLLOWING else "")


def _distances(
    context: Context, slots: Slots, names: tuple[str, ...], shifts: list[Shift], relations: list[Relation]
) -> Iterator[Clause]:
    together = frozenset({"together"}) if len(names) > 1 and "together" in slots.marks else frozenset()
    measured = [s for s in shifts if s.amount is not None]
    if relations or followed(slots):
        yield from (moved(context, names, s, s.amount, together) for s in measured)
    elif not measured:
        some = Amount(0.3, "ratio", "unsaid", vague=True)
        yield from (Clause("move", names, some, direction=s.direction, manner=together) for s in shifts)
    else:
        yield from (moved(context, names, s, s.amount or shifts[-1].amount, together) for s in shifts)


def moved(
    context: Context, names: tuple[str, ...], shift: Shift, amount: Amount | None, manner: frozenset[str]
) -> Clause:
    whose: tuple[str, ...] = ()
    if amount is not None and amount.mode == "to":
        vertical = shift.direction in ("up", "down")
        if amount.of is None or amount.of.dim != "vert" or not vertical or is_own(amount.of) or amount.value != 1.0:
            raise TranslationError("move by how much? the request says to where, as a length")
        level = context.reference(amount.of.owners, names).names
        return Clause("place", names, relation="same_place", reference=level)
    if amount is not None and amount.of is not None and amount.of.owners and not is_own(amount.of):
        whose = context.reference(amount.of.owners, names).names
    return Clause("move", names, amount, direction=shift.direction, reference=whose, manner=manner)


def along(context: Context, target: Reference) -> str:
    if len(target.names) != 1 or target.names[0] in ("canvas", "@ground"):
        return "right"
    name, shapes = target.names[0], context.names.shapes
    if shapes.oblique(name, 2.0):
        return "along " + name
    wide, high = shapes.size(name)
    return "right" if wide >= high else "up"


def centred(context: Context, targets: list[Relation], theme: Reference, slots: Slots) -> Iterator[Clause]:
    if not targets:
        if slots.theme and len(theme.names) == 2 and "center" in slots.kinds():
            yield Clause("place", theme.names[:1], relation="centered", reference=theme.names[1:])
            return
        others = [m for m in context.mentions if not set(m) & set(theme.names)]
        last = others[0] if others and not slots.theme else ("canvas",)
        yield Clause("place", theme.names, relation="centered_h" if slots.connector else "centered", reference=last)
    for relation in targets:
        if relation.kind in ("on", "above", "below", "centered_h"):
            target = context.reference(relation.reference, theme.names)
            yield Clause("place", theme.names, relation="centered_h", reference=target.names)


def related(context: Context, relation: Relation, theme: Reference, direction: str, slots: Slots) -> Clause:
    names = theme.names
    if relation.kind == "depth":
        raise TranslationError("what lies in front or behind cannot be changed")
    if not relation.reference:
        if (
            len(names) > 2
            and relation.kind == "touch"
            and slots.connector in FOLLOWING
            and set(names) <= context.spoken
        ):
            return Clause("topic", names)  # what touches what was said before
        if len(names) == 2:
            return Clause("place", names[:1], relation=relation.kind, reference=names[1:], theme_side=theme.side)
        target = _the_other(context, relation, names, slots)
    else:
        target = context.reference(relation.reference, names)
    manner = frozenset({"follow"}) if slots.connector in FOLLOWING else frozenset()
    kind = "touch" if relation.kind == "to" else relation.kind
    manner = manner | {"to"} if relation.kind == "to" else manner
    if relation.kind == "to" and target.names == ("canvas",):
        kind = "flush"
    if kind in ("above", "below") and PLUMB.search(slots.text):
        manner = manner | {"plumb"}
    kind, target = _sided(kind, relation, target, theme, direction)
    if relation.kind == "around":
        raise TranslationError('"around" does not say a place')
    return Clause(
        "place",
        names,
        slots.amount,
        direction=direction,
        relation=kind,
        reference=target.names,
        side=target.side,
        theme_side=theme.side,
        manner=manner,
    )


def _sided(kind: str, relation: Relation, target: Reference, theme: Reference, direction: str) -> tuple[str, Reference]:
    """What a relation to a side, or to no side where one is due, comes to."""
    whose = relation.reference[0].owner if relation.reference else None
    own = whose is not None and whose.pronoun and relation.reference[0].text.endswith("side")
    if kind in ("on", "touch") and target.side in ("left", "right") and own:
        return f"{target.side}_of", Reference(target.names)  # "next to the oven, on its left side"
    if kind == "on" and target.side in ("left", "right") and "side" in relation.reference[0].text.split():
        raise TranslationError(
            f"beside {listed(target.names)}, or on one half of it? say left of it or at its left end"
        )
    sideless = not target.side and not theme.side and target.names != ("canvas",)
    if kind == "flush" and direction in ("up", "down") and sideless:
        return "same_place", target  # "raise it until it is level with the other"
    return kind, target


def _the_other(context: Context, relation: Relation, names: tuple[str, ...], slots: Slots) -> Reference:
    """ "(Move A next to B) so that they touch"."""
    both = bool(slots.theme) and all(p.pronoun == "them" for p in slots.theme)
    others = [m for m in context.mentions if len(m) == 1 and not set(m) & set(names)]
    if both and len(names) == 1 and others and relation.kind in ("touch", "overlap"):
        return Reference(others[0])
    raise TranslationError(f'"{relation.kind}" what? the request does not say')


def join(context: Context, slots: Slots, theme: Reference, kind: str) -> Iterator[Clause]:
    if slots.relations or len(theme.names) < 2:
        if not slots.relations:
            raise TranslationError("to what? the request does not say")
        for relation in slots.relations:
            yield related(context, relation, theme, "", slots)
        return
    yield Clause("place", theme.names[:1], relation=kind, reference=theme.names[1:])
