"""Readings about two or more things at once: swapping, gaps, alignment."""

from __future__ import annotations

from collections.abc import Iterator

from iconjax.errors import TranslationError
from iconjax.language.clauses import Amount, Clause
from iconjax.language.context import Context
from iconjax.language.frames import Change, Slots
from iconjax.language.names import Reference
from iconjax.language.read_sizes import factor
from iconjax.language.reading import listed


def swap(context: Context, theme: Reference, slots: Slots) -> Clause:
    names = theme.names
    if len(names) == 1:
        names = context.names.members_if_collection(names[0])
    if len(names) != 2:
        raise TranslationError(f"two things are needed to swap; the request names {listed(names)}")
    return Clause("swap", names)


def gap(context: Context, slots: Slots, theme: Reference) -> Clause:
    names = theme.names
    if len(names) == 1:
        names = context.names.members_if_collection(names[0])
    if len(names) != 2:
        raise TranslationError(f"a distance needs two things; the request names {listed(names)}")
    info = next((v.info for v in slots.verbs if v.value == "scale"), {})
    sign = {"apart": 1, "closer": -1}.get(slots.marks.get("apart", ""), int(info.get("sign", 0)))
    sign = slots.changes[0].sign or sign if slots.changes else sign
    amount = slots.amount or (slots.changes[0].amount if slots.changes else None)
    if "factor" in info:
        amount = Amount(float(info["factor"]), "times", "to")
    if amount is None:
        raise TranslationError("how large the distance should become is not said")
    reference: tuple[str, ...] = ()
    dim = ""
    if amount.of is not None and amount.of.owners and amount.of.dim != "gap":
        reference, dim = context.reference(amount.of.owners, names).names, amount.of.dim
        final = amount
    elif amount.unit == "px":
        final = (
            Amount(amount.value, "length") if not sign or amount.mode == "to" else Amount(sign * amount.value, "added")
        )
    else:
        final = factor(amount, sign, Change("gap"), False)
    moved = "rotate" if "rotate" in {*slots.kinds(), *(v.value for v in context.verbs)} else "translate"
    return Clause("gap", names, final, dim, reference=reference, side=theme.side, manner=frozenset({moved}))


def follow(context: Context, slots: Slots, theme: Reference) -> Iterator[Clause]:
    """ "The shade comes down with it": what touched it touches it afterwards."""
    others = [r for r in slots.relations if r.kind == "with"]
    if slots.changes or slots.amount or len(others) != len(slots.relations) or slots.kinds() & {"rotate", "scale"}:
        raise TranslationError(f"how {listed(theme.names)} should go with it is not understood")
    target = context.reference(others[0].reference, theme.names).names if others else ()
    target = target or next((m for m in context.themes if not set(m) & set(theme.names)), ())
    shapes = context.names.shapes
    pairs = [(n, t) for n in theme.names for t in target if shapes.lies(n, "touch", t)]
    if {n for n, _ in pairs} != set(theme.names) or set(target) & set(theme.names):
        raise TranslationError(f"what {listed(theme.names)} should go with is not clear")
    yield Clause("go", theme.names)
    for name, other in pairs:
        yield Clause("keep", (name,), relation="touch", reference=(other,))


def align(context: Context, slots: Slots, theme: Reference) -> Clause:
    if len(theme.names) < 2:
        names = context.names.members_if_collection(theme.names[0])
        theme = Reference(names, theme.side)
    dims = {c.dim for c in slots.changes}
    if len(theme.names) < 2 or (theme.side is None and len(dims) != 1):
        raise TranslationError('align what with what, and on which side? say e.g. "align the tops of A and B"')
    side = theme.side or {"vert": "vertical", "hori": "horizontal"}.get(dims.pop(), "")
    return Clause("align", theme.names, side=side)
