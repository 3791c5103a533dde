"""The batches of candidates that the default search of a case really solves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter
from typing import Any

from iconjax.dsl.parse import parse
from iconjax.scene.build import build_scene
from iconjax.scene.load import load_case
from iconjax.search.coherent import CoherentSearch
from iconjax.search.config import SearchConfig
from iconjax.search.setup import Setup, prepare
from iconjax.solve.arrays import Candidate, Solution
from iconjax.solve.engine import Engine

BENCHMARK = Path(__file__).parents[1] / "benchmark"


@dataclass
class RecordingEngine(Engine):
    """An engine that remembers what it was asked to solve."""

    batches: list[Sequence[Candidate]] = field(default_factory=list, init=False)

    def solve(self, candidates: Sequence[Any]) -> Solution:
        """Solve, and keep the list."""
        self.batches.append(list(candidates))
        return super().solve(candidates)


@dataclass(frozen=True)
class Captured:
    """One search and what it solved.

    Attributes:
        name: the case.
        setup: the prepared search.
        batches: candidates of each round.
        seconds: the search without compiling, and `prepare` in it.
        solve_seconds: spent inside executables.
        compile_seconds: spent to get executables.
    """

    name: str
    setup: Setup
    batches: tuple[Sequence[Candidate], ...]
    seconds: float
    solve_seconds: float
    compile_seconds: float

    @property
    def candidates(self) -> list[Candidate]:
        """All candidates, round after round."""
        return [c for batch in self.batches for c in batch]


def recorded_search(setup: Setup, config: SearchConfig) -> tuple[CoherentSearch, RecordingEngine]:
    """A search of `setup` with a recording engine in it."""
    search = CoherentSearch(setup, config)
    engine = RecordingEngine(setup.problem, setup.table, setup.compiled.wide, config.solver or "irls")
    search.engine = engine
    return search, engine


def capture(name: str) -> Captured:
    """Run the default search of a benchmark case with its reference program."""
    case = load_case(BENCHMARK / name)
    scene = build_scene(case.image, case.segmentation)
    config = SearchConfig()
    begin = perf_counter()
    setup = prepare(scene, parse(case.program or "", scene.names, scene.objects), config)
    search, engine = recorded_search(setup, config)
    search.run()
    seconds = perf_counter() - begin - engine.compile_seconds
    return Captured(name, setup, tuple(engine.batches), seconds, engine.solve_seconds, engine.compile_seconds)
