"""Open icons and write them back without an edit: the bytes have to be the same.

python eval/svg/roundtrip.py node_modules --per-set 80
"""

from __future__ import annotations

import argparse
import json
from collections import Counter, defaultdict
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np
from icons import sample

from iconjax.errors import IconjaxError
from iconjax.render.raster import render
from iconjax.render.svg import write_svg
from iconjax.scene.svg import open_svg


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("modules", type=Path)
    parser.add_argument("--per-set", type=int, default=80)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=Path, default=Path(__file__).parent / "roundtrip.json")
    args = parser.parse_args()
    rows, failures, notes = defaultdict(list), [], Counter()
    for name, icon, data in sample(args.modules, args.per_set, args.seed):
        start = perf_counter()
        try:
            vector = open_svg(data)
        except IconjaxError as error:
            failures.append([name, icon, str(error)])
            continue
        seconds = perf_counter() - start
        still = np.tile(np.eye(2, 3), (len(vector.members), 1, 1))
        same = write_svg(vector, still) == data
        exact = np.array_equal(render(vector.scene, still, range(len(still))), vector.scene.image)
        rows[name].append((same, exact, len(vector.members), seconds))
        notes.update(vector.notes)
        if not (same and exact):
            failures.append([name, icon, f"bytes same: {same}, picture same: {exact}"])
    print("| set | icons | bytes the same | picture the same | segments, median (most) | seconds, median (most) |")
    print("| --- | --- | --- | --- | --- | --- |")
    table = {}
    for name, found in rows.items():
        count, most = [r[2] for r in found], max(r[3] for r in found)
        table[name] = {"icons": len(found), "same": sum(r[0] for r in found), "exact": sum(r[1] for r in found)}
        print(f"| {name} | {len(found)} | {table[name]['same']} | {table[name]['exact']} "
              f"| {median(count):g} ({max(count)}) | {median(r[3] for r in found):.2f} ({most:.1f}) |")  # fmt: skip
    for failure in failures:
        print(failure)
    print(notes.most_common(12))
    args.out.write_text(json.dumps({"sets": table, "failures": failures, "notes": dict(notes)}, indent=1) + "\n")


if __name__ == "__main__":
    main()
