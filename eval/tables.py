"""Print the tables of runs again, as Markdown for eval/README.md, with the cases and versions they are from.

    python eval/tables.py RESULTS... [--into eval/README.md --name main]

Each RESULTS is a folder that `iconjax eval` wrote; several are put together as one table, the first run of a method
counting. Nothing is run. With --into, the tables replace what stands between the file's lines `<!-- tables NAME -->`
and `<!-- end -->`.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any

from iconjax.errors import IconjaxError, InputError
from iconjax.evaluation.record import CaseRecord, read_record
from iconjax.evaluation.report import Report
from iconjax.files import write_text


def read_run(folder: Path) -> tuple[dict[str, Any], dict[str, list[CaseRecord]]]:
    """A run's configuration, and its records by method."""
    try:
        config = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(f"{folder} holds no run: {error}") from error
    found: dict[str, list[CaseRecord]] = {}
    for method in config["methods"]:
        paths = [folder / method["folder"] / f"{case}.json" for case in config["cases"]]
        found[method["name"]] = [record for path in paths if (record := read_record(path)) is not None]
    return config, found


def merged(folders: list[Path]) -> tuple[Report, list[str]]:
    """One report of several runs, and a line about each."""
    records: dict[str, list[CaseRecord]] = {}
    lines = []
    for folder in folders:
        config, found = read_run(folder)
        records = records | {name: rows for name, rows in found.items() if name not in records}
        versions = config["versions"]
        state = "" if config["state"] == "finished" else ", not finished"
        lines.append(
            f"{len(config['cases'])} cases, {', '.join(m['name'] for m in config['methods'])}; iconjax "
            f"{versions['iconjax']} (code {versions['code']}), jax {versions['jax']}, {config['jobs']} processes{state}"
        )
    last = [name for name in ("unedited", "truth") if name in records]
    order = [name for name in records if name not in last] + last
    return Report(tuple(r for name in order for r in records[name]), tuple(order)), lines


def put_into(file: Path, name: str, text: str) -> None:
    """Replace what stands between the marks of a name."""
    whole = file.read_text(encoding="utf-8")
    begin, end = f"<!-- tables {name} -->\n", "<!-- end -->"
    before, mark, after = whole.partition(begin)
    _, closing, rest = after.partition(end)
    if not mark or not closing:
        raise InputError(f"{file} has no lines {begin.strip()} and {end}")
    write_text(file, f"{before}{mark}\n{text}\n{closing}{rest}")


def main() -> None:
    """Read the command line, print or write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", nargs="+", type=Path)
    parser.add_argument("--into", type=Path, help="Markdown file to write the tables into")
    parser.add_argument("--name", default="main", help="which of the file's places")
    a = parser.parse_args()
    report, lines = merged(a.results)
    text = report.markdown() + "\n" + "".join(f"- {line}\n" for line in lines)
    if a.into is None:
        print(text, end="")
    else:
        put_into(a.into, a.name, text)


if __name__ == "__main__":
    try:
        main()
    except IconjaxError as error:
        sys.exit(str(error))
