"""The registered methods that minimise a candidate's loss. Adding one is a function and a line in `METHODS`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from iconjax.errors import ConfigError
from iconjax.solve import adam, irls, library
from iconjax.solve.arrays import Candidate, Problem, Solution
from iconjax.solve.objective import Coherent, Flat, Objective
from iconjax.solve.table import OperatorTable


def _solve(
    minimise: Callable[[Objective], Flat], problem: Problem, cand: Candidate, table: OperatorTable, wide: bool = False
) -> Solution:
    objective = Coherent(problem, cand, table, wide)
    return objective.solution(minimise(objective))


METHODS: Mapping[str, Callable[..., Any]] = {
    "irls": irls.solve,
    "adam": partial(_solve, partial(adam.minimise, iterations=150)),
    "lbfgs": partial(_solve, library.lbfgs),
    "bfgs": partial(_solve, library.bfgs),
    "lm": partial(_solve, library.lm),
}


def method(name: str) -> Callable[..., Any]:
    """The method called `name`: `(problem, candidate, *, table, wide) -> Solution`, pure.

    Raises:
        ConfigError: no such method; names those that exist.
    """
    if name not in METHODS:
        raise ConfigError(f"unknown solver {name!r}: choose one of {', '.join(METHODS)}")
    return METHODS[name]
