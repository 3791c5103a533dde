"""Readings of what should stay as it is."""

from __future__ import annotations

from collections.abc import Iterator

from iconjax.errors import TranslationError
from iconjax.language.clauses import Amount, Clause
from iconjax.language.context import Context
from iconjax.language.frames import Slots
from iconjax.language.names import Reference


def negated(context: Context, slots: Slots, theme: Reference) -> Iterator[Clause]:
    kinds = slots.kinds()
    if "part" in kinds and len(slots.relations) == 1 and slots.relations[0].kind in ("around", "outside"):
        # "without detaching it from the mast"
        target = context.reference(slots.relations[0].reference, theme.names)
        yield Clause("keep", theme.names, relation="touch", reference=target.names)
    elif slots.relations:
        yield from _not_related(context, slots, theme)
    elif slots.changes:
        for change in slots.changes:
            yield Clause("keep", theme.names, dimension=change.dim)
    elif "distort" in kinds:
        yield Clause("keep", theme.names, dimension="proportions")
    elif "uproot" in kinds:
        yield Clause("keep", theme.names, dimension="bottom")
    elif "rotate" in kinds:
        yield Clause("keep", theme.names, dimension="rotation")
    elif "scale" in kinds and slots.theme and slots.verbs[0].info.get("base") in ("scale", "resize", "stretch", "size"):
        yield Clause("keep", theme.names, dimension="size")
    elif slots.theme and kinds & {"move", "scale"}:
        yield still(context, theme)
    elif "move" in kinds:
        yield Clause("keep", theme.names, dimension="place")
    else:
        raise TranslationError("what should not happen is not understood")


def _not_related(context: Context, slots: Slots, theme: Reference) -> Iterator[Clause]:
    for relation in slots.relations:
        target = context.reference(relation.reference, theme.names)
        if relation.kind == "outside" and target.names == ("@ground",):
            yield Clause("keep", theme.names, dimension="bottom")  # "without lifting it off the ground"
            continue
        if relation.kind == "outside":
            yield Clause(
                "keep", theme.names, relation="touch", reference=target.names
            )  # "without taking it out of ..."
            continue
        if relation.kind not in ("touch", "overlap"):
            raise TranslationError(f'"not {relation.kind}" is not understood')
        shapes = context.names.shapes
        if all(any(shapes.part_of(t, n) for n in theme.names) for t in target.names):
            yield Clause("keep", target.names, dimension="size")
        else:
            yield Clause("place", theme.names, relation="outside", reference=target.names)


def still(context: Context, theme: Reference) -> Clause:
    if theme.side is not None and theme.names == ("canvas",) and context.themes:
        return Clause("keep", context.themes[0], dimension=theme.side)  # "make it half as wide, left edge stays put"
    if theme.side is not None:
        return Clause("keep", owner(context, theme), dimension=theme.side)
    return Clause("stay", theme.names)


def owner(context: Context, theme: Reference) -> tuple[str, ...]:
    return context.themes[0] if theme.names == ("@theme",) and context.themes else theme.names


def keep(context: Context, slots: Slots, theme: Reference) -> Iterator[Clause]:
    names = owner(context, theme)
    if slots.gap and len(names) == 2 and slots.amount is None:
        yield Clause("gap", names, Amount(1.0, "factor"))
        return
    if slots.shifts or (slots.amount is not None):
        raise TranslationError("something should stay and change at once")
    for relation in slots.relations:
        target = context.reference(relation.reference, names)
        if target.names == ("@ground",):
            yield Clause("keep", names, dimension=theme.side or "bottom")
        else:
            yield Clause("keep", names, relation=relation.kind, reference=target.names, side=target.side)
    for change in slots.changes:
        yield Clause("keep", names, dimension=change.dim)
    if slots.marks.get("fixed", "").endswith(("level", "height")):
        yield Clause("keep", names, dimension="level")
        return
    if "orient" in slots.marks:
        yield Clause("keep", names, dimension="rotation")
    if "centered" in slots.text or "centred" in slots.text:
        return
    if not (slots.relations or slots.changes or "orient" in slots.marks):
        if "together" in slots.marks:
            yield Clause("together", names)
        elif not slots.theme and "fixed" in slots.marks:
            yield Clause("keep", names, dimension="place")
        else:
            yield still(context, theme)
