"""Running jobs on this machine: one after the other, or shared out over processes."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import connection, get_context, parent_process
from threading import Thread

from iconjax.evaluation.job import Job, Outcome, keep, run_job
from iconjax.evaluation.record import CaseRecord, failure

DIED = "the process died"


def run_here(jobs: Sequence[Job], processes: int) -> Iterator[tuple[Job, CaseRecord]]:
    """Run jobs, in any order with several processes; one that kills its process costs no other job its result."""
    if processes == 1:
        yield from ((job, run_job(job)) for job in jobs)
        return
    lost = []
    for job, record in _run_pool(jobs, processes):
        if record is None:
            lost.append(job)
        else:
            yield job, record
    # When a process dies, its pool loses every job it had; each is run again on its own to find the culprit.
    for job in lost:
        for _, record in _run_pool([job], 1):
            yield job, died(job) if record is None else record


def died(job: Job) -> CaseRecord:
    """The record, kept, of a job that took its process with it."""
    return keep(job, Outcome(failure(job.case.name, job.method, RuntimeError(DIED))))


def _run_pool(jobs: Sequence[Job], processes: int) -> Iterator[tuple[Job, CaseRecord | None]]:
    """Jobs with their records; None for those that a dead process left undone."""
    with ProcessPoolExecutor(processes, get_context("spawn"), initializer=_end_with_parent) as pool:
        futures: dict[Future[CaseRecord], Job] = {pool.submit(run_job, job): job for job in jobs}
        try:
            for future in as_completed(futures):
                try:
                    yield futures[future], future.result()
                except BrokenProcessPool:
                    yield futures[future], None
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)  # an interrupt must not wait for all that is queued
            raise


def _end_with_parent() -> None:
    """End this process when the one that started it is killed; it would wait for work for ever."""
    parent = parent_process()
    assert parent is not None

    def watch() -> None:
        connection.wait([parent.sentinel])
        os._exit(1)

    Thread(target=watch, daemon=True).start()
