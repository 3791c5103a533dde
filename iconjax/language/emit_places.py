"""Places as constraints."""

from __future__ import annotations

from iconjax.errors import TranslationError
from iconjax.language.clauses import Clause
from iconjax.language.collector import EDGES, SIDED, Collector, call, quoted, region

NEAR_SHARE = 0.04
"""Gap of things "next to" each other, as a share of the picture's larger side."""


def move(out: Collector, clause: Clause) -> None:
    """A move by a distance."""
    out.moves("translate", clause)
    axis = 0 if clause.direction in ("left", "right") else 1
    sign = 1 if clause.direction in ("right", "down") else -1
    for name in clause.theme:
        centre, s = f"center_{'xy'[axis]}", quoted(name)
        moved = call("minus", call(centre, s), call(centre, call("old", s)))
        out.equal(moved, distance(out, clause, name, axis, sign))
        out.axis_keeps[(name, 1 - axis)] = None
    if "together" in clause.manner:
        out.add(call("together", *map(quoted, clause.theme)))


def distance(out: Collector, clause: Clause, name: str, axis: int, sign: int) -> str | float:
    amount = clause.amount
    if amount is None:
        raise TranslationError(f"how far {quoted(name)} should move {clause.direction} is not said")
    if amount.unit in ("px", "none"):
        return sign * amount.value
    if amount.unit == "deg":
        raise TranslationError("a distance cannot be given in degrees")
    if amount.vague:
        return call("mul", sign * amount.value / 3, call(("hori_len", "vert_len")[axis], quoted("canvas")))
    own = ("hori", "vert")[axis]
    dim = own if amount.of is None or amount.of.dim in ("size", "gap") else amount.of.dim
    whole = clause.reference[0] if clause.reference else name if amount.of is not None else "canvas"
    extent = out.shapes.extent(whole, dim)
    region = quoted(whole) if whole == "canvas" else call("old", quoted(whole))
    return call("mul", sign * amount.value, call(extent, region))


def place(out: Collector, clause: Clause) -> None:
    """A move to a place relative to something."""
    asked = {n for _, n in out.motions}
    # "turn it until it touches ..." asks for no other motion than the one it names
    if not (
        "follow" in clause.manner and all(any(n == a or out.shapes.part_of(n, a) for a in asked) for n in clause.theme)
    ):
        out.moves("translate", clause)
    kind = clause.relation
    if "@ground" in clause.reference:
        return grounded(out, clause)
    for name in clause.theme:
        if kind == "between":
            between(out, name, clause)
            continue
        for other in clause.reference:
            if name == other:
                raise TranslationError(f'"{name}" cannot be placed relative to itself')
            related(out, clause, name, other)
            if other not in ("canvas", "@theme"):
                if room(out, clause, name, other):
                    out.anchors.setdefault(other, name)
                else:
                    out.motions[("translate", other)] = None
            keep_axis(out, clause, name, other)


def room(out: Collector, clause: Clause, name: str, other: str) -> bool:
    """Whether the theme has room in the picture on the asked side of the other thing."""
    x0, _, x1, _ = out.shapes.box(other)
    wide, _ = out.shapes.size(name)
    scene = out.shapes.scene
    room = {"left_of": x0 - wide, "right_of": scene.width - x1 - wide}
    return room.get(f"{side_of(clause)}_of" if side_of(clause) else clause.relation, 0.0) >= 0


def related(out: Collector, clause: Clause, name: str, other: str) -> None:
    """One thing placed relative to one other."""
    kind, s, t = clause.relation, quoted(name), quoted(other)
    if _meets_sides(clause, other):
        flush(out, clause, name, other)
        return
    if kind in SIDED and clause.amount is not None:
        apart(out, clause, name, other)
        return
    match kind:
        case "on" | "touch" | "reach":
            if kind == "on":
                out.add(call("on_top", s, t))
            out.add(call("touch", region(clause.theme_side, s), region(clause.side, t)))
        case "above" | "below" | "left_of" | "right_of":
            out.add(call(SIDED[kind], s, t))
        case "inside" | "outside" | "overlap":
            out.add(call("detach" if kind == "outside" else kind, s, region(clause.side, t)))
        case "centered" | "centered_h" | "same_place":
            centre(out, kind, name, other)
        case "beside":
            beside(out, clause, name, other)
        case "away" | "toward":
            nearer(out, clause, name, other)
        case _:
            raise TranslationError(f'"{kind}" is not understood here')
    if kind in ("on", "above", "below") and not clause.side:
        over(out, name, other)


