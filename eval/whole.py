"""How long does a whole evaluation take, and what does the time go into?

    python eval/whole.py eval/benchmark --jobs 2 [--cold] [--method "ours +program"]

runs a method over all cases, from nothing, and prints the wall time and where the time of all processes together went.
On a machine that does other work too, CPU time / processes is what the wall time would be without it.
With --cold the cache folder of compiled solvers is an empty one too; else the user's own is used.
"""

from __future__ import annotations

import argparse
import os
import tempfile
from pathlib import Path
from time import perf_counter

from iconjax.evaluation.record import CaseRecord
from iconjax.evaluation.run import run_benchmark
from iconjax.evaluation.summary import STAGES, numbers_of
from iconjax.evaluation.tables import markdown_table


def shares(records: tuple[CaseRecord, ...], wall: float, jobs: int) -> list[tuple[str, str, str]]:
    """Rows part, seconds, share of the time that all processes had."""
    spent = {stage: sum(numbers_of(r, "timings").get(stage, 0.0) for r in records) for stage in STAGES}
    spent["reading the picture and the rest of the edit"] = sum(r.seconds for r in records) - sum(spent.values())
    spent["starting processes, scoring, other rows, report"] = wall * jobs - sum(r.seconds for r in records)
    return [(part, f"{seconds:.1f}", f"{seconds / (wall * jobs):.0%}") for part, seconds in spent.items()]


def main() -> None:
    """Read the command line, run, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--method", default="ours +program")
    parser.add_argument("--cold", action="store_true", help="begin with an empty cache of compiled solvers")
    a = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        if a.cold:
            os.environ["ICONJAX_CACHE"] = str(Path(place) / "cache")
        begin = perf_counter()
        report = run_benchmark(a.folder, Path(place) / "out", [a.method], jobs=a.jobs)
        wall = perf_counter() - begin
    used = sum(os.times()[:4])
    records = report.of(report.methods[0])
    right = sum(r.right for r in records)
    told = f"{right} right, {len(report.failures)} failed"
    print(f"{len(records)} cases in {wall:.1f} s with {a.jobs} processes, which used {used:.1f} s of CPU ({told})\n")
    print(markdown_table(("part", "seconds, all processes", "share"), shares(records, wall, a.jobs)), end="")


if __name__ == "__main__":
    main()
