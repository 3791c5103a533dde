"""Turning as constraints."""

from __future__ import annotations

from iconjax.errors import TranslationError
from iconjax.language.bearings import RELATIVE, bearing, turning
from iconjax.language.clauses import Clause
from iconjax.language.collector import Collector, call, keeps, quoted


def rotate(out: Collector, clause: Clause) -> None:
    """A turn by an angle."""
    out.moves("rotate", clause)
    degrees = clause.amount.value if clause.amount else 0.0
    for name in clause.theme:
        sign = sense(out, clause.theme[0] if "together" in clause.manner else name, clause)
        s = quoted(name)
        if sign:
            out.equal(call("rotation", s), sign * degrees)
        elif degrees < 0:
            out.equal(call("rotation", s), degrees)
        else:
            out.equal(call("angle", s, call("old", s)), degrees)


def sense(out: Collector, name: str, clause: Clause) -> int:
    """1 for clockwise, -1 for counter-clockwise, 0 where the request leaves it open."""
    direction = clause.direction
    if direction in ("cw", "ccw"):
        return 1 if direction == "cw" else -1
    if direction in RELATIVE:
        try:
            way = bearing(out.shapes, name, direction, clause.theme)
        except TranslationError:
            if direction in ("in", "out"):
                raise
            return 0  # which end is in front the picture does not say
        return turning(out.shapes, name, way)
    if direction in ("up", "down"):
        x, y = out.shapes.centre(name)
        px, _ = out.shapes.pivot(name)
        if abs(x - px) < 0.1 * max(out.shapes.size(name)):
            raise TranslationError(
                f'which end of "{name}" goes {direction} is not clear: say clockwise or counter-clockwise'
            )
        # turning clockwise lifts what lies left of the pivot
        return (1 if x < px else -1) * (1 if direction == "up" else -1)
    if direction in ("away", "toward"):
        (x, y), (px, py) = out.shapes.centre(name), out.shapes.pivot(name, clause.reference[0])
        tx, ty = out.shapes.centre(clause.reference[0])
        cross = (tx - px) * (y - py) - (ty - py) * (x - px)
        if abs(cross) < 1e-3 * out.shapes.scene.size**2:
            raise TranslationError(
                f'which way is {direction} "{clause.reference[0]}" is not clear: say clockwise or not'
            )
        return (1 if cross > 0 else -1) * (1 if direction == "away" else -1)
    return 0


def orient(out: Collector, clause: Clause) -> None:
    """A turn until the thing is level, upright, or parallel to another."""
    whole = [n for _, n in out.motions if all(out.shapes.part_of(t, n) for t in clause.theme)]
    if "follow" in clause.manner and whole:
        # "bring the hammer down so that its head is level": the hammer turns
        out.motions[("rotate", whole[-1])] = None
    else:
        out.moves("rotate", clause)
    for name in clause.theme:
        relation, s = clause.relation, quoted(name)
        if relation in ("parallel", "perpendicular"):
            for other in clause.reference:
                out.add(call(relation, s, quoted(other)))
                out.anchor(other, name)
            continue
        if out.shapes.round(name):
            raise TranslationError(f'"{name}" has no long direction that could be {relation}')
        if relation == "straight":
            relation = "upright" if out.shapes.size(name)[1] >= out.shapes.size(name)[0] else "level"
        out.equal(call("long_dir_y" if relation == "level" else "long_dir_x", s), 0)


def hinge(out: Collector, clause: Clause) -> None:
    """A pivot of a turn."""
    for name in clause.theme:
        for pivot in clause.reference:
            if clause.side is None and out.shapes.part_of(pivot, name):
                edge = place_in(out, pivot, name)
                side = {"max_y": "bottom", "min_y": "top", "min_x": "left", "max_x": "right"}.get(edge[0], "middle")
                pin(out, name, *point(out, pivot, side))
            elif clause.side is None:
                out.add(call("hinge", quoted(name), quoted(pivot)))
            elif pivot not in ("@theme", name):
                x, y = point(out, pivot, clause.side)
                pin(out, name, x, y)
            elif clause.side == "middle":
                out.add(keeps("center_x", name), keeps("center_y", name))
            else:
                pin(out, name, *point(out, name, clause.side))


def pin(out: Collector, name: str, x: float, y: float) -> None:
    """A material point keeps its place."""
    point, s = f"[{x:.4g}, {y:.4g}]", quoted(name)
    out.add(call("coincide_on_point", s, point, call("old", s), point))


def point(out: Collector, name: str, side: str) -> tuple[float, float]:
    if side in ("top", "bottom", "left", "right"):
        return out.shapes.end(name, side)
    x0, y0, x1, y1 = out.shapes.box(name)
    x = x0 if "left" in side else x1 if "right" in side else (x0 + x1) / 2
    y = y0 if "top" in side else y1 if "bottom" in side else (y0 + y1) / 2
    return x, y


def place_in(out: Collector, name: str, whole: str) -> tuple[str, ...]:
    """What of a part can stay while the whole changes: the side by which it ends the whole, or its middle."""
    part, box = out.shapes.box(name), out.shapes.box(whole)
    least = 0.02 * out.shapes.scene.size
    for edge, index in (("max_y", 3), ("min_y", 1), ("min_x", 0), ("max_x", 2)):
        if abs(part[index] - box[index]) < least:
            return (edge,)
    return ("center_x", "center_y")
