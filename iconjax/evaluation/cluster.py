"""Running jobs on a Dask cluster: other machines, or more processes on this one.

A job travels with the files of its case and comes back with its picture and record, so no disk is shared; records are
written here. What a lost worker was doing is done again by another; a case that keeps killing workers is given up.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from iconjax.errors import ConfigError, InputError
from iconjax.evaluation.editors import Editor
from iconjax.evaluation.fingerprint import CASE_FILES, code_digest
from iconjax.evaluation.job import Job, Outcome, keep, outcome_of
from iconjax.evaluation.record import CaseRecord, failure
from iconjax.evaluation.workers import died

PATIENCE = 30.0
"""Seconds to wait for the scheduler, and for its first worker."""


def run_on_cluster(jobs: Sequence[Job], address: str) -> Iterator[tuple[Job, CaseRecord]]:
    """Run jobs on the cluster whose scheduler is at `address`, in any order.

    Raises:
        ConfigError: Dask is not installed, no scheduler or worker answers, or the workers have other code.
        InputError: the scheduler is lost on the way; what is finished is kept.
    """
    if not jobs:
        return
    client = connect(address)
    try:
        futures = {}
        for job in jobs:
            arguments = (job.case.name, _files(job.case), job.method, job.fingerprint, job.editor, code_digest())
            futures[client.submit(run_remote, *arguments, pure=False)] = job
        for future in import_module("distributed").as_completed(futures, loop=client.loop):
            yield futures[future], _result(futures[future], future)
    finally:
        client.close(timeout=5)


def connect(address: str) -> Any:
    """A client of the scheduler at `address`, once at least one worker is there and all have this code."""
    try:
        distributed = import_module("distributed")
    except ImportError as error:
        raise ConfigError("Dask is not installed: pip install 'iconjax[dask]'") from error
    try:
        client = distributed.Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:
        raise ConfigError(f"no Dask scheduler answers at {address!r}: start one, or leave out --dask") from error
    try:
        client.wait_for_workers(1, timeout=PATIENCE)
        digests = client.run(code_digest, on_error="return")
    except TimeoutError as error:
        client.close(timeout=5)
        raise ConfigError(f"the Dask scheduler at {address} has no worker: start one with 'dask worker'") from error
    for worker, digest in digests.items():
        if digest != code_digest():
            client.close(timeout=5)
            raise ConfigError(f"Dask worker {worker} does not have this version of iconjax: install the same there")
    return client


def run_remote(name: str, files: dict[str, bytes], method: str, fingerprint: str, editor: Editor, code: str) -> Outcome:
    """What a worker does: lay out a case's files, edit it and score the edit."""
    if code_digest() != code:  # a worker that joined later
        error = ConfigError("this Dask worker has another version of iconjax: install the same there")
        return Outcome(failure(name, method, error))
    with TemporaryDirectory(prefix="iconjax-") as place:
        folder = Path(place) / name
        folder.mkdir()
        for file, content in files.items():
            (folder / file).write_bytes(content)
        return outcome_of(folder, method, fingerprint, editor)


def _files(folder: Path) -> dict[str, bytes]:
    return {name: (folder / name).read_bytes() for name in CASE_FILES if (folder / name).is_file()}


def _result(job: Job, future: Any) -> CaseRecord:
    distributed = import_module("distributed")
    try:
        outcome: Outcome = future.result()
    except distributed.CancelledError as error:
        raise InputError("the Dask scheduler is gone; run again to go on, finished cases are kept") from error
    except distributed.KilledWorker:
        return died(job)
    except Exception as error:  # the editor could not be sent or loaded there
        outcome = Outcome(failure(job.case.name, job.method, error))
    future.release()
    return keep(job, outcome)
