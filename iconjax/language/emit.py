"""From clauses to constraints in the DSL."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from iconjax.errors import TranslationError
from iconjax.language.clauses import Clause
from iconjax.language.collector import Collector
from iconjax.language.emit_keeps import keep, stay
from iconjax.language.emit_pairs import align, gap, space, swap, together
from iconjax.language.emit_places import move, place
from iconjax.language.emit_sizes import resize, scale
from iconjax.language.emit_turns import hinge, orient, rotate
from iconjax.language.shapes import Shapes

CHANGING = frozenset(
    {"scale", "rotate", "move", "place", "orient", "turn", "go", "resize", "swap", "gap", "align", "space"}
)
"""Actions whose theme does not stay as it is."""


def _go(out: Collector, clause: Clause) -> None:
    out.moves("translate", clause)


def _turn(out: Collector, clause: Clause) -> None:
    out.moves("rotate", clause)


def _topic(out: Collector, clause: Clause) -> None:
    del out, clause  # only says what the next clause is about


ACTIONS: Mapping[str, Callable[[Collector, Clause], None]] = {
    "topic": _topic,
    "go": _go,
    "turn": _turn,
    "resize": resize,
    "scale": scale,
    "rotate": rotate,
    "orient": orient,
    "hinge": hinge,
    "move": move,
    "place": place,
    "swap": swap,
    "gap": gap,
    "space": space,
    "align": align,
    "together": together,
    "stay": stay,
    "keep": keep,
}


def emit(clauses: Sequence[Clause], shapes: Shapes) -> tuple[str, ...]:
    """The program of a list of clauses.

    Raises:
        TranslationError: a clause asks for something that this scene has no meaning for.
    """
    out = Collector(shapes)
    for clause in clauses:
        if clause.action in CHANGING:
            out.themes.update(dict.fromkeys(clause.theme))
        if clause.action in ("rotate", "orient", "turn"):
            out.turned.update(clause.theme)
    for clause in clauses:
        ACTIONS[clause.action](out, clause)
    lines = out.lines()
    if any('"@' in line for line in lines):
        raise TranslationError("an end or a side is named, and not of what")
    return lines
