"""The types of checks: one function each, whose keyword arguments are the check's fields with their defaults.

Pixel numbers are for a picture whose larger side is 512; `Stage` brings other sizes to that. A name is a
label, an object or a list of those; several parts count as one, except where a check speaks of every part.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from iconjax.errors import InputError
from iconjax.evaluation.affine import turn_error
from iconjax.evaluation.meeting import meeting
from iconjax.evaluation.outlines import overlap_share, share_inside
from iconjax.evaluation.stage import Part, Reference, Shape, Stage

Side = float | Mapping[str, Any]


@dataclass(frozen=True)
class Finding:
    """Outcome of a check; the fields mean what they mean in `CheckResult`."""

    text: str
    passed: bool
    value: float
    limit: float
    detail: str


def ratio(stage: Stage, *, of: Reference, attr: str, value: float, tol: float = 0.06) -> Finding:
    """An extent is `value` times what it was."""
    shape = stage.shape(of)
    found = shape.attribute(attr) / shape.attribute(attr, old=True)
    text = f"{attr} of {shape.name} x {value:g} (within {tol:g})"
    return Finding(text, abs(found - value) <= tol, found, value, f"x {found:.3f}")


def compare(stage: Stage, *, left: Side, op: str, right: Side, tol: float = 8.0) -> Finding:
    """Two measures are equal, or the first is at most (at least) the second."""
    (a, a_text), (b, b_text) = _side(stage, left), _side(stage, right)
    holds = {"==": abs(a - b) <= tol, "<=": a <= b + tol, ">=": a >= b - tol}
    if op not in holds:
        raise InputError(f"check 'compare': op is {op!r}; it can be ==, <= or >=")
    text = f"{a_text} {op} {b_text} (within {tol:g})"
    return Finding(text, holds[op], a, b, f"{a:.1f} against {b:.1f}")


def rotation(stage: Stage, *, of: Reference, deg: float, sign: str = "any", tol: float = 5.0) -> Finding:
    """Every part turned so far; a mirrored one has not turned."""
    ways = {"cw": (deg,), "ccw": (-deg,), "any": (deg, -deg)}.get(sign)
    if ways is None:
        raise InputError(f"check 'rotation': sign is {sign!r}; it can be any, cw or ccw")

    def error(part: Part) -> float:
        return math.inf if part.motion.mirrored else min(turn_error(part.motion.degrees, way) for way in ways)

    way = "" if sign == "any" else f" {sign}"
    return _worst_part(stage.shape(of), error, tol, f"turned {deg:g} degrees{way} (within {tol:g})")


def touch(stage: Stage, *, a: Reference, b: Reference, gap: float = 7.0, max_overlap: float = 0.25) -> Finding:
    """Near each other, without lying deep in each other."""
    first, second = stage.shape(a), stage.shape(b)
    distance, share = shapely.distance(first.after, second.after), overlap_share(first.after, second.after)
    text = f"{first.name} touches {second.name} (gap at most {gap:g}, overlap at most {max_overlap:g})"
    value, limit = (distance, gap) if distance > gap else (share, max_overlap)
    return Finding(text, value <= limit, value, limit, f"gap {distance:.1f}, overlap {share:.3f}")


def connected(stage: Stage, *, a: Reference, b: Reference, gap: float = 7.0) -> Finding:
    """Near each other, or overlapping."""
    first, second = stage.shape(a), stage.shape(b)
    distance = shapely.distance(first.after, second.after)
    text = f"{first.name} connected to {second.name} (gap at most {gap:g})"
    return Finding(text, distance <= gap, distance, gap, f"gap {distance:.1f}")


def overlap(stage: Stage, *, a: Reference, b: Reference, min_overlap: float = 0.02) -> Finding:
    """Sharing at least so much of the smaller one's area."""
    first, second = stage.shape(a), stage.shape(b)
    share = overlap_share(first.after, second.after)
    text = f"{first.name} overlaps {second.name} (at least {min_overlap:g})"
    return Finding(text, share >= min_overlap, share, min_overlap, f"overlap {share:.3f}")


def detached(stage: Stage, *, a: Reference, b: Reference, gap: float = 1.0) -> Finding:
    """Apart from each other."""
    first, second = stage.shape(a), stage.shape(b)
    distance = shapely.distance(first.after, second.after)
    text = f"{first.name} apart from {second.name} (gap at least {gap:g})"
    return Finding(text, distance >= gap, distance, gap, f"gap {distance:.1f}")


