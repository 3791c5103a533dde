"""The registered methods that minimise a candidate's loss. One more is a function and a line in `METHODS`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from iconjax.errors import ConfigError
from iconjax.solve import adam, irls, library
from iconjax.solve.arrays import Candidate, Problem, Solution
from iconjax.solve.objective import Coherent, Flat, Objective
from iconjax.solve.table import OperatorTable
from iconjax.solve.violation import Choice, MeanViolation, Violations

ITERATIONS = 150
"""Most iterations of Adam (paper)."""


def _solve(
    minimise: Callable[[Objective], Flat],
    problem: Problem | Violations,
    cand: Candidate | Choice,
    table: OperatorTable,
    wide: bool = False,
) -> Solution:
    """Minimise whichever loss the problem calls for."""
    objective: Objective
    if isinstance(problem, Violations):
        assert isinstance(cand, Choice)
        objective = MeanViolation(problem, cand, table, wide)
    else:
        assert isinstance(cand, Candidate)
        objective = Coherent(problem, cand, table, wide)
    return objective.solution(minimise(objective))


METHODS: Mapping[str, Callable[..., Any]] = {
    "irls": irls.solve,
    "adam": partial(_solve, partial(adam.minimise, iterations=ITERATIONS)),
    "lbfgs": partial(_solve, library.lbfgs),
    "bfgs": partial(_solve, library.bfgs),
    "lm": partial(_solve, library.lm),
}
FOR_MEAN_VIOLATION = ("adam", "lbfgs", "bfgs")
"""Methods that need no more than a slope, and so can minimise the paper's loss too."""


def method(name: str, among: tuple[str, ...] = tuple(METHODS)) -> Callable[..., Any]:
    """The method called `name`: `(problem, candidate, *, table, wide) -> Solution`, pure.

    Raises:
        ConfigError: no such method, or none for this strategy; names those that exist.
    """
    if name not in among:
        known = "unknown solver" if name not in METHODS else "this strategy cannot use solver"
        raise ConfigError(f"{known} {name!r}: choose one of {', '.join(among)}")
    return METHODS[name]
