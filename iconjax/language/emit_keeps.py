"""What should stay, as constraints."""

from __future__ import annotations

from iconjax.errors import TranslationError
from iconjax.language.clauses import Clause
from iconjax.language.collector import EDGES, SIDED, Collector, call, keeps, quoted, region
from iconjax.language.emit_turns import place_in


def stay(out: Collector, clause: Clause) -> None:
    """Something does not move."""
    for name in clause.theme:
        if name in ("canvas", "@ground", "@theme"):
            raise TranslationError("what should stay is not one of the things in the picture")
        if name in out.themes:
            out.add(keeps("center_x", name), keeps("center_y", name))
        elif whole := next((n for k, n in out.motions if k == "scale" and out.within(name, n)), None):
            out.add(*(keeps(e, name) for e in place_in(out, name, whole)))
        else:
            out.fixed[name] = None


def keep(out: Collector, clause: Clause) -> None:
    """Something keeps one of its properties."""
    for name in clause.theme:
        if clause.relation:
            keep_relation(out, clause, name)
        elif clause.dimension == "size":
            out.add(keeps("hori_len", name), keeps("vert_len", name))
        elif clause.dimension == "proportions":
            out.add(call("uniform", quoted(name)))
        elif clause.dimension == "rotation":
            out.equal(call("rotation", quoted(name)), 0)
        elif clause.dimension == "place":
            out.add(keeps("center_x", name), keeps("center_y", name))
        elif clause.dimension == "level":
            if not any(out.within(t, name) or out.within(name, t) for t in out.themes):
                out.fixed[name] = None
                continue
            resized = any(k == "scale" and (out.within(name, n) or out.within(n, name)) for k, n in out.motions)
            out.add(keeps("max_y" if resized else "center_y", name))
        elif clause.dimension in EDGES:
            out.add(*(keeps(e, name) for e in EDGES[clause.dimension]))
        else:
            out.add(keeps(out.shapes.extent(name, clause.dimension), name))


def keep_relation(out: Collector, clause: Clause, name: str) -> None:
    for other in clause.reference:
        if out.within(other, name):
            continue  # "the lamp, with its shade": what it has it keeps
        s, t, kind = quoted(name), region(clause.side, quoted(other)), clause.relation
        within = kind == "inside" and not out.shapes.lies(name, "inside", other)
        if kind in ("on", "touch", "reach", "around") or within:
            out.add(call("touch", s, t))
            if (
                ("scale", other) in out.motions
                and out.shapes.lies(name, "on", other)
                and ("translate", name) in out.motions
            ):
                out.add(keeps("max_y", other))  # what comes down on it says that it keeps its foot
        elif kind in SIDED:
            out.add(call(SIDED[kind], s, quoted(other)))
        elif kind in ("inside", "overlap", "parallel", "perpendicular"):
            out.add(call(kind, s, quoted(other)))
        elif kind in ("centered", "centered_h"):
            out.equal(call("center_x", s), call("center_x", quoted(other)))
        else:
            raise TranslationError(f'keeping "{name}" {kind} "{other}" is not understood')
        if not any(out.within(t_, other) or out.within(other, t_) for t_ in out.themes) and kind == "on":
            out.fixed[other] = None
