"""Compare the registered solvers on the candidates that the default search begins with, and print the table.

    python eval/solvers.py eval/benchmark --case telescope-level --case umbrella-45

Every method minimises the same loss of the same candidates, in the same batches. A candidate is feasible when
at least one method meets its primary constraints. No compiled solver is taken from the cache.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

import click
import numpy as np

MET_PX = 0.4
"""A primary residual above this many pixels is a constraint not met, as inside the search."""
CLOSE = 0.01
"""A loss within this share of the best method's is as good."""


@dataclass(frozen=True)
class Work:
    """The first round of one case: its prepared search and the candidates."""

    name: str
    setup: Any
    candidates: Sequence[Any]


@dataclass(frozen=True)
class Solved:
    """What one method made of all candidates, one after the other, and what it took."""

    method: str
    met: Any
    loss: Any
    seconds: float
    compile_seconds: tuple[float, ...]


class _FirstRound(Exception):
    """Carries the candidates of a search's first round out of it."""


class _Recorder:
    compile_seconds = 0.0

    def solve(self, candidates: Sequence[Any]) -> NoReturn:
        raise _FirstRound(candidates)


def first_round(folder: Path, most: int) -> Work:
    """The candidates that the default search of a case solves first, `most` at most (spread evenly)."""
    from iconjax.dsl.parse import parse
    from iconjax.scene.build import build_scene
    from iconjax.scene.load import load_case
    from iconjax.search.coherent import CoherentSearch
    from iconjax.search.config import SearchConfig
    from iconjax.search.setup import prepare

    case = load_case(folder)
    scene = build_scene(case.image, case.segmentation)
    config = SearchConfig()
    setup = prepare(scene, parse(case.program or "", scene.names, scene.objects), config)
    search = CoherentSearch(setup, config)
    search.engine = _Recorder()  # type: ignore[assignment]
    try:
        search.run()
    except _FirstRound as found:
        candidates = found.args[0]
    picked = np.unique(np.linspace(0, len(candidates) - 1, min(most, len(candidates))).astype(int))
    return Work(case.id, setup, [candidates[k] for k in picked])


def solve_all(method: str, work: Sequence[Work]) -> Solved:
    """Solve every case with one method; the time is that of the second run, when everything is compiled."""
    met, loss, seconds, compiling = [], [], 0.0, []
    for item in work:
        engine = item.setup.engine(method)
        engine.solve(item.candidates[:1])
        if engine.compile_seconds > 0.1:
            compiling.append(engine.compile_seconds)
        engine.solve_seconds = 0.0
        found = engine.solve(item.candidates)
        seconds += engine.solve_seconds
        limit = MET_PX * item.setup.setting.size / 512
        met.append((np.abs(found.primary) <= limit).all(1))
        loss.append(np.where(np.isfinite(found.loss), found.loss, np.inf))
    return Solved(method, np.concatenate(met), np.concatenate(loss), seconds, tuple(compiling))


def table(solved: Sequence[Solved]) -> str:
    """The table in Markdown."""
    feasible = np.any([s.met for s in solved], axis=0)
    best = np.min([np.where(s.met, s.loss, np.inf) for s in solved], axis=0)[feasible]
    lines = [
        f"{len(feasible)} candidates, {int(feasible.sum())} of them feasible",
        "",
        "| method | met | met of feasible | within 1 % of best | mean excess loss | candidates/s | compile s |",
        "| --- | ---: | ---: | ---: | ---: | ---: | ---: |",
    ]
    for s in solved:
        excess = (s.loss[feasible] - best) / (1 + best)
        close = float((excess <= CLOSE).mean())
        mean = float(np.minimum(excess, 1.0).mean())
        rate = len(feasible) / s.seconds
        compiling = float(np.mean(s.compile_seconds)) if s.compile_seconds else 0.0
        lines.append(
            f"| {s.method} | {s.met.mean():.3f} | {s.met[feasible].mean():.3f} "
            f"| {close:.3f} | {mean:.3f} | {rate:.1f} | {compiling:.0f} |"
        )
    return "\n".join(lines)


@click.command(help=__doc__)
@click.argument("folder", type=click.Path(exists=True, file_okay=False, path_type=Path))
@click.option("--case", "cases", multiple=True, metavar="ID", help="Only this case; may be given several times.")
@click.option("--method", "methods", multiple=True, metavar="NAME", help="May be given several times; all by default.")
@click.option("--most", default=32, show_default=True, help="Candidates of each case.")
def main(folder: Path, cases: tuple[str, ...], methods: tuple[str, ...], most: int) -> None:
    os.environ["ICONJAX_CACHE"] = ""
    from iconjax.solve.methods import METHODS

    folders = [folder / c for c in cases] or sorted(p for p in folder.iterdir() if (p / "program.txt").exists())
    work = [first_round(f, most) for f in folders]
    solved = []
    for name in methods or tuple(METHODS):
        click.echo(f"{name} ...", err=True)
        solved.append(solve_all(name, work))
    click.echo(table(solved))


if __name__ == "__main__":
    main()
