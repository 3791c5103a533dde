"""The command `iconjax eval`. What it needs is imported when it runs, so that `--help` is quick."""

from __future__ import annotations

from pathlib import Path

import click

from iconjax.console import say
from iconjax.errors import ConfigError, InputError

SHOWN = 5
"""Failed cases of a method that are told one by one; `cases.csv` has them all."""


@click.command("eval", short_help="Measure methods on a benchmark folder.")
@click.argument("folder")
@click.option("--out", metavar="DIR", required=True, help="Folder for tables, pictures, records and the report page.")
@click.option(
    "--method",
    metavar="NAME",
    multiple=True,
    help="What to measure: ours (the default), paper, 'ours -MS', 'ours -RS', 'ours +program', dm, dc, 'dm +image' "
    "and so on; may be repeated.",
)
@click.option("--case", "cases", metavar="ID", multiple=True, help="Measure this case only; may be repeated.")
@click.option(
    "--translator",
    metavar="NAME",
    help="Who reads requests where the method does not say: auto (the default), program, offline, llm-replay or llm.",
)
@click.option("--replay", metavar="DIR", help="Recorded replies that llm-replay, dm and dc answer from.")
@click.option("--record", metavar="DIR", help="Folder into which replies of llm are recorded.")
@click.option("--jobs", type=int, metavar="N", help="Processes to use on this machine; 1 by default.")
@click.option("--dask", metavar="ADDRESS", help="Use the workers of this Dask scheduler, such as tcp://host:8786.")
def evaluate(
    folder: str, out: str, method: tuple[str, ...], cases: tuple[str, ...], translator: str | None,
    replay: str | None, record: str | None, jobs: int | None, dask: str | None,
) -> None:  # fmt: skip
    """Measure methods on the case folders in FOLDER and print the tables.

    DIR gets them as files, with report.html to look at. What is done is not done again.
    """
    if not Path(folder).is_dir():
        raise InputError(f"there is no folder {folder}")
    if jobs is not None and dask is not None:
        raise ConfigError("--jobs is for this machine and --dask for others: leave one out")
    from iconjax.evaluation.run import run_benchmark
    from iconjax.language.llm.settings import LlmSettings

    report = run_benchmark(
        folder,
        out,
        method or None,
        translator=translator,
        cases=cases or None,
        jobs=1 if jobs is None else jobs,
        dask=dask,
        settings=LlmSettings.from_environment(replay=replay, record=record),
    )
    click.echo(report.markdown(), nl=False)
    for name in report.methods:
        failed = [r for r in report.failures if r.method == name]
        for r in failed[:SHOWN]:
            say(f"{name} failed on {r.case}: {r.error}")
        if len(failed) > SHOWN:
            say(f"{name} failed on {len(failed) - SHOWN} more; {Path(out) / 'cases.csv'} says why")
    say(f"{Path(out) / 'report.html'} shows every case")