def inside(stage: Stage, *, a: Reference, b: Reference, frac: float = 0.9) -> Finding:
    """So much of the first one's area lies in the second."""
    first, second = stage.shape(a), stage.shape(b)
    share = share_inside(first.after, second.after)
    text = f"{first.name} inside {second.name} (at least {frac:g} of it)"
    return Finding(text, share >= frac, share, frac, f"{share:.3f} of it")


def above(stage: Stage, *, a: Reference, b: Reference, tol: float = 7.0, centre: bool = False) -> Finding:
    """The first box (or its centre) ends above where the second begins."""
    return _in_order(stage, a, b, "above", "y", tol, centre)


def below(stage: Stage, *, a: Reference, b: Reference, tol: float = 7.0, centre: bool = False) -> Finding:
    """The first box (or its centre) begins below where the second ends."""
    return _in_order(stage, a, b, "below", "y", tol, centre)


def left_of(stage: Stage, *, a: Reference, b: Reference, tol: float = 7.0, centre: bool = False) -> Finding:
    """The first box (or its centre) ends left of where the second begins."""
    return _in_order(stage, a, b, "left of", "x", tol, centre)


def right_of(stage: Stage, *, a: Reference, b: Reference, tol: float = 7.0, centre: bool = False) -> Finding:
    """The first box (or its centre) begins right of where the second ends."""
    return _in_order(stage, a, b, "right of", "x", tol, centre)


def dist(stage: Stage, *, a: Reference, b: Reference, kind: str, value: Side, tol: float = 8.0) -> Finding:
    """A distance is `value`: between the outlines, or between box centres (along x, along y, straight)."""
    first, second = stage.shape(a), stage.shape(b)
    across = first.centre() - second.centre()
    found = {"cx": abs(across[0]), "cy": abs(across[1]), "center": float(np.hypot(*across))}
    found["min"] = shapely.distance(first.after, second.after)
    if kind not in found:
        raise InputError(f"check 'dist': kind is {kind!r}; it can be {', '.join(found)}")
    wanted, wanted_text = _side(stage, value)
    text = f"{kind} distance of {first.name} and {second.name} is {wanted_text} (within {tol:g})"
    return Finding(text, abs(found[kind] - wanted) <= tol, float(found[kind]), wanted, f"{found[kind]:.1f}")


def moved(
    stage: Stage, *, of: Reference, dx: Sequence[float] | None = None, dy: Sequence[float] | None = None
) -> Finding:
    """The centre of the box was displaced by an amount within the given ranges."""
    shape = stage.shape(of)
    shift = shape.centre() - shape.centre(old=True)
    ranges = [(n, s, lohi) for n, s, lohi in (("dx", shift[0], dx), ("dy", shift[1], dy)) if lohi is not None]
    if not ranges or any(len(lohi) != 2 for _, _, lohi in ranges):
        raise InputError("check 'moved': give dx=[low, high], dy=[low, high] or both")
    excess = max(max(lohi[0] - s, s - lohi[1]) for _, s, lohi in ranges)
    text = f"{shape.name} moved by " + ", ".join(f"{n} {lohi[0]:g}..{lohi[1]:g}" for n, _, lohi in ranges)
    return Finding(text, excess <= 0, max(excess, 0.0), 0.0, f"dx {shift[0]:.1f}, dy {shift[1]:.1f}")


def same(stage: Stage, *, of: Reference, tol: float = 6.0) -> Finding:
    """No point moved further."""
    return _worst_part(stage.shape(of), lambda p: p.travel, tol, f"stays (within {tol:g})")


def rigid(stage: Stage, *, of: Reference, stretch: float = 0.06, may_rotate: bool = False, tol: float = 5.0) -> Finding:
    """Every part keeps its size and shape, and turns by at most `tol` degrees unless it may rotate."""
    shape = stage.shape(of)

    def scaling(part: Part) -> float:
        return math.inf if part.motion.mirrored else max(abs(f - 1.0) for f in part.motion.factors)

    text = f"keeps its shape (stretch at most {stretch:g}{'' if may_rotate else f', turn at most {tol:g}'})"
    finding = _worst_part(shape, scaling, stretch, text)
    if finding.passed and not may_rotate:
        return _worst_part(shape, _turn, tol, text)
    return finding


