"""Lengths, transforms and the view box of an SVG as numbers and 2x3 matrices."""

from __future__ import annotations

import math
import re

import numpy as np
from jaxtyping import Float

from iconjax.errors import InputError
from iconjax.scene.svg.limits import MAX_COORDINATE, MAX_SIDE
from iconjax.scene.svg.tree import Node

Matrix = Float[np.ndarray, "2 3"]

NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_LENGTH = re.compile(rf"\s*({NUMBER})\s*(px|in|cm|mm|pt|pc|em|rem|ex|Q|%)?\s*$")
_PX = {"": 1.0, "px": 1.0, "in": 96.0, "cm": 96 / 2.54, "mm": 96 / 25.4, "pt": 96 / 72, "pc": 16.0,
       "em": 16.0, "rem": 16.0, "ex": 8.0, "Q": 96 / 101.6}  # fmt: skip
_CALL = re.compile(r"\s*+,?+\s*+([A-Za-z]++)\s*+\(([^()]*+)\)\s*+,?+")
_NEXT = re.compile(rf"[\s,]*+({NUMBER})")
LONGEST = 64
"""Characters of the longest text that is looked at as one length."""
IDENTITY: Matrix = np.eye(2, 3)


def length(text: str) -> float | None:
    """A length in pixels; None for a percentage, and for what is no length."""
    found = _LENGTH.match(text) if len(text) <= LONGEST else None
    if not found or found[2] == "%":
        return None
    value = float(found[1]) * _PX[found[2] or ""]
    return value if math.isfinite(value) else None


def compose(outer: Matrix, inner: Matrix) -> Matrix:
    """The map that applies `inner` and then `outer`."""
    return np.column_stack([outer[:, :2] @ inner[:, :2], outer[:, :2] @ inner[:, 2] + outer[:, 2]])


def inverse(matrix: Matrix) -> Matrix | None:
    """The inverse map, or None where there is none."""
    linear = matrix[:, :2]
    det = linear[0, 0] * linear[1, 1] - linear[0, 1] * linear[1, 0]
    if not math.isfinite(det) or abs(det) < 1e-18:
        return None
    back = np.array([[linear[1, 1], -linear[0, 1]], [-linear[1, 0], linear[0, 0]]]) / det
    return np.column_stack([back, -back @ matrix[:, 2]])


def transform(text: str) -> Matrix | None:
    """The matrix of a `transform` attribute; None where it does not follow the grammar."""
    total, at, end = IDENTITY, 0, len(text.rstrip())
    while at < end:
        call = _CALL.match(text, at)
        step = None if call is None else _step(call[1], call[2])
        if call is None or step is None:
            return None
        total, at = compose(total, step), call.end()
    return total if np.isfinite(total).all() else None


def numbers(text: str) -> list[float]:
    """The numbers of a list separated by spaces and commas; none where something else is among them."""
    out, at, end = [], 0, len(text.rstrip())
    while at < end:
        found = _NEXT.match(text, at)
        if found is None:
            return []
        out.append(float(found[1]))
        at = found.end()
    return out


def _step(name: str, arguments: str) -> Matrix | None:
    v = numbers(arguments)
    if name == "matrix" and len(v) == 6:
        return np.array([[v[0], v[2], v[4]], [v[1], v[3], v[5]]])
    if name == "translate" and len(v) in (1, 2):
        return np.array([[1.0, 0.0, v[0]], [0.0, 1.0, v[1] if len(v) == 2 else 0.0]])
    if name == "scale" and len(v) in (1, 2):
        return np.array([[v[0], 0.0, 0.0], [0.0, v[-1], 0.0]])
    if name == "rotate" and len(v) in (1, 3):
        c, s = math.cos(math.radians(v[0])), math.sin(math.radians(v[0]))
        x, y = v[1:] or (0.0, 0.0)
        return np.array([[c, -s, x - c * x + s * y], [s, c, y - s * x - c * y]])
    if name == "skewX" and len(v) == 1:
        return np.array([[1.0, math.tan(math.radians(v[0])), 0.0], [0.0, 1.0, 0.0]])
    if name == "skewY" and len(v) == 1:
        return np.array([[1.0, 0.0, 0.0], [math.tan(math.radians(v[0])), 1.0, 0.0]])
    return None


