"""Requests about several things at once, as constraints."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

from iconjax.errors import TranslationError
from iconjax.language.clauses import Amount, Clause
from iconjax.language.collector import EDGES, Collector, call, keeps, quoted, region, sized

SAME_LEVEL = 0.01
"""Things whose tops or bottoms differ less, as a share of the picture's larger side, keep to their level."""


def swap(out: Collector, clause: Clause) -> None:
    """Two things change places."""
    out.moves("translate", clause)
    a, b = clause.theme
    (_, top_a, _, low_a), (_, top_b, _, low_b) = (out.shapes.box(n) for n in (a, b))
    near = SAME_LEVEL * out.shapes.scene.size
    level = abs(low_a - low_b) < near or abs(top_a - top_b) < near
    for one, two in ((a, b), (b, a)):
        out.equal(call("center_x", quoted(one)), call("center_x", call("old", quoted(two))))
        if not level:
            out.equal(call("center_y", quoted(one)), call("center_y", call("old", quoted(two))))


def gap(out: Collector, clause: Clause) -> None:
    """The gap between two things changes."""
    if "first" in clause.manner and clause.side in EDGES and "rotate" not in clause.manner:
        return _sides_apart(out, clause)
    for kind in clause.manner - {"first", "mover"}:
        out.moves(kind, replace(clause, theme=clause.theme[:1]) if "mover" in clause.manner else clause)
    if "mover" in clause.manner:
        out.anchor(clause.theme[1], clause.theme[0])
    a, b = (region(clause.side, quoted(n)) for n in clause.theme)
    amount = clause.amount or Amount(1.0, "factor")
    now = call("min_dist", a, b)
    if clause.reference:
        theirs = call(out.shapes.extent(clause.reference[0], clause.dimension), quoted(clause.reference[0]))
        out.equal(now, sized(Amount(amount.value, "factor"), theirs))
        return None
    old = call("min_dist", *(region(clause.side, call("old", quoted(n))) for n in clause.theme))
    out.equal(now, amount.value if amount.unit == "length" else sized(amount, old))
    return None


def _sides_apart(out: Collector, clause: Clause) -> None:
    """The distance from a side of one thing to that of another: the first thing moves."""
    first, other = clause.theme
    edge = EDGES[clause.side or ""][0]
    index = {"min_x": 0, "min_y": 1, "max_x": 2, "max_y": 3}.get(edge)
    if index is None or clause.amount is None:
        raise TranslationError(f"the distance between the {clause.side} of two things is not understood")
    out.moves("translate", replace(clause, theme=(first,)))
    ahead = out.shapes.box(first)[index] >= out.shapes.box(other)[index]
    apart = clause.amount.value if ahead else -clause.amount.value
    out.equal(call("minus", call(edge, quoted(first)), call(edge, quoted(other))), apart)
    out.anchor(other, first)
    out.axis_keeps[(first, 1 if edge.endswith("x") else 0)] = None


def align(out: Collector, clause: Clause) -> None:
    """Sides or middles are brought in line."""
    out.moves("translate", clause)
    first, *others = clause.theme
    for other in others:
        for edge in EDGES[clause.side or ""]:
            out.equal(call(edge, quoted(first)), call(edge, quoted(other)))


def together(out: Collector, clause: Clause) -> None:
    """Things move as one."""
    out.add(call("together", *map(quoted, clause.theme)))


def space(out: Collector, clause: Clause) -> None:
    """Things in a row get equal gaps between the first and the last, or a given distance from middle to middle."""
    centres = {n: out.shapes.centre(n) for n in clause.theme}
    spread = [max(c[a] for c in centres.values()) - min(c[a] for c in centres.values()) for a in (0, 1)]
    axis = {"horizontal": 0, "vertical": 1}.get(clause.side or "", 0 if spread[0] >= spread[1] else 1)
    row, letter = sorted(clause.theme, key=lambda n: centres[n][axis]), "xy"[axis]
    moving = row if clause.amount else row[1:-1]
    out.moves("translate", replace(clause, theme=tuple(moving)))
    if clause.amount:
        for one, two in pairwise(row):
            apart = call("minus", call(f"center_{letter}", quoted(two)), call(f"center_{letter}", quoted(one)))
            out.equal(apart, clause.amount.value)
        middle = row[len(row) // 2]
        out.add(*([keeps(f"center_{letter}", middle)] if len(row) % 2 else []))
    else:
        gaps = [
            call("minus", call(f"min_{letter}", quoted(two)), call(f"max_{letter}", quoted(one)))
            for one, two in pairwise(row)
        ]
        for one, two in pairwise(gaps):
            out.equal(one, two)
        out.fixed.update(dict.fromkeys((row[0], row[-1])))
    for name in moving:
        out.axis_keeps[(name, 1 - axis)] = None
