"""Requests about several things at once, as constraints."""

from __future__ import annotations

from iconjax.language.clauses import Amount, Clause
from iconjax.language.collector import EDGES, Collector, call, quoted, region, sized


def swap(out: Collector, clause: Clause) -> None:
    """Two things change places."""
    out.moves("translate", clause)
    a, b = clause.theme
    level = abs(out.shapes.box(a)[3] - out.shapes.box(b)[3]) < 0.05 * out.shapes.scene.size
    for one, two in ((a, b), (b, a)):
        out.equal(call("center_x", quoted(one)), call("center_x", call("old", quoted(two))))
        if not level:
            out.equal(call("max_y", quoted(one)), call("max_y", call("old", quoted(two))))


def gap(out: Collector, clause: Clause) -> None:
    """The gap between two things changes."""
    for kind in clause.manner:
        out.moves(kind, clause)
    a, b = (region(clause.side, quoted(n)) for n in clause.theme)
    amount = clause.amount or Amount(1.0, "factor")
    now = call("min_dist", a, b)
    if clause.reference:
        theirs = call(out.shapes.extent(clause.reference[0], clause.dimension), quoted(clause.reference[0]))
        out.equal(now, sized(Amount(amount.value, "factor"), theirs))
        return
    old = call("min_dist", *(region(clause.side, call("old", quoted(n))) for n in clause.theme))
    out.equal(now, amount.value if amount.unit == "length" else sized(amount, old))


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
