"""Readings about two or more things at once: swapping, gaps, alignment."""

from __future__ import annotations

from collections.abc import Iterator

from iconjax.errors import TranslationError
from iconjax.language.clauses import Amount, Clause
from iconjax.language.context import Context
from iconjax.language.frames import Change, Slots
from iconjax.language.names import Reference
from iconjax.language.read_sizes import factor
from iconjax.language.reading import FOLLOWING, followed, listed


def swap(context: Context, theme: Reference, slots: Slots) -> Clause:
    names = theme.names
    if len(names) == 1:
        names = context.names.members_if_collection(names[0])
    if len(names) != 2:
        raise TranslationError(f"two things are needed to swap; the request names {listed(names)}")
    return Clause("swap", names)


def gap(context: Context, slots: Slots, theme: Reference) -> Clause:
    names = theme.names
    mover = False
    if len(names) == 1:
        names = context.names.members_if_collection(names[0])
    if len(names) == 1 and slots.connector in FOLLOWING and all(p.pronoun == "them" for p in slots.theme):
        # "move A towards B until the gap between them is 40 px"
        others = [m for m in context.mentions if len(m) == 1 and not set(m) & set(names)]
        names, mover = (names[0], others[0][0]) if others else names, bool(others)
    if len(names) != 2:
        raise TranslationError(f"a distance needs two things; the request names {listed(names)}")
    info = next((v.info for v in slots.verbs if v.value == "scale"), {})
    sign = {"apart": 1, "closer": -1}.get(slots.marks.get("apart", ""), int(info.get("sign", 0)))
    sign = slots.changes[0].sign or sign if slots.changes else sign
    amount = slots.amount or (slots.changes[0].amount if slots.changes else None)
    if "factor" in info:
        amount = Amount(float(info["factor"]), "times", "to")
    if amount is None and followed(slots):
        return Clause("go", names)  # "towards each other until they meet"
    if amount is None:
        raise TranslationError("how large the distance should become is not said")
    reference: tuple[str, ...] = ()
    dim = ""
    if amount.of is not None and amount.of.owners and amount.of.dim != "gap":
        reference, dim = context.reference(amount.of.owners, names).names, amount.of.dim
        final = amount
    elif amount.unit == "px" and slots.marks.get("apart") == "apart" and _told(slots):
        final = Amount(amount.value, "length")  # "they should be 70 px apart"
    elif amount.unit == "px":
        final = (
            Amount(amount.value, "length") if not sign or amount.mode == "to" else Amount(sign * amount.value, "added")
        )
    else:
        final = factor(amount, sign, Change("gap"), False)
    moved = "rotate" if "rotate" in {*slots.kinds(), *(v.value for v in context.verbs)} else "translate"
    manner = frozenset(
        {moved, *({"first"} if theme.side and final.unit == "length" else ()), *({"mover"} if mover else ())}
    )
    return Clause("gap", names, final, dim, reference=reference, side=theme.side, manner=manner)


def _told(slots: Slots) -> bool:
    """Whether a clause tells how far apart things are to be, and not how much further."""
    more = {"further", "farther", "more", "wider", "another", "extra"} & set(slots.text.split())
    return slots.kinds() <= {"make"} and not more


def space(context: Context, theme: Reference, slots: Slots) -> Clause:
    """ "Space the windows evenly (40 px from one to the next)"."""
    names = theme.names
    if len(names) == 1:
        names = context.names.members_if_collection(names[0])
    if len(names) < 3:
        raise TranslationError(f"three things or more can be spaced evenly; the request names {listed(names)}")
    amount = slots.amount or next((s.amount for s in slots.shifts if s.amount is not None), None)
    if amount is not None and amount.unit not in ("px", "none"):
        raise TranslationError("the distance from one to the next has to be in px")
    axis = "vertical" if any(c.dim == "vert" for c in slots.changes) else ""
    axis = "horizontal" if any(c.dim == "hori" for c in slots.changes) else axis
    return Clause("space", names, amount, side=axis or None)


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
    if (
        {"with", "to"} & set(slots.text.split())
        and side in ("left", "right", "top", "bottom")
        and len(theme.names) == 2
    ):
        # "align A with B": B stays
        first, other = theme.names[:1], theme.names[1:]
        return Clause("place", first, relation="flush", reference=other, side=side, theme_side=side)
    return Clause("align", theme.names, side=side)
