"""One process's edits, timed; started by `latency.py`. Prints a JSON list, one object of seconds for each edit."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from time import perf_counter

BENCHMARK = Path(__file__).parents[1] / "benchmark"


def main() -> None:
    """Arguments: pairs of a case and a request ("" for the case's own)."""
    begin = perf_counter()
    import iconjax

    light = perf_counter() - begin
    import iconjax.edit.pipeline

    imported = perf_counter() - begin
    rows = []
    for k in range(1, len(sys.argv), 2):
        case, request = sys.argv[k : k + 2]
        folder = BENCHMARK / case
        begin = perf_counter()
        result = iconjax.edit(folder, request=request or None, translator="offline")
        total = perf_counter() - begin
        row = {"import": imported if k == 1 else 0.0, **result.timings}
        row["scene"] = total - sum(result.timings.values())
        row["total"] = total + row["import"]
        row["satisfied"] = float(result.satisfied)
        row["candidates"] = len(result.trace)
        row["light"] = light
        rows.append(row)
    print(json.dumps(rows))


if __name__ == "__main__":
    main()
