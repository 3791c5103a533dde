"""Running methods over a benchmark: resumable, one bad case never stops the rest."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import nullcontext
from pathlib import Path
from time import perf_counter
from typing import Any

from iconjax.edit.choose import choose_translator
from iconjax.errors import ConfigError, InputError
from iconjax.evaluation.bootstrap import DRAWS, SEED
from iconjax.evaluation.cases import list_cases
from iconjax.evaluation.editors import Editor, make_editor
from iconjax.evaluation.fingerprint import fingerprint, versions
from iconjax.evaluation.job import Job, finished
from iconjax.evaluation.methods import BASELINES, TRANSLATORS, folder_name, parse_method
from iconjax.evaluation.model import describe_model
from iconjax.evaluation.progress import Progress, Step, bar_on_terminal
from iconjax.evaluation.record import CaseRecord
from iconjax.evaluation.report import Report, write_report
from iconjax.evaluation.workers import run_here
from iconjax.files import write_text
from iconjax.language.llm.settings import LlmSettings

DEFAULT_METHODS = ("ours",)

Table = dict[str, tuple[Editor, dict[str, Any]]]
"""Method -> its editor and its settings."""


def run_benchmark(
    folder: str | Path,
    out: str | Path,
    methods: Sequence[str] | None = None,
    *,
    translator: str | None = None,
    editors: Mapping[str, Editor] | None = None,
    cases: Sequence[str] | None = None,
    jobs: int = 1,
    dask: str | None = None,
    settings: LlmSettings | None = None,
    progress: Progress | None = None,
) -> Report:
    """Measure methods on the case folders in a folder; always also the rows "unedited" and "truth".

    Writes `OUT/<method>/<case>.json` and `.png`, `report.html`, `table.md`, `table.csv`, `cases.csv` and `run.json`.
    What is there already and still up to date is not run again; a case that failed is tried again.

    Args:
        folder: benchmark folder, or one case folder.
        out: folder for the results.
        methods: names as in `iconjax.evaluation.methods.parse_method`; "ours" by default.
        translator: who reads requests where a method's name does not say; None means automatic.
        editors: further methods by name, each a function from a case to an edit.
        cases: ids of the only cases to run.
        jobs: how many processes to use; 1 means this one.
        dask: address of a Dask scheduler whose workers do the work instead; recordings have to be where they are here.
        settings: of the language model and its recordings; by default from the environment.
        progress: told what was just finished; by default a bar on stderr, if that is a terminal.

    Returns:
        The table, with all records.

    Raises:
        InputError: no cases, or a folder that cannot be written.
        ConfigError: an unknown method, `jobs` below 1, or no such cluster.
    """
    if jobs < 1:
        raise ConfigError(f"jobs is {jobs}; it has to be at least 1")
    out, begin = Path(out), perf_counter()
    folders = _select(list_cases(folder), cases)
    table = _table(
        DEFAULT_METHODS if methods is None else methods, translator, settings or LlmSettings.from_environment()
    )
    table |= {name: (editor, {"name": name}) for name, editor in (editors or {}).items()}
    config = {**describe_run(folders, out, table), "jobs": jobs, "dask": dask}
    todo = _prepare(folders, out, table)
    _write_config(out, config, "running")
    records = {job.file: record for job in todo if (record := finished(job)) is not None}
    old = len(records)
    waiting = [job for job in todo if job.file not in records]
    with bar_on_terminal() if progress is None else nullcontext(progress) as tell:
        for job, record in _work(waiting, jobs, dask):
            records[job.file] = record
            tell(Step(record, len(records), len(todo)))
    by_method = tuple(records[job.file] for name in table for job in todo if job.method == name)
    report = Report(by_method, tuple(table))
    took = {"seconds": round(perf_counter() - begin, 2), "cases_run": len(todo) - old, "cases_kept": old}
    _write_config(out, {**config, **took}, "finished")
    write_report(out, report, folders)
    return report


def describe_run(folders: Sequence[Path], out: Path, table: Table) -> dict[str, Any]:
    """The configuration of a run as plain data, with versions and seeds."""
    return {
        # Relative, so that a run can be moved or shared together with its benchmark.
        "benchmark": Path(os.path.relpath(folders[0].parent, out)).as_posix(),
        "cases": [folder.name for folder in folders],
        "methods": [{"folder": folder_name(name), **settings} for name, (_, settings) in table.items()],
        "seeds": {"bootstrap": SEED, "bootstrap_draws": DRAWS, "search": None},  # the search draws nothing
        "versions": versions(),
    }


def _table(names: Sequence[str], translator: str | None, settings: LlmSettings) -> Table:
    reader = reader_name(translator)
    table: Table = {}
    for name in dict.fromkeys([*names, *BASELINES]):
        method = parse_method(name, reader)
        described = {**method.describe(), **describe_model(method.translator, settings)}
        table[method.name] = (make_editor(method, settings), described)
    return table


def reader_name(translator: str | None) -> str | None:
    """The name by which methods know a translator; None means automatic.

    Raises:
        ConfigError: there is no such translator.
    """
    name = {"auto": None, "anthropic": "llm"}.get(translator or "auto", translator)
    if name is not None and name not in TRANSLATORS:
        choose_translator(name)  # one that somebody registered, or an error that says what there is
    return name


def _prepare(folders: Sequence[Path], out: Path, table: Table) -> list[Job]:
    """All jobs, case by case, so that a run that is stopped leaves rows that can be compared."""
    for name in table:
        target = out / folder_name(name)
        try:
            target.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise InputError(f"cannot make folder {target}: {error.strerror}") from error
    return [
        Job(folder, out / folder_name(name), name, fingerprint(folder, settings), editor)
        for folder in folders
        for name, (editor, settings) in table.items()
    ]


def _work(jobs: Sequence[Job], processes: int, dask: str | None) -> Iterator[tuple[Job, CaseRecord]]:
    if dask is None:
        return run_here(jobs, processes)
    from iconjax.evaluation.cluster import run_on_cluster

    return run_on_cluster(jobs, dask)


def _write_config(out: Path, config: Mapping[str, Any], state: str) -> None:
    write_text(out / "run.json", json.dumps({"state": state, **config}, indent=1) + "\n")


def _select(folders: tuple[Path, ...], cases: Sequence[str] | None) -> tuple[Path, ...]:
    if cases is None:
        return folders
    unknown = set(cases) - {folder.name for folder in folders}
    if unknown:
        raise InputError(f"no such cases: {', '.join(sorted(unknown))}")
    return tuple(folder for folder in folders if folder.name in cases)
