"""Draw the results of a run: before, segments, after, one solution, and what the checks say.

python eval/contact_sheet.py results/first -o sheet.png --only wrong
"""

from __future__ import annotations

import sys

import click

from iconjax.errors import IconjaxError
from iconjax.evaluation.sheet import contact_sheets


@click.command(help=__doc__)
@click.argument("run")
@click.option("-o", "--output", default="sheet.png", show_default=True, help="Image file (several: NAME-1.png, ...).")
@click.option("--method", metavar="NAME", help="Which method of the run; the first by default.")
@click.option("--benchmark", metavar="DIR", help="Where the cases are, if not where the run saw them.")
@click.option("--rows", default=8, show_default=True, type=click.IntRange(1), help="Cases on a page.")
@click.option("--only", type=click.Choice(["right", "wrong"]), help="Leave the other cases out.")
def main(run: str, output: str, method: str | None, benchmark: str | None, rows: int, only: str | None) -> None:
    try:
        paths = contact_sheets(run, output, method=method, benchmark=benchmark, rows=rows, only=only)
    except IconjaxError as error:
        click.echo(f"error: {error}", err=True)
        sys.exit(2)
    click.echo("\n".join(map(str, paths)))


if __name__ == "__main__":
    main()
