"""Where the time of a search goes: the parts of it, then the functions that take longest.

    python eval/perf/profile_case.py ferris-wheel-turn [CASE ...]

Solvers come from the cache as in any edit; compiling is not counted.
"""

from __future__ import annotations

import cProfile
import pstats
from collections.abc import Callable
from time import perf_counter
from typing import Any

import click


class Clock:
    """Adds up the seconds inside some functions."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}

    def watch(self, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        """`function`, timed under `name`."""

        def timed(*args: Any, **kwargs: Any) -> Any:
            begin = perf_counter()
            try:
                return function(*args, **kwargs)
            finally:
                self.seconds[name] = self.seconds.get(name, 0.0) + perf_counter() - begin

        return timed


def profile(name: str, top: int) -> None:
    """Print both tables of one case."""
    from capture import BENCHMARK, recorded_search

    from iconjax.dsl.parse import parse
    from iconjax.scene.build import build_scene
    from iconjax.scene.load import load_case
    from iconjax.search import coherent
    from iconjax.search.config import SearchConfig
    from iconjax.search.setup import prepare

    case = load_case(BENCHMARK / name)
    scene = build_scene(case.image, case.segmentation)
    program = parse(case.program or "", scene.names, scene.objects)
    recorded_search(prepare(scene, program, SearchConfig()), SearchConfig())[0].run()  # everything is compiled now
    clock, begin = Clock(), perf_counter()
    setup = prepare(scene, program, SearchConfig())
    clock.seconds["prepare"] = perf_counter() - begin
    search, engine = recorded_search(setup, SearchConfig())
    search.judge.judge = clock.watch("judge", search.judge.judge)  # type: ignore[method-assign]
    search._children = clock.watch("flips", search._children)  # type: ignore[method-assign]
    build, coherent.build_candidate = coherent.build_candidate, clock.watch("build", coherent.build_candidate)
    try:
        search.run()
    finally:
        coherent.build_candidate = build
    total = perf_counter() - begin
    clock.seconds["solve"] = engine.solve_seconds
    clock.seconds["rest"] = total - sum(clock.seconds.values())
    count = sum(map(len, engine.batches))
    padded = sum(-(-len(b) // engine.batch) * engine.batch for b in engine.batches)
    code = setup.problem.code
    click.echo(
        f"\n{name}: {total:.2f} s, {count} candidates in rounds of {', '.join(str(len(b)) for b in engine.batches)}"
    )
    click.echo(f"with padding {padded}; {int(code.leaves)} leaves and {int(code.steps)} steps in the program\n")
    click.echo("| part | seconds | share |\n| --- | ---: | ---: |")
    for part, seconds in sorted(clock.seconds.items(), key=lambda x: -x[1]):
        click.echo(f"| {part} | {seconds:.2f} | {seconds / total:.0%} |")
    functions(lambda: recorded_search(prepare(scene, program, SearchConfig()), SearchConfig())[0].run(), top)


def functions(run: Callable[[], Any], top: int) -> None:
    """The functions that `run` spends most time in."""
    profiler = cProfile.Profile()
    profiler.runcall(run)
    stats = pstats.Stats(profiler).get_stats_profile().func_profiles.items()
    click.echo("\n| function | calls | own seconds (with profiler) |\n| --- | ---: | ---: |")
    for name, entry in sorted(stats, key=lambda x: -x[1].tottime)[:top]:
        click.echo(f"| {name.replace('|', '')} | {entry.ncalls} | {entry.tottime:.2f} |")


@click.command(help=__doc__)
@click.argument("cases", nargs=-1, required=True)
@click.option("--top", default=12, show_default=True, help="Functions to list.")
def main(cases: tuple[str, ...], top: int) -> None:
    for name in cases:
        profile(name, top)


if __name__ == "__main__":
    main()