def grounded(out: Collector, clause: Clause) -> None:
    """Down to the ground, which is where the lowest of the other things stands."""
    shapes, last = out.shapes, 0.9 * out.shapes.scene.width
    for name in clause.theme:
        others = [o for o in shapes.scene.objects if o != out.object_of(name) and shapes.size(o)[0] < last]
        lowest = max(others, key=lambda o: shapes.box(o)[3], default=None)
        if clause.theme_side not in (None, "bottom"):
            raise TranslationError(f"the {clause.theme_side} of a thing cannot go to the ground by itself")
        if lowest is None or clause.relation not in ("on", "touch", "reach", "flush"):
            raise TranslationError("the ground is not one of the things in the picture; say where to go in another way")
        out.equal(call("max_y", quoted(name)), call("max_y", quoted(lowest)))
        keep_axis(out, clause, name, lowest)


def _meets_sides(clause: Clause, other: str) -> bool:
    """Whether a place is a matter of sides that coincide: ends, edges of the picture, corners."""
    kind, side = clause.relation, clause.side
    corner = kind in ("inside", "on") and side is not None and len(side) > len("bottom")
    ends = kind in ("reach", "same_place") and side is not None
    return kind == "flush" or corner or ends or (other == "canvas" and kind in SIDED)


def centre(out: Collector, kind: str, name: str, other: str) -> None:
    """Middles coincide."""
    axes = {"centered_h": "x", "same_place": "y"}.get(kind, "xy")
    if kind == "centered" and other != "canvas" and out.shapes.axis_gap(name, other, 1) > -1.0:
        axes = "x"  # "centred on the table" for what stands on it is only left and right
        out.axis_keeps[(name, 1)] = None
    for axis in axes:
        out.equal(call(f"center_{axis}", quoted(name)), call(f"center_{axis}", quoted(other)))


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


def side_of(clause: Clause) -> str:
    """The side of the other thing that a place beside it names: left, right or ""."""
    return next((m[3:] for m in ("at left", "at right") if m in clause.manner), "")


def nearer(out: Collector, clause: Clause, name: str, other: str) -> None:
    s, t = quoted(name), quoted(other)
    old = call("min_dist", call("old", s), call("old", t))
    sign = 1 if clause.relation == "away" else -1
    amount = clause.amount
    if amount is None or amount.vague:
        aim = call("mul", 1 + sign * 0.5, old)
    elif amount.unit in ("px", "none"):
        aim = call("plus" if sign > 0 else "minus", old, amount.value)
    else:
        aim = call("mul", 1 + sign * amount.value, old)
    out.equal(call("min_dist", s, t), aim)
    wide = out.shapes.axis_gap(name, other, 0) >= out.shapes.axis_gap(name, other, 1)
    out.axis_keeps[(name, 1 if wide else 0)] = None


def between(out: Collector, name: str, clause: Clause) -> None:
    if len(clause.reference) != 2:
        raise TranslationError("between needs two things")
    a, b = clause.reference
    main = 0 if out.shapes.axis_gap(a, b, 0) >= out.shapes.axis_gap(a, b, 1) else 1
    cross = all(out.shapes.axis_gap(name, o, 1 - main) > 0 for o in (a, b))
    for axis in (main, 1 - main) if cross else (main,):
        centre = f"center_{'xy'[axis]}"
        both = call("plus", call(centre, quoted(a)), call(centre, quoted(b)))
        out.equal(call(centre, quoted(name)), call("div", both, 2))
    out.anchors.update(dict.fromkeys(clause.reference, name))


def keep_axis(out: Collector, clause: Clause, name: str, other: str) -> None:
    if clause.direction.startswith("along "):
        along(out, name, clause.direction[6:])
    elif clause.direction:
        axis = 1 if clause.direction in ("left", "right") else 0
        loose = clause.relation in ("above", "below", "left_of", "right_of", "flush", "reach", "outside")
        if loose or out.shapes.axis_gap(name, other, axis) < 0:
            out.axis_keeps[(name, axis)] = None


def along(out: Collector, name: str, rail: str) -> None:
    s, r = quoted(name), quoted(rail)
    step = [call("minus", call(f"center_{a}", s), call(f"center_{a}", call("old", s))) for a in "xy"]
    out.equal(call("mul", step[1], call("long_dir_x", r)), call("mul", step[0], call("long_dir_y", r)))
    out.anchors.setdefault(rail, name)
