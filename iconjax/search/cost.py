"""The coherence cost of a solved candidate (contract, section 6): what following the request did to the picture."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from iconjax.search.candidate import Setting
from iconjax.search.cost_parts import asked_costs, idle_costs, odd_segments, unasked_costs
from iconjax.search.cost_relations import relation_costs
from iconjax.search.cost_scene import surrounding_costs
from iconjax.search.evidence import Case, Evidence
from iconjax.search.shapes import Shapes
from iconjax.search.state import State
from iconjax.search.weights import Costs

UNMET_PX = 0.4
"""A primary residual above this many pixels (at 512 x 512) is a constraint not met, inside the search."""
STRAINED = 0.05
"""A relation that costs more than this is under strain: the search flips what hangs on it."""


@dataclass(frozen=True)
class Judgement:
    """Cost of a candidate by term, and what became of each relation.

    Attributes:
        terms: cost by term; terms of zero are left out.
        outcomes: for each relation "ST", "WK", "N" or "F" as the result has it.
        strained: relations that cost something.
        unmet: whether a primary constraint fails.
        odd: segments that changed though nobody asked, those that changed the most first: distorted, turned, moved.
    """

    terms: Mapping[str, float]
    outcomes: tuple[str, ...]
    strained: tuple[int, ...]
    unmet: bool
    odd: tuple[int, ...] = ()

    @property
    def total(self) -> float:
        """The cost."""
        return sum(self.terms.values())


class Judge:
    """Judges candidates of one edit."""

    def __init__(self, setting: Setting, shapes: Shapes, costs: Costs) -> None:
        self.case = Case.of(setting, shapes, costs)

    def judge(self, state: State, matrices: Float[np.ndarray, "n 6"], primary: Float[np.ndarray, " c"]) -> Judgement:
        """Cost of the transforms `matrices` that a solve of `state` led to, with residuals `primary` in px."""
        e = Evidence.of(self.case, state, matrices)
        off = np.abs(primary) / self.case.unit
        unmet = float(off[off > UNMET_PX].sum())
        relations = relation_costs(e)
        terms: dict[str, float] = {}
        costs = self.case.costs
        for name, cost in (
            *((("unmet", costs.unmet + costs.unmet_px * unmet),) if unmet else ()),
            *((term, cost) for _, cost, term in relations),
            *unasked_costs(e),
            *idle_costs(e),
            *asked_costs(e),
            *surrounding_costs(e),
        ):
            if cost > 0:
                terms[name] = terms.get(name, 0.0) + float(cost)
        strained = tuple(k for k, (_, cost, _) in enumerate(relations) if cost > STRAINED)
        return Judgement(terms, tuple(o for o, _, _ in relations), strained, unmet > 0, odd_segments(e))
