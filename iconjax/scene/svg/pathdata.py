"""The text of a path cut into its separate outlines."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from jaxtyping import Float

from iconjax.scene.svg.limits import MAX_COORDINATE, MAX_PIECES, MAX_SPLIT
from iconjax.scene.svg.numbers import NUMBER

_COUNT = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
_COMMAND = re.compile(r"[\s,]*([MmLlHhVvCcSsQqTtAaZz])")
_NUMBER = re.compile(rf"[\s,]*({NUMBER})")
_FLAG = re.compile(r"[\s,]*([01])")
STEPS = 12
"""Straight pieces per curve when outlines are compared."""


@dataclass(frozen=True)
class Subpath:
    """One outline of a path.

    Attributes:
        text: path data that stands alone, beginning with an absolute "M".
        points: (n, 2) the outline in straight pieces, in the path's own units.
    """

    text: str
    points: Float[np.ndarray, "n 2"]


@lru_cache(maxsize=256)
def subpaths(d: str) -> tuple[Subpath, ...]:
    """The outlines of a path in order; none where the path is too long or breaks the grammar."""
    if len(d) > MAX_SPLIT:
        return ()
    spans = _spans(d)
    if len(spans) > 4 * MAX_PIECES:
        return ()
    try:
        lines = [_flatten(text) for text in spans]
    except ValueError:  # the library's grammar is stricter in places
        return ()
    if not all(np.abs(points).max() <= MAX_COORDINATE for points in lines):
        return ()
    return tuple(Subpath(text, points) for text, points in zip(spans, lines, strict=True))


def pieces(d: str, rule: str = "nonzero", *, filled: bool = True, stroke: float = 0.0) -> list[tuple[int, ...]]:
    """Which outlines of a path belong together, holes with what they are cut from.

    Args:
        d: path data.
        rule: "evenodd" or "nonzero".
        filled: whether the inside is painted; else only lines are.
        stroke: width of the lines in the path's own units; outlines whose lines run into each other are one.

    Returns:
        Groups of positions in `subpaths(d)`, in order of their first outline; one group where the path cannot
        or should not be split.
    """
    parts = subpaths(d)
    if len(parts) < 2:
        return [tuple(range(len(parts)))]
    shapes = [_shape(part.points, filled) for part in parts]
    owner = list(range(len(parts)))
    if filled:
        _join_holes(owner, shapes, [_turn(part.points) for part in parts], rule)
    for i in range(len(parts)):
        for j in range(i):
            if _root(owner, i) != _root(owner, j) and _meet(shapes[i], shapes[j], stroke, filled):
                _join(owner, i, j)
    groups: dict[int, list[int]] = {}
    for i in range(len(parts)):
        groups.setdefault(_root(owner, i), []).append(i)
    found = [tuple(group) for group in groups.values()]
    return found if len(found) <= MAX_PIECES else [tuple(range(len(parts)))]


def _shape(points: Float[np.ndarray, "n 2"], filled: bool) -> Any:
    import shapely

    if filled and len(points) >= 3:
        return shapely.make_valid(shapely.polygons(points))
    return shapely.linestrings(np.repeat(points, 2, axis=0) if len(points) == 1 else points)


def _join_holes(owner: list[int], shapes: list[Any], turn: list[int], rule: str) -> None:
    """Join each outline that lies in painted area with the nearest one around it."""
    import shapely

    for i, shape in enumerate(shapes):
        around = [j for j in range(len(shapes)) if j != i and _holds(shapes[j], shape, j < i)]
        inside = len(around) % 2 if rule == "evenodd" else sum(turn[j] for j in around)
        if inside:
            _join(owner, i, min(around, key=lambda j: float(shapely.area(shapes[j]))))


def _meet(a: Any, b: Any, stroke: float, filled: bool) -> bool:
    """Whether two outlines paint the same place, other than one in a hole of the other."""
    import shapely

    lines = [shapely.boundary(shape) if filled else shape for shape in (a, b)]
    if stroke > 0 and shapely.distance(*lines) < stroke:
        return True
    if not filled:
        return False
    return bool(shapely.intersects(a, b) and not _holds(a, b) and not _holds(b, a))


def _holds(outer: Any, inner: Any, equal: bool = False) -> bool:
    import shapely

    if shapely.equals(outer, inner):
        return equal
    return bool(shapely.contains(outer, inner))


def _turn(points: Float[np.ndarray, "n 2"]) -> int:
    x, y = points[:, 0], points[:, 1]
    area = float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())
    return int(np.sign(area))


def _root(owner: list[int], i: int) -> int:
    while owner[i] != i:
        i = owner[i]
    return i


def _join(owner: list[int], i: int, j: int) -> None:
    a, b = sorted((_root(owner, i), _root(owner, j)))
    owner[b] = a


def _spans(d: str) -> list[str]:
    """The text of each outline, made to stand alone; empty where the grammar is broken."""
    out: list[str] = []
    at, command, x, y, first = 0, "", 0.0, 0.0, (0.0, 0.0)
    closed = False
    end = len(d.rstrip())
    while at < end:
        found = _COMMAND.match(d, at)
        here = at
        if found:
            command, at = found[1], found.end()
        elif command in "Zz":
            return []
        if not out and command not in "Mm":
            return []
        numbers, at = _arguments(d, at, command.upper())
        if numbers is None:
            return []
        x0, y0 = x, y
        x, y = _move(command, numbers, x, y, first)
        if command in "Mm":
            first = (x, y)
            out.append(f"M{x:.10g} {y:.10g}")
            command = "l" if command == "m" else "L"
            closed = False
            if not _COMMAND.match(d, at) and at < end:
                out[-1] += command  # the numbers that follow a move are lines
            continue
        if closed:
            out.append(f"M{x0:.10g} {y0:.10g}")
            closed = False
        out[-1] += d[here:at]
        closed = command in "Zz"
    return out


def _arguments(d: str, at: int, command: str) -> tuple[list[float] | None, int]:
    numbers: list[float] = []
    for k in range(_COUNT[command]):
        found = (_FLAG if command == "A" and k in (3, 4) else _NUMBER).match(d, at)
        if not found:
            return None, at
        numbers.append(float(found[1]))
        at = found.end()
    return numbers, at


def _move(command: str, v: list[float], x: float, y: float, first: tuple[float, float]) -> tuple[float, float]:
    """Where the pen is after a command."""
    kind, base = command.upper(), (x, y) if command.islower() else (0.0, 0.0)
    if kind == "Z":
        return first
    if kind == "H":
        return base[0] + v[0], y
    if kind == "V":
        return x, base[1] + v[0]
    return base[0] + v[-2], base[1] + v[-1]


def _flatten(text: str) -> Float[np.ndarray, "n 2"]:
    import svgelements

    points: list[tuple[float, float]] = []
    if max((abs(float(v)) for v in re.findall(NUMBER, text)), default=0.0) > MAX_COORDINATE:
        raise ValueError("too large")
    steps = np.linspace(0.0, 1.0, STEPS + 1)[1:]
    for segment in svgelements.Path(text):
        if isinstance(segment, svgelements.Line | svgelements.Close | svgelements.Move):
            if segment.end is not None:
                points.append((segment.end.x, segment.end.y))
        else:
            points += [(float(p[0]), float(p[1])) for p in segment.npoint(steps)]
    out = np.array(points or [(0.0, 0.0)])
    keep = np.append(True, (np.diff(out, axis=0) != 0).any(axis=1))
    return np.asarray(out[keep])
