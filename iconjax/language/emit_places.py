"""Places as constraints."""

from __future__ import annotations

from iconjax.errors import TranslationError
from iconjax.language.bearings import bearing
from iconjax.language.clauses import Clause
from iconjax.language.collector import SIDED, Collector, call, keeps, quoted, region
from iconjax.language.emit_sides import across, along, apart, beside, centre, flush, nearer, over, side_of

AWAY = {"left": "on_left", "right": "on_right"}


def move(out: Collector, clause: Clause) -> None:
    """A move by a distance."""
    out.moves("translate", clause)
    for name in clause.theme:
        way = bearing(out.shapes, name, clause.direction, clause.theme)
        axis = 0 if way in ("left", "right") else 1
        sign = 1 if way in ("right", "down") else -1
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
                    out.anchor(other, name)
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
    if "plumb" in clause.manner and not clause.side:
        centre(out, "centered_h", name, other)
    elif kind in ("on", "above", "below") and not clause.side:
        over(out, name, other)
    if kind == "on" or kind in SIDED:
        out.add(call("on_top" if kind == "on" else SIDED[kind], s, t))
    match kind:
        case "on" | "touch" | "reach":
            out.add(call("touch", region(clause.theme_side, s), region(clause.side, t)))
        case "above" | "below" | "left_of" | "right_of":
            pass
        case "inside" | "overlap":
            out.add(call(kind, s, region(clause.side, t)))
        case "across":
            across(out, name, other)
        case "centered" | "centered_h" | "same_place":
            centre(out, kind, name, other)
        case _ if kind in BY_SIDE:
            BY_SIDE[kind](out, clause, name, other)
        case _:
            raise TranslationError(f'"{kind}" is not understood here')


def outside(out: Collector, clause: Clause, name: str, other: str) -> None:
    """Clear of another thing, on the side that the move leads to."""
    out.add(call("detach", quoted(name), region(clause.side, quoted(other))))
    if clause.direction in AWAY and other != "canvas":
        out.add(call(AWAY[clause.direction], quoted(name), quoted(other)))


BY_SIDE = {"outside": outside, "beside": beside, "away": nearer, "toward": nearer}


def grounded(out: Collector, clause: Clause) -> None:
    """Down to the ground, which is where the lowest of the other things stands."""
    shapes, last = out.shapes, 0.9 * out.shapes.scene.width
    for name in clause.theme:
        others = [o for o in shapes.scene.objects if o != out.object_of(name) and shapes.size(o)[0] < last]
        lowest = max(others, key=lambda o: shapes.box(o)[3], default=None)
        if clause.theme_side not in (None, "bottom"):
            raise TranslationError(f"the {clause.theme_side} of a thing cannot go to the ground by itself")
        down = lowest is None or shapes.box(name)[3] > shapes.box(lowest)[3] - 0.02 * shapes.scene.size
        if down and clause.relation in ("on", "touch", "reach", "flush"):
            out.add(keeps("max_y", name))  # it is the one that stands lowest
            continue
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
    for other in clause.reference:
        out.anchor(other, name)


def keep_axis(out: Collector, clause: Clause, name: str, other: str) -> None:
    if clause.direction.startswith("along "):
        along(out, name, clause.direction[6:])
    elif clause.direction:
        axis = 1 if bearing(out.shapes, name, clause.direction, clause.theme) in ("left", "right") else 0
        loose = clause.relation in ("above", "below", "left_of", "right_of", "flush", "reach", "outside")
        if loose or out.shapes.axis_gap(name, other, axis) < 0:
            out.axis_keeps[(name, axis)] = None
