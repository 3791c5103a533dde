"""The constraints of a request while they are being collected, and how they are written."""

from __future__ import annotations

import math

from iconjax.errors import TranslationError
from iconjax.language.clauses import Amount, Clause
from iconjax.language.shapes import Shapes

EDGES = {
    "left": ("min_x",),
    "right": ("max_x",),
    "top": ("min_y",),
    "bottom": ("max_y",),
    "middle": ("center_x", "center_y"),
    "topleft": ("min_x", "min_y"),
    "topright": ("max_x", "min_y"),
    "bottomleft": ("min_x", "max_y"),
    "bottomright": ("max_x", "max_y"),
    "vertical": ("center_x",),
    "horizontal": ("center_y",),
}
"""Side -> attributes of the box that say where it is."""
REGIONS = {"left": "left", "right": "right", "top": "top", "bottom": "bot"}
SIDED = {"above": "on_top", "below": "on_bottom", "left_of": "on_left", "right_of": "on_right"}


def call(name: str, *args: str | float) -> str:
    """A call as text; names must already be quoted."""
    return f"{name}({', '.join(_number(a) if isinstance(a, int | float) else a for a in args)})"


def _number(value: float) -> str:
    return f"{round(value, 4):g}"


def quoted(name: str) -> str:
    """A name as a DSL string."""
    return '"' + name.replace("\\", "\\\\").replace('"', '\\"') + '"'


def keeps(attribute: str, name: str) -> str:
    """An attribute stays what it was."""
    s = quoted(name)
    return call("equal", call(attribute, s), call(attribute, call("old", s)))


class Collector:
    """Collects the constraints of a request, clause by clause.

    Attributes:
        shapes: geometry of the scene.
        motions: (kind, name) asked for, in order.
        values: constraint lines, in order.
        axis_keeps: (name, axis) to keep where no constraint speaks of them.
        fixed: names told to stay.
        anchors: what things are placed relative to -> those things; it stays unless something else moves it.
        themes: everything the request changes.
        turned: what of it turns.
    """

    def __init__(self, shapes: Shapes) -> None:
        self.shapes = shapes
        self.motions: dict[tuple[str, str], None] = {}
        self.values: dict[str, None] = {}
        self.axis_keeps: dict[tuple[str, int], None] = {}
        self.fixed: dict[str, None] = {}
        self.anchors: dict[str, list[str]] = {}
        self.themes: dict[str, None] = {}
        self.turned: set[str] = set()

    def add(self, *lines: str) -> None:
        """Add constraints."""
        self.values.update(dict.fromkeys(lines))

    def equal(self, a: str, b: str | float) -> None:
        """Add an equation."""
        self.add(call("equal", a, b))

    def moves(self, kind: str, clause: Clause) -> None:
        """Ask a kind of motion of the themes, unless a whole that they belong to has it."""
        for name in clause.theme:
            if name in ("canvas", "@ground", "@theme"):
                raise TranslationError("the picture as a whole cannot be changed; name something in it")
            if not any(k == kind and self.shapes.part_of(name, n) for k, n in self.motions):
                self.motions[(kind, name)] = None

    def anchor(self, other: str, name: str) -> None:
        """Note that a thing is placed relative to another."""
        self.anchors.setdefault(other, []).append(name)

    def _motion_lines(self) -> list[str]:
        return [call(kind, quoted(name)) for kind, name in self.motions]

    def _stay_lines(self) -> list[str]:
        lines = [call("stay", quoted(n)) for n in self.fixed]
        for anchor, movers in self.anchors.items():
            moving = {self.object_of(n) for n in self.themes if n != anchor}
            own = {self.object_of(n) for n in (*movers, anchor)}
            touched = any(self.within(t, anchor) or self.within(anchor, t) for t in self.themes)
            if moving <= own and not touched and anchor not in self.fixed:
                lines.append(call("stay", quoted(anchor)))
        return lines

    def _axis_lines(self) -> list[str]:
        lines = []
        for name, axis in self.axis_keeps:
            q, letter = quoted(name), "xy"[axis]
            spoken = [v for v in self.values if any(f"{a}_{letter}({q})" in v for a in ("center", "min", "max"))]
            if not spoken:
                lines.append(keeps(f"center_{letter}", name))
        return lines

    def object_of(self, name: str) -> str:
        """The object that a name belongs to."""
        segments = self.shapes.segments(name)
        return segments[0].object if segments else name

    def within(self, inner: str, outer: str) -> bool:
        """Whether a thing is the other, or a part of it."""
        a = {s.id for s in self.shapes.segments(inner)}
        return bool(a) and a <= {s.id for s in self.shapes.segments(outer)}

    def lines(self) -> tuple[str, ...]:
        """The program so far: motions, what stays, then values."""
        self._drop_loose()
        every = (*self._motion_lines(), *self._stay_lines(), *self.values, *self._axis_lines())
        return tuple(dict.fromkeys(every))

    def _drop_loose(self) -> None:
        """Centred is more than somewhere above."""
        for name in self.themes:
            x = f"(center_x({quoted(name)}), "
            if any(v.startswith(f"equal{x}center_x(") for v in self.values):
                loose = (f"larger{x}", f"smaller{x}")
                self.values = {v: None for v in self.values if not v.startswith(loose)}


def sized(amount: Amount, extent: str) -> str:
    """An amount applied to an extent."""
    if amount.unit == "added":
        return call("plus", extent, amount.value) if amount.value >= 0 else call("minus", extent, -amount.value)
    return extent if math.isclose(amount.value, 1.0) else call("mul", amount.value, extent)


def region(side: str | None, segment: str) -> str:
    """A segment, or its region on a side."""
    if side is None:
        return segment
    if side not in REGIONS:
        raise TranslationError(f"the {side} of a thing cannot be used here")
    return call(REGIONS[side], segment)
