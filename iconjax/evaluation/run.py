"""Running methods over a benchmark: resumable, one bad case never stops the rest."""

from __future__ import annotations

import io
import json
import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
from jaxtyping import UInt8
from PIL import Image

from iconjax.errors import ConfigError, InputError
from iconjax.evaluation.cases import EvalCase, list_cases, load_eval_case
from iconjax.evaluation.fingerprint import fingerprint, versions
from iconjax.evaluation.methods import BASELINES, Editor, Method, make_editor, parse_method
from iconjax.evaluation.record import CaseRecord, failure, read_record, score, write_record
from iconjax.evaluation.report import Report, write_report
from iconjax.files import write_bytes, write_text

DEFAULT_METHODS = ("ours",)

Progress = Callable[[str], None]


@dataclass(frozen=True)
class Job:
    """One case to be edited by one method; can be sent to another process.

    Attributes:
        case: folder of the case.
        out: folder for the method's results.
        method: name of the method.
        fingerprint: what the result depends on.
        editor: makes the edit.
    """

    case: Path
    out: Path
    method: str
    fingerprint: str
    editor: Editor

    @property
    def file(self) -> Path:
        """Where the record goes."""
        return self.out / f"{self.case.name}.json"


def run_benchmark(
    folder: str | Path,
    out: str | Path,
    methods: Sequence[str] | None = None,
    *,
    translator: str | None = None,
    editors: Mapping[str, Editor] | None = None,
    cases: Sequence[str] | None = None,
    jobs: int = 1,
    progress: Progress | None = None,
) -> Report:
    """Measure methods on the case folders in a folder; always also the rows "unedited" and "truth".

    Writes `OUT/<method>/<case>.json` and `.png`, `table.md`, `table.csv`, `cases.csv` and `run.json`. What is
    there already and still up to date is not run again; a case that failed is tried again.

    Args:
        folder: benchmark folder, or one case folder.
        out: folder for the results.
        methods: names as in `iconjax.evaluation.methods.parse_method`; "ours" by default.
        translator: who reads requests, by name; None means automatic.
        editors: further methods by name, each a function from a case to an edit.
        cases: ids of the only cases to run.
        jobs: how many processes to use; 1 means this one.
        progress: told what was just finished; by default a line on stderr, if that is a terminal.

    Returns:
        The table, with all records.

    Raises:
        InputError: no cases, or a folder that cannot be written.
        ConfigError: an unknown method, or `jobs` below 1.
    """
    if jobs < 1:
        raise ConfigError(f"jobs is {jobs}; it has to be at least 1")
    folders = _select(list_cases(folder), cases)
    table: dict[str, tuple[Editor, dict[str, Any]]] = {}
    for name in dict.fromkeys([*(DEFAULT_METHODS if methods is None else methods), *BASELINES]):
        method = parse_method(name)
        settings = {**method.describe(), "translator": translator if method.reads_request else None}
        table[method.name] = (make_editor(method, translator), settings)
    table |= {name: (editor, {"name": name}) for name, editor in (editors or {}).items()}
    records: list[CaseRecord] = []
    for name, (editor, settings) in table.items():
        records += evaluate_folder(
            folders, Path(out), name, editor, settings=settings, jobs=jobs, progress=progress or tell_terminal
        )
    config: dict[str, Any] = {
        # Relative, so that a run can be moved or shared together with its benchmark.
        "benchmark": Path(os.path.relpath(folders[0].parent, out)).as_posix(),
        "cases": [f.name for f in folders],
        "methods": [{"folder": Method(name).folder, **settings} for name, (_, settings) in table.items()],
        "jobs": jobs,
    }
    report = Report(tuple(records), tuple(table))
    write_text(Path(out) / "run.json", json.dumps({**config, "versions": versions()}, indent=1) + "\n")
    write_report(Path(out), report)
    return report


