"""How sure a mean over cases is: percentile bootstrap, seeded, the same draws for every method."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from jaxtyping import Float, Int

SEED = 20240
"""Seed of the draws; a run's `run.json` records it."""

DRAWS = 4000
"""How often the cases are drawn anew."""

LEVEL = 0.95
"""Share of the draws that lies in an interval."""


@dataclass(frozen=True)
class Figure:
    """A number measured over cases, and the interval that 95 % of bootstrap draws give."""

    mean: float
    low: float
    high: float

    def text(self, style: str) -> str:
        """The mean with its interval, e.g. "0.119 [0.085, 0.160]"."""
        return f"{self.mean:{style}} [{self.low:{style}}, {self.high:{style}}]"


def mean_over_cases(values: Sequence[float]) -> Figure | None:
    """The mean and its interval; None where there is no value."""
    if not values:
        return None
    numbers = np.asarray(values, dtype=np.float64)
    return _figure(float(numbers.mean()), numbers[_draws(len(numbers))].mean(axis=1))


def ratio_of_means(values: Sequence[float], others: Sequence[float]) -> Figure | None:
    """Mean of `values` / mean of `others`, drawn case by case together; None where that is not defined."""
    if not values or len(values) != len(others) or sum(others) == 0:
        return None
    a, b = np.asarray(values, dtype=np.float64), np.asarray(others, dtype=np.float64)
    draws = _draws(len(a))
    below = b[draws].mean(axis=1)
    ratios = a[draws].mean(axis=1)[below > 0] / below[below > 0]
    return _figure(float(a.mean() / b.mean()), ratios)


def _figure(mean: float, drawn: Float[np.ndarray, " d"]) -> Figure:
    tail = (1.0 - LEVEL) / 2
    low, high = np.quantile(drawn, (tail, 1.0 - tail))
    return Figure(mean, float(low), float(high))


@cache
def _draws(count: int) -> Int[np.ndarray, "d n"]:
    return np.random.default_rng(SEED).integers(0, count, (DRAWS, count))
