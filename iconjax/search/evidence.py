"""What the terms of the coherence cost are computed from."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from iconjax.search.candidate import Setting
from iconjax.search.facts import Facts
from iconjax.search.motion import STILL_PX, Motion, measure_motion
from iconjax.search.shapes import Shapes
from iconjax.search.state import State
from iconjax.search.weights import Costs

Terms = Iterator[tuple[str, float]]
"""Named costs; terms of one name add up."""


@dataclass(frozen=True)
class Case:
    """What all candidates of an edit are judged by.

    Attributes:
        setting, shapes, costs: the edit, its outlines, the weights.
        asked: kinds of motion asked of each segment.
        piece_area: share of the picture's segments that each connected piece takes.
    """

    setting: Setting
    shapes: Shapes
    costs: Costs
    asked: tuple[frozenset[str], ...]
    piece_area: dict[int, float]

    @classmethod
    def of(cls, setting: Setting, shapes: Shapes, costs: Costs) -> Case:
        """Gather what follows from the setting."""
        count = len(setting.facts.area)
        asked = tuple(frozenset(k for t in setting.intent.things_of(i) for k in t.kinds) for i in range(count))
        piece_area: dict[int, float] = {}
        for piece, area in zip(setting.pieces, setting.facts.area, strict=True):
            piece_area[piece] = piece_area.get(piece, 0.0) + float(area)
        return cls(setting, shapes, costs, asked, piece_area)

    @property
    def facts(self) -> Facts:
        """Facts about the unedited scene."""
        return self.setting.facts

    @property
    def unit(self) -> float:
        """One pixel at 512 x 512, in pixels of this picture."""
        return self.setting.size / 512

    @property
    def asked_segments(self) -> list[int]:
        """Segments of which some motion is asked."""
        return [i for i, kinds in enumerate(self.asked) if kinds]


@dataclass(frozen=True)
class Evidence:
    """A solved candidate, measured.

    Attributes:
        case: what it is judged by.
        state: its discrete states.
        matrices: (n, 6) transforms.
        motion: what they do.
        features: (n, 6) box features after the edit.
    """

    case: Case
    state: State
    matrices: Float[np.ndarray, "n 6"]
    motion: Motion
    features: Float[np.ndarray, "n 6"]

    @classmethod
    def of(cls, case: Case, state: State, matrices: Float[np.ndarray, "n 6"]) -> Evidence:
        """Measure a candidate."""
        motion = measure_motion(matrices, case.facts.features)
        return cls(case, state, matrices, motion, case.shapes.features(matrices))

    def moved(self, i: int) -> bool:
        """Whether segment `i` moved at all."""
        return bool(self.motion.shift[i] > STILL_PX * self.case.unit)

    def lifted(self, i: int) -> float:
        """How far the lower edge of segment `i` rose or sank, px at 512 x 512."""
        return float(abs(self.features[i, 5] - self.case.facts.features[i, 5])) / self.case.unit