def upright(stage: Stage, *, of: Reference, tol: float = 5.0) -> Finding:
    """No part turned or mirrored."""
    return _worst_part(stage.shape(of), _turn, tol, f"upright (within {tol:g} degrees)")


def uniform(stage: Stage, *, of: Reference, tol: float = 0.08) -> Finding:
    """Every part scaled alike in all directions."""

    def uneven(part: Part) -> float:
        large, small = part.motion.factors
        return math.inf if part.motion.mirrored or small <= 0 else large / small - 1.0

    return _worst_part(stage.shape(of), uneven, tol, f"keeps its proportions (within {tol:g})")


def canvas(stage: Stage, *, of: Reference, frac: float = 0.95) -> Finding:
    """So much of its area is in the picture."""
    shape = stage.shape(of)
    share = share_inside(shape.after, stage.canvas)
    text = f"{shape.name} in the picture (at least {frac:g} of it)"
    return Finding(text, share >= frac, share, frac, f"{share:.3f} of it")


def joint(stage: Stage, *, a: Reference, b: Reference, tol: float = 12.0) -> Finding:
    """The point where the two met is carried by both to about the same place."""
    first, second = stage.shape(a), stage.shape(b)
    met = meeting(first, second)
    text = f"{first.name} keeps its joint with {second.name} (within {tol:g})"
    return Finding(text, met.gap <= tol, met.gap, tol, f"apart by {met.gap:.1f}")


_SHAPES = (ratio, compare, dist, touch, connected, overlap, detached, inside, canvas)
_PLACES = (above, below, left_of, right_of, moved, joint)
_MOTIONS = (rotation, same, rigid, upright, uniform)
KINDS: dict[str, Callable[..., Finding]] = {f.__name__: f for f in (*_SHAPES, *_PLACES, *_MOTIONS)}
"""Type of check -> its function."""


def _side(stage: Stage, side: Side) -> tuple[float, str]:
    """Value of a number or of a measure `{attr, of, old, scale, offset}`, and how to say it."""
    if not isinstance(side, Mapping):
        return float(side), f"{side:g}"
    unknown = set(side) - {"attr", "of", "old", "scale", "offset"}
    if unknown or not {"attr", "of"} <= set(side):
        raise InputError(f"a side is a number or {{attr, of, old, scale, offset}}, not {dict(side)}")
    old, scale, offset = side.get("old", False), side.get("scale", 1.0), side.get("offset", 0.0)
    shape = stage.shape(side["of"])
    text = f"{'old ' if old else ''}{side['attr']} of {shape.name}"
    text += (f" x {scale:g}" if scale != 1 else "") + (f" {offset:+g}" if offset else "")
    return shape.attribute(side["attr"], old) * scale + offset, text


def _in_order(stage: Stage, a: Reference, b: Reference, words: str, axis: str, tol: float, centre: bool) -> Finding:
    first, second = stage.shape(a), stage.shape(b)
    text = f"{'centre of ' if centre else ''}{first.name} {words} {second.name} (within {tol:g})"
    low, high = (first, second) if words in ("above", "left of") else (second, first)
    end, start = (f"c{axis}", f"c{axis}") if centre else (f"max{axis}", f"min{axis}")
    excess = low.attribute(end) - high.attribute(start)
    detail = f"{excess:.1f} too far" if excess > 0 else f"{-excess:.1f} clear"
    return Finding(text, excess <= tol, excess, tol, detail)


def _worst_part(shape: Shape, error: Callable[[Part], float], limit: float, text: str) -> Finding:
    worst = max(shape.parts, key=error)
    motion = worst.motion
    factors = " and ".join(f"{factor:.3f}" for factor in motion.factors)
    detail = f"{worst.name} turned {motion.degrees:.1f}, scaled {factors}, moved {worst.travel:.1f}"
    detail += ", mirrored" if motion.mirrored else ""
    return Finding(f"{shape.name} {text}", error(worst) <= limit, error(worst), limit, detail)


def _turn(part: Part) -> float:
    return math.inf if part.motion.mirrored else abs(part.motion.degrees)
