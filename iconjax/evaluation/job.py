"""One case to be edited by one method: running it, and keeping what came out."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from iconjax.evaluation.cases import EvalCase, load_eval_case
from iconjax.evaluation.editors import Editor
from iconjax.evaluation.record import CaseRecord, failure, read_record, score, write_record
from iconjax.files import encode_image, write_bytes


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


@dataclass(frozen=True)
class Outcome:
    """What came out of a job.

    Attributes:
        record: how the edit did.
        png: the edited picture as a file's content; None where there is none.
    """

    record: CaseRecord
    png: bytes | None = None


def finished(job: Job) -> CaseRecord | None:
    """The record of a job that is done, whole and up to date, else None."""
    record = read_record(job.file)
    return record if record and record.error is None and record.fingerprint == job.fingerprint else None


def run_job(job: Job) -> CaseRecord:
    """Edit a case, score the edit and keep both; whatever goes wrong with it becomes part of the record."""
    return keep(job, outcome_of(job.case, job.method, job.fingerprint, job.editor))


def outcome_of(folder: Path, method: str, fingerprint: str, editor: Editor) -> Outcome:
    """Edit a case folder and score the edit, writing nothing."""
    start = perf_counter()
    case: EvalCase | str = folder.name
    try:
        case = load_eval_case(folder)
        start = perf_counter()
        edited = editor(case)
        record = score(case, method, edited, perf_counter() - start, fingerprint)
        return Outcome(record, None if edited.image is None else encode_image(edited.image))
    except Exception as error:
        return Outcome(failure(case, method, error, perf_counter() - start))


def keep(job: Job, outcome: Outcome) -> CaseRecord:
    """Write a job's picture and record; gives back the record.

    Raises:
        InputError: a file cannot be written.
    """
    # The record comes last: where it is, everything is.
    if outcome.png is not None:
        write_bytes(job.file.with_suffix(".png"), outcome.png)
    write_record(job.file, outcome.record)
    return outcome.record
