"""Settings of a search."""

from __future__ import annotations

from dataclasses import dataclass, field

from iconjax.errors import ConfigError
from iconjax.search.weights import Costs, Forces

STRATEGIES = ("coherent", "paper")


@dataclass(frozen=True)
class SearchConfig:
    """How to search.

    Attributes:
        strategy: "coherent" (the default: least change first, explicit coherence cost) or "paper" (its algorithm).
        relation_search, motion_search: switch either off (the paper's ablation).
        solver: registered method that minimises a candidate's loss; "" for the strategy's own.
        rounds: most rounds of flips.
        beam: candidates that are developed further in each round.
        batch: most candidates a round.
        forces, costs: weights of the default strategy.
    """

    strategy: str = "coherent"
    relation_search: bool = True
    motion_search: bool = True
    solver: str = ""
    rounds: int = 6
    beam: int = 3
    batch: int = 64
    forces: Forces = field(default_factory=Forces)
    costs: Costs = field(default_factory=Costs)

    def __post_init__(self) -> None:
        """Check the values.

        Raises:
            ConfigError: a value that is not allowed.
        """
        if self.strategy not in STRATEGIES:
            raise ConfigError(f"unknown strategy {self.strategy!r}: choose one of {', '.join(STRATEGIES)}")
        for name in ("rounds", "beam", "batch"):
            value = getattr(self, name)
            if not isinstance(value, int) or not 1 <= value <= 4096:
                raise ConfigError(f"{name} must be a whole number from 1 to 4096, not {value!r}")
