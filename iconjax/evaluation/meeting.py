"""Where two things met before the edit, and how far an edit pulls the two ends of that meeting apart."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from jaxtyping import Float

from iconjax.evaluation.affine import apply
from iconjax.evaluation.stage import Part, Shape

GROWN = 3.0
"""By how much outlines are grown to find where they meet; bridges a thin gap between them."""


@dataclass(frozen=True)
class Meeting:
    """Two parts and the place where they met before the edit.

    Attributes:
        a, b: the parts.
        place: (2,) middle of the meeting before the edit.
        area: size of the overlap of their grown outlines; 0 where even those are apart.
    """

    a: Part
    b: Part
    place: Float[np.ndarray, " 2"]
    area: float

    @property
    def gap(self) -> float:
        """How far apart the two carry the point where they met."""
        ends = [apply(part.matrix, self.place[None])[0] for part in (self.a, self.b)]
        return float(np.linalg.norm(ends[0] - ends[1]))


def meeting(a: Shape, b: Shape) -> Meeting:
    """The pair of parts, one of each shape, that meet most (or, where none meet, that lie nearest)."""
    grown = {part.name: part.before.buffer(GROWN) for part in (*a.parts, *b.parts)}
    meetings = []
    for first in a.parts:
        for second in b.parts:
            common = shapely.intersection(grown[first.name], grown[second.name])
            if common.area > 0:
                place = shapely.get_coordinates(common.centroid)[0]
                meetings.append(Meeting(first, second, place, float(common.area)))
    if meetings:
        return max(meetings, key=lambda m: m.area)
    pairs = [(first, second) for first in a.parts for second in b.parts]
    first, second = min(pairs, key=lambda pair: shapely.distance(pair[0].before, pair[1].before))
    bridge = shapely.get_coordinates(shapely.shortest_line(first.before, second.before))
    return Meeting(first, second, bridge.mean(axis=0), 0.0)
