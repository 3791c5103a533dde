"""Candidate solves per second: the engine against one candidate at a time.

    python eval/perf/throughput.py [CASE ...]

All figures of a table come from one run, so that their ratios hold on a busy machine too. Eager figures are
extrapolated from a few evaluations (see the printed note). Compiled solvers go to a temporary folder.
"""

from __future__ import annotations

import os
import resource
import tempfile
from dataclasses import dataclass
from statistics import median
from time import perf_counter
from typing import Any

import click

CASES = ("umbrella-45", "ferris-wheel-turn", "drink-beside-burger")


@dataclass(frozen=True)
class Measured:
    """One case. Rates are candidates per second; `*_cost` are the final losses of the compared candidates."""

    name: str
    candidates: int
    rounds: int
    cold: float
    from_disk: float
    search: float
    solve: float
    engine: float
    adam_eager: float
    adam_jitted: float
    lbfgs_eager: float
    lbfgs_jitted: float
    evaluations: float
    engine_as_good: float
    lbfgs_as_good: float


def engine_rate(captured: Any, repeats: int) -> tuple[float, Any]:
    """Median rate of solving all recorded batches again, and the losses."""
    import numpy as np

    engine = captured.setup.engine("irls")
    seconds = []
    for _ in range(repeats):
        begin = perf_counter()
        loss = [engine.solve(b).loss for b in captured.batches]
        seconds.append(perf_counter() - begin)
    return len(captured.candidates) / median(seconds), np.concatenate(loss)


def load_seconds(captured: Any) -> float:
    """Seconds to read this case's executables from the disk cache: memory is emptied first."""
    from iconjax.solve import cache

    cache._memory.clear()
    engine = captured.setup.engine("irls")
    for batch in captured.batches:
        engine.solve(batch)
    return float(engine.compile_seconds)


def measure(name: str, sample: int, steps: int, repeats: int) -> tuple[Measured, float]:
    """Everything about one case, and the process's peak memory in MiB before the baselines ran."""
    import jax
    import numpy as np
    from baselines import adam_steps, eager_loss, jitted_loss, lbfgsb
    from capture import capture

    from iconjax.solve.cache import precise_cpu
    from iconjax.solve.methods import ITERATIONS
    from iconjax.solve.objective import SHARP

    captured = capture(name)
    from_disk = load_seconds(captured)
    rate, losses = engine_rate(captured, repeats)
    memory = peak()
    # Only the first round: all its candidates have equal shapes.
    first = captured.batches[0]
    picked = np.unique(np.linspace(0, len(first) - 1, min(sample, len(first))).astype(int))
    with precise_cpu():
        jitted = jitted_loss(captured.setup, first[0])
        adam_steps(jitted, first[0], 2)
        adam = [adam_steps(jitted, first[k], ITERATIONS) for k in picked[:2]]
        found = [lbfgsb(jitted, first[k]) for k in picked]
        sharp = [float(jitted.call(first[k], z, SHARP)[0]) for k, (z, _, _) in zip(picked, found, strict=True)]
        with jax.disable_jit():
            eager = eager_loss(captured.setup)
            adam_steps(eager, first[0], 1)  # fills JAX's caches of single operations
            step = adam_steps(eager, first[picked[-1]], steps) / steps
    best = np.minimum(sharp, losses[picked])
    evaluations = float(np.mean([n for _, n, _ in found]))
    return Measured(
        name, len(captured.candidates), len(captured.batches), captured.compile_seconds, from_disk, captured.seconds,
        captured.solve_seconds, rate, 1 / (ITERATIONS * step), len(adam) / sum(adam), 1 / (evaluations * step),
        len(found) / sum(s for _, _, s in found), evaluations, as_good(losses[picked], best), as_good(sharp, best),
    ), memory  # fmt: skip


def as_good(losses: Any, best: Any) -> float:
    """Share of losses within 1 % of the better of both methods."""
    import numpy as np

    return float(np.mean(np.asarray(losses) <= best + 0.01 * (1 + best)))


def peak() -> float:
    """Peak memory of this process, MiB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def show(rows: list[Measured]) -> None:
    click.echo("\ncandidates per second (in brackets: how many times slower than the engine)\n")
    click.echo("| case | candidates | engine | eager Adam | eager L-BFGS-B | jitted Adam | jitted L-BFGS-B |")
    click.echo("| --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    for m in rows:
        rates = (m.adam_eager, m.lbfgs_eager, m.adam_jitted, m.lbfgs_jitted)
        cells = " | ".join(f"{r:.3g} ({m.engine / r:,.0f}x)" for r in rates)
        click.echo(f"| {m.name} | {m.candidates} in {m.rounds} | {m.engine:.0f} | {cells} |")
    click.echo("\nseconds of the search, and whose minimum is within 1 % of the better one\n")
    click.echo("| case | compile | load | search | in solver | compiling, cold | loading, warm | engine | L-BFGS-B |")
    click.echo("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for m in rows:
        click.echo(
            f"| {m.name} | {m.cold:.1f} | {m.from_disk:.2f} | {m.search:.2f} | {m.solve:.2f} "
            f"| {m.cold / (m.cold + m.search):.0%} | {m.from_disk / (m.from_disk + m.search):.0%} "
            f"| {m.engine_as_good:.0%} | {m.lbfgs_as_good:.0%} |"
        )


@click.command(help=__doc__)
@click.argument("cases", nargs=-1)
@click.option("--sample", default=4, show_default=True, help="Candidates of each case for jitted L-BFGS-B.")
@click.option("--steps", default=4, show_default=True, help="Eager steps that are timed for each case.")
@click.option("--repeats", default=3, show_default=True, help="Times the engine solves each case again.")
def main(cases: tuple[str, ...], sample: int, steps: int, repeats: int) -> None:
    with tempfile.TemporaryDirectory() as folder:
        os.environ["ICONJAX_CACHE"] = folder
        # SciPy hands vectors of 40 numbers to a threaded BLAS; waiting for threads would take most of its time.
        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
        rows, before_baselines = [], 0.0
        for name in cases or CASES:
            begin = perf_counter()
            measured, memory = measure(name, sample, steps, repeats)
            before_baselines = before_baselines or memory
            rows.append(measured)
            click.echo(f"{name}: {perf_counter() - begin:.0f} s", err=True)
    show(rows)
    click.echo(
        f"\nEager figures: {steps} evaluations timed, times 150 steps for Adam, times the evaluations that the jitted "
        f"run\nneeded for L-BFGS-B ({', '.join(f'{m.evaluations:.0f}' for m in rows)}). "
        "Compile of 0.0: an earlier case had the same static sizes."
    )
    click.echo(f"Peak memory: {before_baselines:.0f} MiB after the first case's search, {peak():.0f} MiB at the end.")


if __name__ == "__main__":
    main()