def write_matrix(matrix: Matrix) -> str:
    """`matrix` as the value of a `transform` attribute, with seven digits and nine for the shift."""
    a, b, c, d = (_short(v, 7) for v in matrix[:, :2].T.ravel().tolist())
    x, y = (_short(v, 9) for v in matrix[:, 2].tolist())
    if (a, b, c, d) == ("1", "0", "0", "1"):
        return f"translate({x} {y})"
    return f"matrix({a} {b} {c} {d} {x} {y})"


def _short(value: float, digits: int) -> str:
    return f"{0.0 if abs(value) < 1e-9 else value:.{digits}g}"


class Viewport:
    """The root's size, its view box, and where they put the drawing on the raster.

    Attributes:
        size: width and height of the drawing in CSS pixels.
        box: the view box (x, y, width, height).
        raster: (width, height) of the raster in pixels.
        scale: raster pixels per CSS pixel.
        matrix: user units of the root to raster pixels.
        fit: `preserveAspectRatio` as written, "" where it is not.
    """

    def __init__(self, root: Node, side: int, what: str) -> None:
        if not 16 <= side <= MAX_SIDE:
            raise InputError(f"size is {side}: the raster of an SVG has 16 to {MAX_SIDE} pixels on its larger side")
        box = _view_box(root, what)
        self.size = _size(root, box, what)
        self.box = box or (0.0, 0.0, *self.size)
        self.fit = root.get("preserveAspectRatio")
        scale = side / max(self.size)
        self.raster = tuple(max(1, round(v * scale)) for v in self.size)
        if min(self.raster) * 64 < side:
            raise InputError(f"{what} is {self.size[0]:g} by {self.size[1]:g}: a picture so narrow is no icon")
        self.scale = scale
        onto = np.array([[scale, 0.0, 0.0], [0.0, scale, 0.0]])
        self.matrix = compose(onto, _fit(self.box, self.size, self.fit))


def _view_box(root: Node, what: str) -> tuple[float, float, float, float] | None:
    text = root.get("viewBox").strip()
    if not text:
        return None
    values = numbers(text)
    if len(values) != 4:
        raise InputError(f"{what} has the view box {text[:60]!r}: it has to be four numbers")
    if values[2] <= 0 or values[3] <= 0 or max(map(abs, values)) > MAX_COORDINATE or min(values[2:]) < 1e-4:
        raise InputError(f"{what} has the view box {text[:60]!r}: its size has to be from 0.0001 to {MAX_COORDINATE:g}")
    return values[0], values[1], values[2], values[3]


def _size(root: Node, box: tuple[float, ...] | None, what: str) -> tuple[float, float]:
    sides: list[float | None] = []
    for name in ("width", "height"):
        text = root.get(name).strip()
        value = length(text) if text else None
        if text and value is None and text != "auto" and not (text.endswith("%") and len(numbers(text[:-1])) == 1):
            raise InputError(f"{what} has the {name} {text[:40]!r}: it has to be a length")
        if value is not None and not 1e-4 <= value <= MAX_COORDINATE:
            raise InputError(f"{what} has the {name} {text[:40]!r}: it has to be from 0.0001 to {MAX_COORDINATE:g}")
        sides.append(value)
    width, height = sides
    if box is not None:
        width = width if width is not None else box[2] * (height / box[3] if height is not None else 1.0)
        height = height if height is not None else box[3] * (width / box[2] if sides[0] is not None else 1.0)
    if width is None or height is None:
        raise InputError(f"{what} says neither how large it is nor what it shows: add a viewBox to <svg>")
    return width, height


def _fit(box: tuple[float, float, float, float], size: tuple[float, float], fit: str) -> Matrix:
    sx, sy = size[0] / box[2], size[1] / box[3]
    words = fit.split() or ["xMidYMid"]
    shift = {"Min": 0.0, "Mid": 0.5, "Max": 1.0}
    place = re.fullmatch(r"x(Min|Mid|Max)Y(Min|Mid|Max)", words[0]) or re.fullmatch(r"x(Mid)Y(Mid)", "xMidYMid")
    x, y = 0.0, 0.0
    if words[0] != "none" and place is not None:
        sx = sy = max(sx, sy) if "slice" in words[1:] else min(sx, sy)
        x = (size[0] - box[2] * sx) * shift[place[1]]
        y = (size[1] - box[3] * sy) * shift[place[2]]
    return np.array([[sx, 0.0, x - box[0] * sx], [0.0, sy, y - box[1] * sy]])
