"""The scene as a language model reads it (paper, "Large Language Model for Primary Constraints").

Each segment with its label, the four corners of its box and what it is connected to. As in the paper, outlines are left
out, unless the model is asked to guess motions: it guesses those well only where it can see the shapes.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from jaxtyping import Float

from iconjax.scene.labels import split_name
from iconjax.scene.types import Scene, Segment

Connections = Sequence[tuple[str, str, str]]
"""Pairs of segments that are connected: name, how ("touches" or "lies in"), name."""
Box = tuple[float, float, float, float]
MOST_VERTICES = 24


def describe_scene(scene: Scene, connections: Connections, outlines: bool = False) -> str:
    """The scene as text, in whole pixels."""
    lines = [describe_boxes((scene.width, scene.height), {s.name: s.box for s in scene.segments}, connections)]
    if outlines:
        lines.append("Outlines, simplified (x,y vertices in order; a segment may have several pieces):")
        for s in scene.segments:
            pieces = " | ".join(" ".join(f"{x:.0f},{y:.0f}" for x, y in piece) for piece in outline_vertices(s))
            lines.append(f"- {_quoted(s.name)}: {pieces}")
    return "\n".join(lines)


def describe_boxes(size: tuple[int, int], boxes: Mapping[str, Box], connections: Connections) -> str:
    """A picture of this width and height with its segments as text."""
    lines = [f"Picture: {size[0]} x {size[1]} pixels.", "Segments (label: corners of its bounding box):"]
    lines += [f"- {_quoted(name)}: {_corners(box)}" for name, box in boxes.items()]
    parts = [name for name, count in Counter(split_name(n)[0] for n in boxes).items() if count > 1]
    if parts:
        lines.append("Objects of several parts, which may be named as a whole: " + ", ".join(map(_quoted, parts)))
    lines.append("Connections:" if connections else "Connections: none")
    lines += [f"- {_quoted(a)} {how} {_quoted(b)}" for a, how, b in connections]
    return "\n".join(lines)


def outline_vertices(segment: Segment, at_most: int = MOST_VERTICES) -> list[Float[np.ndarray, "_ 2"]]:
    """The outer outline of a segment with at most so many vertices in all (Douglas-Peucker), one array a piece.

    Pieces that there are no three vertices for are left out, the smallest first.
    """
    from skimage import measure

    simplify: Any = measure.approximate_polygon

    loops = sorted(segment.loops, key=_area, reverse=True)[: max(1, at_most // 3)]
    closed = [np.concatenate([loop, loop[:1]]) for loop in loops]
    tolerance, pieces = 0.75, [loop[:-1] for loop in closed]
    while sum(map(len, pieces)) > at_most:
        pieces = [_open(simplify(loop, tolerance)) for loop in closed]
        if tolerance > 2000:  # each piece is down to its least by then
            break
        tolerance *= 1.3
    return pieces


def _open(polygon: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, "m 2"]:
    """Without the repeated first vertex; what fell into a line becomes its box, so that it keeps an extent."""
    vertices = polygon[:-1]
    if len(vertices) >= 3:
        return vertices
    (x0, y0), (x1, y1) = polygon.min(0), polygon.max(0)
    return np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])[:3]


def _area(loop: Float[np.ndarray, "n 2"]) -> float:
    x, y = loop.T
    return float(abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))) / 2


def _corners(box: Box) -> str:
    x0, y0, x1, y1 = (round(v) for v in box)
    return f"({x0}, {y0}) ({x1}, {y0}) ({x1}, {y1}) ({x0}, {y1})"


def _quoted(name: str) -> str:
    """A label as a JSON string: labels come from outside and may hold anything printable."""
    return json.dumps(name, ensure_ascii=False)
