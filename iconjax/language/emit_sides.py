"""One thing placed relative to one other, as constraints: beside it, flush with it, so far from it."""

from __future__ import annotations

from iconjax.errors import TranslationError
from iconjax.language.clauses import Clause
from iconjax.language.collector import EDGES, Collector, call, quoted

NEAR_SHARE = 0.04
"""Gap of things "next to" each other, as a share of the picture's larger side."""


def over(out: Collector, name: str, other: str) -> None:
    """What goes on or above something has its middle over it; said only where it is not so already."""
    x = out.shapes.centre(name)[0]
    x0, _, x1, _ = out.shapes.box(other)
    if not x0 <= x <= x1:
        s, t = quoted(name), quoted(other)
        out.add(
            call("larger", call("center_x", s), call("min_x", t)),
            call("smaller", call("center_x", s), call("max_x", t)),
        )


def flush(out: Collector, clause: Clause, name: str, other: str) -> None:
    sided = {"left_of": "left", "right_of": "right", "above": "top", "below": "bottom"}.get(clause.relation)
    theirs = clause.side or sided or clause.theme_side
    mine = clause.theme_side or theirs
    if theirs is None or mine is None:
        raise TranslationError(
            'which sides should meet is not said: say e.g. "its left side flush with the left end of ..."'
        )
    ours, others = EDGES[mine], EDGES[theirs]
    if len(ours) != len(others) or {a[-1] for a in ours} != {b[-1] for b in others}:
        raise TranslationError(f"the {mine} of one thing cannot meet the {theirs} of another")
    for a, b in zip(ours, others, strict=True):
        out.equal(call(a, quoted(name)), call(b, quoted(other)))


def apart(out: Collector, clause: Clause, name: str, other: str) -> None:
    assert clause.amount is not None
    mine, theirs, operator = {
        "left_of": ("max_x", "min_x", "minus"), "right_of": ("min_x", "max_x", "plus"),
        "above": ("max_y", "min_y", "minus"), "below": ("min_y", "max_y", "plus"),
    }[clause.relation]  # fmt: skip
    if clause.amount.unit not in ("px", "none"):
        raise TranslationError("the distance has to be given in px here")
    out.equal(call(mine, quoted(name)), call(operator, call(theirs, quoted(other)), clause.amount.value))


def beside(out: Collector, clause: Clause, name: str, other: str) -> None:
    s, t, gap = quoted(name), quoted(other), float(round(NEAR_SHARE * out.shapes.scene.size))
    (x0, _, x1, low), (a0, _, a1, ground) = out.shapes.box(name), out.shapes.box(other)
    side = side_of(clause)
    if "touching" in clause.manner and not side and out.shapes.axis_gap(name, other, 0) > 0:
        side = "left" if x0 + x1 <= a0 + a1 else "right"
    if side:
        out.add(call(f"on_{side}", s, t))
    if "touching" in clause.manner:
        out.add(call("touch", s, t))
    elif (side or ("left" if x0 + x1 <= a0 + a1 else "right")) == "left":
        out.equal(call("max_x", s), call("minus", call("min_x", t), gap))
    else:
        out.equal(call("min_x", s), call("plus", call("max_x", t), gap))
    level = side and abs(low - ground) < 0.05 * out.shapes.scene.size
    if level or out.shapes.axis_gap(name, other, 1) > 0:
        out.equal(call("max_y", s), call("max_y", t))


def across(out: Collector, name: str, other: str) -> None:
    """To the other side: as far from the middle of the other thing as before."""
    s, t, shapes = quoted(name), quoted(other), out.shapes
    offsets = [abs(a - b) for a, b in zip(shapes.centre(name), shapes.centre(other), strict=True)]
    letter = "xy"[offsets[1] > offsets[0]]
    now, there, before = (
        call(f"center_{letter}", s),
        call(f"center_{letter}", t),
        call(f"center_{letter}", call("old", s)),
    )
    out.equal(call("minus", now, there), call("minus", call(f"center_{letter}", call("old", t)), before))
    out.axis_keeps[(name, 1 if letter == "x" else 0)] = None


def side_of(clause: Clause) -> str:
    """The side of the other thing that a place beside it names: left, right or ""."""
    return next((m[3:] for m in ("at left", "at right") if m in clause.manner), "")


def nearer(out: Collector, clause: Clause, name: str, other: str) -> None:
    s, t = quoted(name), quoted(other)
    old = call("min_dist", call("old", s), call("old", t))
    sign = 1 if clause.relation == "away" else -1
    amount = clause.amount
    if amount is not None and amount.unit in ("px", "none"):
        return stepped(out, clause, name, other, sign * amount.value)
    if amount is None or amount.vague:
        aim = call("mul", 1 + sign * 0.5, old)
    else:
        aim = call("mul", 1 + sign * amount.value, old)
    out.equal(call("min_dist", s, t), aim)
    wide = out.shapes.axis_gap(name, other, 0) >= out.shapes.axis_gap(name, other, 1)
    out.axis_keeps[(name, 1 if wide else 0)] = None
    return None


def stepped(out: Collector, clause: Clause, name: str, other: str, away: float) -> None:
    """Some px towards or away from another thing, along the axis on which it lies further off."""
    offsets = [a - b for a, b in zip(out.shapes.centre(name), out.shapes.centre(other), strict=True)]
    axis = 0 if abs(offsets[0]) >= abs(offsets[1]) else 1
    if clause.side in ("left", "right", "top", "bottom"):  # "10 px closer to the left edge"
        axis = 0 if clause.side in ("left", "right") else 1
        edge = out.shapes.box(other)[{"left": 0, "top": 1, "right": 2, "bottom": 3}[clause.side]]
        offsets[axis] = out.shapes.centre(name)[axis] - edge
    centre, s = f"center_{'xy'[axis]}", quoted(name)
    moved = call("minus", call(centre, s), call(centre, call("old", s)))
    out.equal(moved, away if offsets[axis] > 0 else -away)
    out.axis_keeps[(name, 1 - axis)] = None


def along(out: Collector, name: str, rail: str) -> None:
    s, r = quoted(name), quoted(rail)
    step = [call("minus", call(f"center_{a}", s), call(f"center_{a}", call("old", s))) for a in "xy"]
    out.equal(call("mul", step[1], call("long_dir_x", r)), call("mul", step[0], call("long_dir_y", r)))
    out.anchor(rail, name)


def centre(out: Collector, kind: str, name: str, other: str) -> None:
    """Middles coincide."""
    axes = {"centered_h": "x", "same_place": "y"}.get(kind, "xy")
    if kind == "centered" and other != "canvas" and out.shapes.axis_gap(name, other, 1) > -1.0:
        axes = "x"  # "centred on the table" for what stands on it is only left and right
        out.axis_keeps[(name, 1)] = None
    for axis in axes:
        out.equal(call(f"center_{axis}", quoted(name)), call(f"center_{axis}", quoted(other)))
