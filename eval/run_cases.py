"""Measure methods on the cases of a benchmark folder and print the table.

    python eval/run_cases.py eval/benchmark --out results/first --method "ours +program" --method paper

What was finished before is not run again; see eval/README.md.
"""

from __future__ import annotations

import sys

import click

from iconjax.errors import IconjaxError
from iconjax.evaluation.run import run_benchmark


@click.command(help=__doc__)
@click.argument("folder")
@click.option("--out", required=True, metavar="DIR", help="Folder for the results.")
@click.option("--method", "methods", multiple=True, metavar="NAME", help="May be given several times.")
@click.option("--case", "cases", multiple=True, metavar="ID", help="Only this case; may be given several times.")
@click.option("--translator", metavar="NAME", help="Who reads the requests.")
@click.option("--jobs", default=1, show_default=True, help="Processes to use.")
@click.option("--quiet", is_flag=True, help="No line for each finished case.")
def main(
    folder: str,
    out: str,
    methods: tuple[str, ...],
    cases: tuple[str, ...],
    translator: str | None,
    jobs: int,
    quiet: bool,
) -> None:
    def tell(line: str) -> None:
        if not quiet:
            click.echo(line, err=True)

    try:
        report = run_benchmark(
            folder,
            out,
            methods or None,
            cases=cases or None,
            translator=translator,
            jobs=jobs,
            progress=tell,
        )
    except IconjaxError as error:
        click.echo(f"error: {error}", err=True)
        sys.exit(2)
    click.echo(report.markdown(), nl=False)


if __name__ == "__main__":
    main()
