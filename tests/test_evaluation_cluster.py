"""Beyond one machine: a real Dask scheduler and two workers on loopback, one of which is killed at work."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from evaluation_support import ENVIRONMENT, Slow, wait_until, write_case

from iconjax.errors import ConfigError, InputError
from iconjax.evaluation.progress import Step
from iconjax.evaluation.record import CaseRecord
from iconjax.evaluation.run import run_benchmark

distributed = pytest.importorskip("distributed")

CASES = 12


class Cluster:
    """A scheduler, and workers as they are asked for; what they say is kept in files, for when a test fails."""

    def __init__(self, place: Path) -> None:
        self.place, self.running = place, list[subprocess.Popen[bytes]]()
        file = place / "scheduler.json"
        options = ["--port", "0", "--host", "127.0.0.1", "--no-dashboard", "--no-show", "--scheduler-file", str(file)]
        self.scheduler = self._start("distributed.cli.dask_scheduler", *options)
        wait_until(file.is_file)
        self.address: str = json.loads(file.read_text())["address"]

    def worker(self) -> subprocess.Popen[bytes]:
        options = ["--no-nanny", "--no-dashboard", "--nthreads", "1", "--host", "127.0.0.1"]
        return self._start("distributed.cli.dask_worker", self.address, *options)

    def close(self) -> None:
        for child in self.running:
            child.kill()
            child.wait()

    def _start(self, module: str, *options: str) -> subprocess.Popen[bytes]:
        with (self.place / f"said-{len(self.running)}-{module}.txt").open("wb") as said:
            command = [sys.executable, "-m", module, *options]
            child = subprocess.Popen(command, env=ENVIRONMENT, cwd=self.place, stdout=said, stderr=said)
        self.running.append(child)
        return child


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[Cluster]:
    found = Cluster(tmp_path)
    yield found
    found.close()


def lasting(record: CaseRecord) -> CaseRecord:
    """A record without what differs from run to run."""
    return replace(record, seconds=0.0)


def test_a_worker_that_is_killed_costs_nothing(cluster: Cluster, tmp_path: Path) -> None:
    for k in range(CASES):
        write_case(tmp_path / "bench" / f"case-{k:02}")
    workers = [cluster.worker() for _ in range(2)]
    with distributed.Client(cluster.address, set_as_default=False) as client:
        client.wait_for_workers(2, timeout=60)
        busy: list[int] = []

        def kill_one(step: Step) -> None:
            if step.done == 5:
                busy.append(sum(len(keys) > 0 for keys in client.processing().values()))
                workers[0].kill()

        editors = {"slow": Slow(seconds=0.2)}
        report = run_benchmark(
            tmp_path / "bench", tmp_path / "far", [], editors=editors, dask=cluster.address, progress=kill_one
        )
        assert len(client.scheduler_info()["workers"]) == 1
    assert busy == [2]  # both were at work when one was killed
    here = run_benchmark(tmp_path / "bench", tmp_path / "here", [], editors={"slow": Slow(seconds=0.0)})
    assert len(report.records) == 3 * CASES and not report.failures
    assert list(map(lasting, report.records)) == list(map(lasting, here.records))
    for picture in (tmp_path / "here").rglob("*.png"):
        assert (tmp_path / "far" / picture.relative_to(tmp_path / "here")).read_bytes() == picture.read_bytes()
    times = {r.seconds for r in report.of("truth")}
    assert len(times) > 1  # they were made, not found


def test_no_cluster_is_one_clear_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_case(tmp_path / "bench" / "case")
    monkeypatch.setattr("iconjax.evaluation.cluster.PATIENCE", 1.0)
    with pytest.raises(ConfigError, match=r"no Dask scheduler answers at 'tcp://127.0.0.1:9'"):
        run_benchmark(tmp_path / "bench", tmp_path / "out", [], dask="tcp://127.0.0.1:9")


def test_a_cluster_without_workers_is_one_clear_line(
    cluster: Cluster, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_case(tmp_path / "bench" / "case")
    monkeypatch.setattr("iconjax.evaluation.cluster.PATIENCE", 1.0)
    with pytest.raises(ConfigError, match="has no worker"):
        run_benchmark(tmp_path / "bench", tmp_path / "out", [], dask=cluster.address)


def test_a_scheduler_that_is_lost_ends_the_run_and_keeps_what_is_done(cluster: Cluster, tmp_path: Path) -> None:
    for k in range(4):
        write_case(tmp_path / "bench" / f"case-{k}")
    cluster.worker()

    def lose(step: Step) -> None:
        if step.done == 3:
            cluster.scheduler.kill()

    editors = {"slow": Slow(seconds=0.3)}
    with pytest.raises(InputError, match="the Dask scheduler is gone"):
        run_benchmark(tmp_path / "bench", tmp_path / "out", [], editors=editors, dask=cluster.address, progress=lose)
    assert 3 <= len(list((tmp_path / "out").glob("*/case-*.json"))) < 12
