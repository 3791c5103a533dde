"""What the translator needs to know of the shapes behind names: boxes, and which way a thing is long."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from iconjax.language.hearing import label_words
from iconjax.language.lexicon import lexicon
from iconjax.scene.sampling import elongation, principal_axis
from iconjax.scene.types import Scene, Segment

OBLIQUE_DEGREES = 15.0
ELONGATED = 1.8
SLENDER = 4.0
ROUND = 1.1
END_SHARE = 0.05
Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class Shapes:
    """Geometry of a scene by name."""

    scene: Scene

    def segments(self, name: str) -> tuple[Segment, ...]:
        """Segments a name speaks of; none for the canvas."""
        return tuple(self.scene.segments[i] for i in self.scene.members(name))

    def box(self, name: str) -> Box:
        """(min x, min y, max x, max y) in pixels."""
        boxes = [s.box for s in self.segments(name)]
        if not boxes:
            return (0.0, 0.0, float(self.scene.width), float(self.scene.height))
        low = np.min(boxes, axis=0)
        high = np.max(boxes, axis=0)
        return (float(low[0]), float(low[1]), float(high[2]), float(high[3]))

    def size(self, name: str) -> tuple[float, float]:
        """Width and height of the box."""
        x0, y0, x1, y1 = self.box(name)
        return x1 - x0, y1 - y0

    def centre(self, name: str) -> tuple[float, float]:
        """Centre of the box."""
        x0, y0, x1, y1 = self.box(name)
        return (x0 + x1) / 2, (y0 + y1) / 2

    def oblique(self, name: str, degrees: float = OBLIQUE_DEGREES) -> bool:
        """Whether the thing is long and stands askew, so that its length is not that of its box."""
        loops = tuple(loop for s in self.segments(name) for loop in s.loops)
        if not loops or elongation(loops) < ELONGATED:
            return False
        x, y = np.abs(principal_axis(loops))
        return bool(min(math.degrees(math.atan2(y, x)), math.degrees(math.atan2(x, y))) > degrees)

    def round(self, name: str) -> bool:
        """Whether the thing is about as long as it is broad, so that "level" says nothing of it."""
        loops = tuple(loop for s in self.segments(name) for loop in s.loops)
        return bool(loops) and elongation(loops) < ROUND

    def slender(self, name: str) -> bool:
        """Whether the thing is so long that to halve it is to halve its length."""
        loops = tuple(loop for s in self.segments(name) for loop in s.loops)
        return bool(loops) and elongation(loops) > SLENDER

    def extent(self, name: str, dim: str, turns: bool = False) -> str:
        """The attribute that an everyday dimension means for this thing, e.g. "vert_len".

        `dim` is vert, hori, length, thick, or short ("shorter": the height of what stands). Where a long thing
        turns as well, the box says nothing of its length.
        """
        if dim in ("vert", "hori"):
            return f"{dim}_len"
        if self.oblique(name) or (turns and self.slender(name)):
            return "short_len" if dim == "thick" else "long_len"
        wide, high = self.size(name)
        if dim == "thick":
            # "thin" says little of a round thing; people mean its width then
            return "vert_len" if wide > 1.25 * high else "hori_len"
        if dim in ("length", "short") and wide < 2 * high and stands(name):
            return "vert_len"  # legs are as long as they are high
        upright = high > wide * (1.0 if dim == "length" else 0.9)
        return "vert_len" if upright else "hori_len"

    def part_of(self, inner: str, outer: str) -> bool:
        """Whether one thing is a true part of the other."""
        a, b = ({s.id for s in self.segments(n)} for n in (inner, outer))
        return bool(a) and a < b

    def lies(self, name: str, relation: str, other: str) -> bool:
        """Whether two boxes are, roughly, already in a relation (on, inside, beside, touch)."""
        near = 0.05 * self.scene.size
        gaps = self.axis_gap(name, other, 0), self.axis_gap(name, other, 1)
        if relation == "inside":
            (x, y), (x0, y0, x1, y1) = self.centre(name), self.box(other)
            return x0 <= x <= x1 and y0 <= y <= y1
        if relation == "on":
            return gaps[0] < 0 and gaps[1] < near and self.centre(name)[1] < self.centre(other)[1]
        if relation in ("above", "below", "left_of", "right_of"):
            axis = 1 if relation in ("above", "below") else 0
            sign = 1 if relation in ("above", "left_of") else -1
            ahead = sign * (self.centre(other)[axis] - self.centre(name)[axis]) > 0
            return ahead and gaps[axis] > -near and gaps[1 - axis] < 0
        return max(gaps) < (near if relation == "touch" else 4 * near)

    def axis_gap(self, a: str, b: str, axis: int) -> float:
        """Gap between two boxes along an axis (0 is x); negative where they overlap."""
        one, two = self.box(a), self.box(b)
        return max(two[axis] - one[axis + 2], one[axis] - two[axis + 2])

    def end(self, name: str, side: str) -> tuple[float, float]:
        """The middle of what of a thing lies at one side (top, bottom, left, right): its foot, its tip."""
        points = np.concatenate([_dense(loop, 0.01 * self.scene.size) for s in self.segments(name) for loop in s.loops])
        along = points[:, 0 if side in ("left", "right") else 1] * (1 if side in ("left", "top") else -1)
        near = points[along <= along.min() + END_SHARE * np.ptp(along)]
        x, y = (near.min(0) + near.max(0)) / 2
        extreme = {"left": 0, "top": 1, "right": 2, "bottom": 3}[side]
        edge = self.box(name)[extreme]
        return (edge, float(y)) if side in ("left", "right") else (float(x), edge)

    def pivot(self, name: str, other: str | None = None) -> tuple[float, float]:
        """Where the thing most likely turns: its point nearest to `other`, or to the rest of its object."""
        own = self.segments(name)
        ids = {s.id for s in own}
        rest = (
            list(self.segments(other))
            if other
            else [s for s in self.scene.segments if s.object == own[0].object and s.id not in ids]
        )
        foreign = not rest
        rest = rest or [s for s in self.scene.segments if s.id not in ids]
        if not rest:
            return self.centre(name)
        if other is None and not foreign:
            rest = [max(rest, key=lambda s: s.area)]
        points = np.concatenate([_dense(loop, 0.01 * self.scene.size) for s in own for loop in s.loops])
        others = np.concatenate([_dense(loop, 0.01 * self.scene.size) for s in rest for loop in s.loops])
        gaps = np.linalg.norm(points[:, None] - others[None], axis=2).min(1)
        near = points[gaps <= gaps.min() + 0.02 * self.scene.size]
        return float(near[:, 0].mean()), float(near[:, 1].mean())


def stands(name: str) -> bool:
    """Whether a thing by its name is one that stands or hangs upright: a leg, a post, a rope."""
    words = lexicon()
    return any(words.knows(w, {"upright_thing"}) for w in label_words(name, words))


def _dense(loop: Float[np.ndarray, "n 2"], step: float) -> Float[np.ndarray, "m 2"]:
    """The vertices of a closed loop with points between them, no further apart than `step` px."""
    ends = np.roll(loop, -1, 0)
    counts = np.maximum(1, np.ceil(np.linalg.norm(ends - loop, axis=1) / step).astype(int))
    shares = np.concatenate([np.arange(n) / n for n in counts])[:, None]
    return np.asarray(np.repeat(loop, counts, 0) * (1 - shares) + np.repeat(ends, counts, 0) * shares)
