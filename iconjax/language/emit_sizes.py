"""Sizes as constraints."""

from __future__ import annotations

from iconjax.errors import TranslationError
from iconjax.language.clauses import Amount, Clause
from iconjax.language.collector import EDGES, Collector, call, keeps, quoted, sized


def scale(out: Collector, clause: Clause) -> None:
    """A change of size."""
    if "without motion" not in clause.manner:
        out.moves("scale", clause)
    dims = ("hori", "vert") if clause.dimension == "size" else (clause.dimension,)
    if "as one" in clause.manner and not clause.reference:
        return united(out, clause, dims)
    for name in clause.theme:
        for dim in dims:
            extent(out, clause, name, dim)
        for mark in clause.manner:
            if mark.startswith("pin "):
                out.add(*(keeps(e, name) for e in EDGES[mark[4:]]))
    return None


def united(out: Collector, clause: Clause, dims: tuple[str, ...]) -> None:
    """A change of the extent of several things taken as one."""
    names = [quoted(n) for n in clause.theme]
    whole = call("union", *names)
    amount = clause.amount or Amount(1.0, "factor")
    for dim in dims:
        extents = {out.shapes.extent(n, dim) for n in clause.theme}
        attribute = extents.pop() if len(extents) == 1 and extents <= {"hori_len", "vert_len"} else "vert_len"
        old = call(attribute, call("old", whole))
        out.equal(call(attribute, whole), amount.value if amount.unit == "length" else sized(amount, old))
        if amount.unit == "factor" and attribute in ("hori_len", "vert_len"):
            for name in names:  # the whole and each of its things by the same factor
                out.equal(call(attribute, name), sized(amount, call(attribute, call("old", name))))
    if clause.dimension == "size" and amount.unit != "factor":
        out.add(*(call("uniform", n) for n in names))


def extent(out: Collector, clause: Clause, name: str, dim: str) -> None:
    attribute, s = out.shapes.extent(name, dim, name in out.turned), quoted(name)
    now, amount = call(attribute, s), clause.amount or Amount(1.0, "factor")
    if amount.unit == "length":
        return out.equal(now, amount.value)
    if not clause.reference:
        return out.equal(now, sized(amount, call(attribute, call("old", s))))
    reference_dim = dim if clause.dimension == "size" else clause.side or dim
    if len(clause.reference) > 1 and len(clause.reference) != len(clause.theme):
        sizes = {round(out.shapes.size(n)[0 if reference_dim == "hori" else 1]) for n in clause.reference}
        if len(sizes) > 1:
            raise TranslationError(f"{' and '.join(clause.reference)} differ in size: name the one that counts")
    at = clause.theme.index(name) if len(clause.reference) == len(clause.theme) else 0
    for other in clause.reference[at : at + 1]:
        theirs = call(out.shapes.extent(other, reference_dim), quoted(other))
        if amount.unit in ("more", "less"):
            out.add(
                call(
                    "larger" if amount.unit == "more" else "smaller",
                    now,
                    call("mul", 1.1 if amount.unit == "more" else 0.9, theirs),
                )
            )
        else:
            out.equal(now, sized(amount, theirs))
    return None


def resize(out: Collector, clause: Clause) -> None:
    """A change of size of which the next clause says how far it goes."""
    out.moves("scale", clause)
    if "uniform" in clause.manner:
        out.add(*(call("uniform", quoted(n)) for n in clause.theme))