def evaluate_folder(
    folders: Sequence[Path],
    out: Path,
    name: str,
    editor: Editor,
    *,
    settings: Mapping[str, Any],
    jobs: int = 1,
    progress: Progress = lambda line: None,
) -> tuple[CaseRecord, ...]:
    """Run one method on case folders and keep its records; see `run_benchmark`.

    Returns:
        One record for each case, in the order of `folders`.
    """
    target = out / Method(name).folder
    try:
        target.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"cannot make folder {target}: {error.strerror}") from error
    todo = [Job(f, target, name, fingerprint(f, dict(settings)), editor) for f in folders]
    records = {job.case: record for job in todo if (record := finished(job)) is not None}
    waiting = [job for job in todo if job.case not in records]
    for job, record in _run_all(waiting, jobs):
        records[job.case] = record
        state = f"failed: {record.error}" if record.error else "right" if record.right else "not right"
        progress(f"{name}: {len(records)}/{len(todo)} {job.case.name}: {state}")
    return tuple(records[folder] for folder in folders)


def finished(job: Job) -> CaseRecord | None:
    """The record of a job that is done, whole and up to date, else None."""
    record = read_record(job.file)
    return record if record and record.error is None and record.fingerprint == job.fingerprint else None


def run_job(job: Job) -> CaseRecord:
    """Edit a case, score the edit and keep both; whatever goes wrong with it becomes part of the record."""
    start = perf_counter()
    case: EvalCase | str = job.case.name
    image: UInt8[np.ndarray, "H W 3"] | None = None
    try:
        case = load_eval_case(job.case)
        start = perf_counter()
        edited = job.editor(case)
        record = score(case, job.method, edited, perf_counter() - start, job.fingerprint)
        image = edited.image
    except Exception as error:
        record = failure(case, job.method, error, perf_counter() - start)
    # The record comes last: where it is, everything is.
    if image is not None:
        write_bytes(job.file.with_suffix(".png"), _png(image))
    write_record(job.file, record)
    return record


def tell_terminal(line: str) -> None:
    """A line on stderr, if that is a terminal."""
    if sys.stderr.isatty():
        print(line, file=sys.stderr)


def _run_all(jobs: Sequence[Job], processes: int) -> Iterator[tuple[Job, CaseRecord]]:
    """Run jobs in any order; one that kills its process costs no other job its result."""
    if processes == 1:
        yield from ((job, run_job(job)) for job in jobs)
        return
    lost = []
    for job, record in _run_pool(jobs, processes):
        if isinstance(record, BrokenProcessPool):
            lost.append(job)
        else:
            yield job, record
    # When a process dies, its pool loses every job it had; each is run again on its own to find the culprit.
    for job in lost:
        for _, record in _run_pool([job], 1):
            if isinstance(record, BrokenProcessPool):
                record = failure(job.case.name, job.method, RuntimeError("the process died"))
                write_record(job.file, record)
            yield job, record


def _run_pool(jobs: Sequence[Job], processes: int) -> Iterator[tuple[Job, CaseRecord | BrokenProcessPool]]:
    with ProcessPoolExecutor(processes, mp_context=get_context("spawn")) as pool:
        futures: dict[Future[CaseRecord], Job] = {}
        for job in jobs:
            futures[pool.submit(run_job, job)] = job
        for future in as_completed(futures):
            try:
                yield futures[future], future.result()
            except BrokenProcessPool as error:
                yield futures[future], error


def _select(folders: tuple[Path, ...], cases: Sequence[str] | None) -> tuple[Path, ...]:
    if cases is None:
        return folders
    unknown = set(cases) - {folder.name for folder in folders}
    if unknown:
        raise InputError(f"no such cases: {', '.join(sorted(unknown))}")
    return tuple(folder for folder in folders if folder.name in cases)


def _png(image: UInt8[np.ndarray, "H W 3"]) -> bytes:
    stream = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(image)).save(stream, "PNG")
    return stream.getvalue()
