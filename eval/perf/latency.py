"""How long an edit takes from the user's seat: the first of a fresh process, and those after it.

    python eval/perf/latency.py

Starts fresh processes one after the other: some with an empty cache folder, then some that find it filled. Each does
the same edits (of those with an empty folder only the last does more than the first edit); tables show medians.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from statistics import median
from time import perf_counter

import click

EDITS = (
    ("first edit", "umbrella-45", ""),
    ("same program, other number", "umbrella-45", "Rotate the umbrella 30 degrees clockwise"),
    ("same icon, other request", "umbrella-45", "Make the umbrella 20% smaller"),
    ("other icon", "pot-halved", ""),
    ("other icon, outlines compared", "trophy-cup-base", ""),
)
STAGES = ("import", "scene", "translate", "compile", "search", "render", "total", "candidates")


def process(folder: str, edits: Sequence[tuple[str, str, str]] = EDITS) -> tuple[list[dict[str, float]], float]:
    """Timings of each edit in a fresh process that caches in `folder`, and the life of the process."""
    root = Path(__file__).parents[2]
    search = os.pathsep.join(p for p in (str(root), os.environ.get("PYTHONPATH")) if p)
    environment = {**os.environ, "ICONJAX_CACHE": folder, "PYTHONPATH": search}
    command = [sys.executable, str(Path(__file__).with_name("latency_child.py"))]
    command += [word for _, case, request in edits for word in (case, request)]
    begin = perf_counter()
    done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, check=True, text=True)
    return json.loads(done.stdout), perf_counter() - begin


def table(title: str, runs: list[list[dict[str, float]]]) -> str:
    """Medians of each stage of each edit, in Markdown."""
    lines = [f"{title} ({len(runs)} processes)", "", f"| seconds | {' | '.join(STAGES)} |"]
    lines.append("| --- |" + " ---: |" * len(STAGES))
    for k, (name, case, _) in enumerate(EDITS):
        rows = [run[k] for run in runs if k < len(run)]
        cells = [f"{median(row[s] for row in rows):.{0 if s == 'candidates' else 2}f}" for s in STAGES]
        lines.append(f"| {name} ({case}) | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


@click.command(help=__doc__)
@click.option(
    "--cold", default=2, show_default=True, type=click.IntRange(1), help="Processes with an empty cache folder."
)
@click.option("--warm", default=3, show_default=True, help="Processes with a filled one.")
def main(cold: int, warm: int) -> None:
    cold_runs, warm_runs, light, lives = [], [], [], []
    with tempfile.TemporaryDirectory() as root:
        for k in range(cold):
            folder = f"{root}/{k}"
            cold_runs.append(process(folder, EDITS if k + 1 == cold else EDITS[:1])[0])
            click.echo(f"cold {k + 1}/{cold}", err=True)
        for _ in range(warm):
            rows, life = process(folder)
            warm_runs.append(rows)
            light.append(rows[0]["light"])
            lives.append(life)
        stored = [p.stat().st_size for p in Path(folder).iterdir()]
    click.echo(table("Empty cache folder", cold_runs))
    if warm_runs:
        click.echo(table("Filled cache folder", warm_runs))
        click.echo(f"`import iconjax` alone: {1000 * median(light):.1f} ms. A warm process: {median(lives):.1f} s.")
    click.echo(f"Cache folder: {len(stored)} files, {sum(stored) / 2**20:.1f} MiB.")
    missed = {
        n
        for run in (*cold_runs, *warm_runs)
        for (n, _, _), row in zip(EDITS, run, strict=False)
        if not row["satisfied"]
    }
    if missed:
        click.echo(f"Not satisfied: {', '.join(sorted(missed))}.")


if __name__ == "__main__":
    main()
