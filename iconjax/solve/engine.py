"""Solving batches of candidates: one compiled executable for each set of static sizes, a few threads."""

from __future__ import annotations

import os
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import jax
import numpy as np

from iconjax.solve.arrays import Candidate, Problem, Solution
from iconjax.solve.cache import compiled, precise_cpu
from iconjax.solve.methods import method
from iconjax.solve.table import OperatorTable
from iconjax.solve.violation import Choice, Violations

BATCH = 16
"""Candidates in one call of the executable; larger batches are cut up and shared out over threads."""
WORKERS = max(1, min(4, os.cpu_count() or 1))


@dataclass
class Engine:
    """Solves candidates of one problem.

    Attributes:
        problem: what all candidates share.
        table: operators that the problem's program refers to.
        wide: whether the program contains an intersection.
        solver: name of a registered method.
        batch: candidates in one call of the executable.
        compile_seconds, solve_seconds, solved: what it has spent and done so far.
    """

    problem: Problem | Violations
    table: OperatorTable
    wide: bool
    solver: str
    batch: int = BATCH
    compile_seconds: float = field(default=0.0, init=False)
    solve_seconds: float = field(default=0.0, init=False)
    solved: int = field(default=0, init=False)

    def solve(self, candidates: Sequence[Candidate] | Sequence[Choice]) -> Solution:
        """Solve all candidates (of equal static sizes) at once; arrays gain a leading axis."""
        if not candidates:
            raise ValueError("nothing to solve")
        with precise_cpu():
            chunks = [self._stack(candidates[k : k + self.batch]) for k in range(0, len(candidates), self.batch)]
            begin = time.perf_counter()
            executable, seconds = self._executable(chunks[0])
            self.compile_seconds += seconds
            run = partial(self._run, executable)
            if len(chunks) == 1:
                parts = [run(chunks[0])]
            else:
                with ThreadPoolExecutor(WORKERS) as pool:
                    parts = list(pool.map(run, chunks))
            self.solve_seconds += time.perf_counter() - begin - seconds
        self.solved += len(candidates)
        whole = jax.tree.map(lambda *x: np.concatenate(x)[: len(candidates)], *parts)
        return whole  # type: ignore[no-any-return]

    def _run(self, executable: Any, batch: Candidate | Choice) -> Solution:
        with precise_cpu():
            return jax.tree.map(np.asarray, executable(self.problem, batch))  # type: ignore[no-any-return]

    def _stack(self, candidates: Sequence[Candidate] | Sequence[Choice]) -> Candidate | Choice:
        padded = [*candidates, *[candidates[-1]] * (self.batch - len(candidates))]
        return jax.tree.map(lambda *x: np.stack(x), *padded)  # type: ignore[no-any-return]

    def _executable(self, batch: Candidate | Choice) -> tuple[Any, float]:
        solve_one = method(self.solver)

        def solve_batch(problem: Problem | Violations, candidates: Candidate | Choice) -> Solution:
            one = partial(solve_one, table=self.table, wide=self.wide)
            return jax.vmap(one, in_axes=(None, 0))(problem, candidates)  # type: ignore[no-any-return]

        name = f"{self.solver}|{self.wide}|{self.table.digest}"
        return compiled(name, solve_batch, (self.problem, batch))
