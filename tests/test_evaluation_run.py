"""Running a benchmark: resumable, whole files only, one bad case never stops the rest."""

from __future__ import annotations

import csv
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from evaluation_support import ENVIRONMENT, shift, wait_until, write_case

from iconjax.errors import ConfigError, InputError
from iconjax.evaluation.cases import EvalCase
from iconjax.evaluation.editors import Edited
from iconjax.evaluation.methods import parse_method
from iconjax.evaluation.progress import Step
from iconjax.evaluation.record import read_record
from iconjax.evaluation.run import run_benchmark
from iconjax.evaluation.sheet import contact_sheets


class Editor:
    """Moves the red square as asked, counts its calls, and fails on cases that are named so."""

    def __init__(self) -> None:
        self.calls: list[str] = []

    def __call__(self, case: EvalCase) -> Edited:
        self.calls.append(case.id)
        if case.id.startswith("bad"):
            raise ZeroDivisionError("no such luck\nat all")
        return Edited({1: shift(20, 0)}, case.truth_image, details={"score": float("inf")})


def die_on_bad(case: EvalCase) -> Edited:
    if case.id.startswith("bad"):
        os._exit(9)
    return Edited({1: shift(20, 0)}, case.truth_image)


def start_slow_run(bench: Path, out: Path, jobs: int = 1) -> subprocess.Popen[str]:
    """A run in a process of its own, to be killed."""
    code = (
        f"import evaluation_support as s\nif __name__ == '__main__': s.run_slowly({str(bench)!r}, {str(out)!r}, {jobs})"
    )
    script = bench.parent / "run_slowly.py"
    script.write_text(code)
    return subprocess.Popen([sys.executable, str(script)], env=ENVIRONMENT, stdout=subprocess.PIPE, text=True)


def alive(pid: int) -> bool:
    """Whether a process still runs; one that nobody has waited for yet does not."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


@pytest.fixture
def bench(tmp_path: Path) -> Path:
    for name in ("a", "bad", "c"):
        write_case(tmp_path / "bench" / name)
    return tmp_path / "bench"


def test_a_bad_case_is_reported_and_the_rest_goes_on(bench: Path, tmp_path: Path) -> None:
    steps: list[Step] = []
    report = run_benchmark(bench, tmp_path / "out", [], editors={"fake": Editor()}, progress=steps.append)
    rows = {r.method: r for r in report.rows}
    assert (rows["fake"].cases, rows["fake"].failed) == (3, 1)
    fake, unedited = ({name: f and f.mean for name, f in rows[m].figures.items()} for m in ("fake", "unedited"))
    assert fake["satisfied"] is None
    assert fake["right"] == fake["goal"] == fake["coherence"] == pytest.approx(2 / 3)
    assert fake["CD"] == pytest.approx(unedited["CD"] / 3) and fake["MSE"] == pytest.approx(unedited["MSE"] / 3)
    assert unedited["right"] == 0 and unedited["coherence"] == 1
    assert [(step.done, step.total) for step in steps] == [(k, 9) for k in range(1, 10)]
    assert "6/9 fake: bad: failed: ZeroDivisionError: no such luck at all" in map(str, steps)
    assert [(r.case, r.method) for r in report.failures] == [("bad", "fake")]


def test_tables_and_settings_are_written(bench: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    report = run_benchmark(bench, out, [], editors={"fake": Editor()})
    assert (out / "table.md").read_text() == report.markdown()
    rows = list(csv.DictReader((out / "table.csv").open()))
    assert [row["method"] for row in rows] == ["unedited", "truth", "fake"]
    cases = [row for row in csv.DictReader((out / "cases.csv").open()) if row["method"] == "fake"]
    assert [row["right"] for row in cases] == ["1", "0", "1"] and "ZeroDivision" in cases[1]["trouble"]
    run = json.loads((out / "run.json").read_text())
    assert run["cases"] == ["a", "bad", "c"] and {"iconjax", "jax", "code"} <= set(run["versions"])
    assert run["state"] == "finished" and run["seeds"]["bootstrap"] > 0
    assert [method["name"] for method in run["methods"]] == ["unedited", "truth", "fake"]
    assert str(tmp_path) not in (out / "run.json").read_text()
    assert not [p for p in out.rglob("*") if p.name.startswith(".")]
    record = json.loads((out / "fake" / "a.json").read_text())
    assert record["right"] is True and record["details"] == {"score": None}


def test_finished_cases_are_not_run_again(bench: Path, tmp_path: Path) -> None:
    first, second = Editor(), Editor()
    before = run_benchmark(bench, tmp_path / "out", [], editors={"fake": first})
    after = run_benchmark(bench, tmp_path / "out", [], editors={"fake": second})
    assert first.calls == ["a", "bad", "c"]
    assert second.calls == ["bad"]
    again = [[r for r in report.records if r.case != "bad"] for report in (before, after)]
    assert again[0][-1].goal == again[1][-1].goal and again[0][-1].cd == again[1][-1].cd


@pytest.mark.parametrize("damage", [0, 1, 100, -2])
def test_a_half_written_record_is_run_again(bench: Path, tmp_path: Path, damage: int) -> None:
    run_benchmark(bench, tmp_path / "out", [], editors={"fake": Editor()})
    file = tmp_path / "out" / "fake" / "a.json"
    file.write_bytes(file.read_bytes()[:damage])
    assert read_record(file) is None
    editor = Editor()
    run_benchmark(bench, tmp_path / "out", [], editors={"fake": editor})
    assert editor.calls == ["a", "bad"]


def test_an_interrupted_run_goes_on_where_it_stopped(bench: Path, tmp_path: Path) -> None:
    def interrupted(case: EvalCase) -> Edited:
        if case.id == "bad":
            raise KeyboardInterrupt
        return Edited({}, case.image)

    with pytest.raises(KeyboardInterrupt):
        run_benchmark(bench, tmp_path / "out", [], editors={"fake": interrupted})
    editor = Editor()
    run_benchmark(bench, tmp_path / "out", [], editors={"fake": editor})
    assert editor.calls == ["bad", "c"]


def test_a_changed_case_is_run_again(bench: Path, tmp_path: Path) -> None:
    run_benchmark(bench, tmp_path / "out", [], editors={"fake": Editor()})
    checks = json.loads((bench / "c" / "checks.json").read_text())
    checks["goal"][0]["dx"] = [0, 1]
    (bench / "c" / "checks.json").write_text(json.dumps(checks))
    editor = Editor()
    report = run_benchmark(bench, tmp_path / "out", [], editors={"fake": editor})
    assert editor.calls == ["bad", "c"]
    assert not report.records[-1].right


def test_a_case_that_cannot_be_read_is_one_failed_case(bench: Path, tmp_path: Path) -> None:
    (bench / "bad" / "segmentation.png").write_bytes(b"no image")
    report = run_benchmark(bench, tmp_path / "out", [], editors={"fake": Editor()})
    broken = [r for r in report.records if r.case == "bad"]
    assert all(r.error and r.cd is None and not r.right for r in broken)
    assert {r.method: r.failed for r in report.rows} == {"unedited": 1, "truth": 1, "fake": 1}


def test_transforms_that_do_not_fit_are_that_case_s_failure(bench: Path, tmp_path: Path) -> None:
    def wrong(case: EvalCase) -> Edited:
        return Edited({1: np.full((2, 3), np.nan)}, case.image)

    report = run_benchmark(bench, tmp_path / "out", [], editors={"fake": wrong}, cases=["a"])
    assert report.records[-1].error == "transform of segment 1 is not a finite 2x3 matrix"


def test_a_process_that_dies_costs_only_its_own_case(bench: Path, tmp_path: Path) -> None:
    report = run_benchmark(bench, tmp_path / "out", [], editors={"fake": die_on_bad}, jobs=2)
    records = report.of("fake")
    assert [r.right for r in records] == [True, False, True]
    assert records[1].error == "RuntimeError: the process died"


def test_a_run_killed_in_the_middle_goes_on_where_it_stopped(tmp_path: Path) -> None:
    for k in range(8):
        write_case(tmp_path / "bench" / f"case-{k}")
    out = tmp_path / "out"
    child = start_slow_run(tmp_path / "bench", out)
    records = out / "slow"
    wait_until(lambda: child.poll() is not None or len(list(records.glob("*.json"))) >= 3)
    child.kill()
    child.communicate()
    kept = {path.stem: path.read_bytes() for path in records.glob("*.json")}
    assert 3 <= len(kept) < 8
    assert json.loads((out / "run.json").read_text())["state"] == "running"
    said, _ = start_slow_run(tmp_path / "bench", out).communicate(timeout=60)
    assert said.split() == sorted({f"case-{k}" for k in range(8)} - set(kept))
    assert {name: (records / f"{name}.json").read_bytes() for name in kept} == kept
    assert json.loads((out / "run.json").read_text())["state"] == "finished"
    assert len((out / "cases.csv").read_text().splitlines()) == 1 + 3 * 8


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="tells by /proc which processes are alive")
def test_processes_end_when_the_one_that_started_them_is_killed(tmp_path: Path) -> None:
    for k in range(6):
        write_case(tmp_path / "bench" / f"case-{k}")
    out = tmp_path / "out"
    child = start_slow_run(tmp_path / "bench", out, jobs=2)
    wait_until(lambda: child.poll() is not None or len(list(out.glob("slow/*.pid"))) >= 2)
    child.kill()
    child.wait()
    workers = {int(path.read_text()) for path in out.glob("slow/*.pid")}
    assert workers and child.pid not in workers
    wait_until(lambda: not any(map(alive, workers)), 10)
    left = [pid for pid in workers if alive(pid)]
    for pid in left:
        os.kill(pid, signal.SIGKILL)
    assert not left


def test_bad_arguments_are_errors_before_any_work(bench: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    with pytest.raises(ConfigError, match="unknown method 'oars'"):
        run_benchmark(bench, out, ["oars"])
    with pytest.raises(ConfigError, match="jobs is 0"):
        run_benchmark(bench, out, [], jobs=0)
    with pytest.raises(InputError, match="no such cases: z"):
        run_benchmark(bench, out, [], cases=["z"])
    assert not out.exists()
    out.write_text("a file")
    with pytest.raises(InputError, match="cannot make folder"):
        run_benchmark(bench, out, [])


def test_names_of_methods() -> None:
    method = parse_method("paper +program -RS")
    assert method.name == "paper -RS +program" and method.strategy == "paper" and method.translator == "program"
    assert not method.relation_search and method.motion_search
    assert parse_method("ours -MS -RS").strategy == "coherent"
    assert parse_method("ours", "offline").translator == "offline"
    assert parse_method("ours +program", "offline").translator == "program"
    assert parse_method("dm +image").image and parse_method("dm").translator == "llm-replay"
    assert parse_method("dc", "offline").translator == "llm-replay" and parse_method("dc", "llm").translator == "llm"
    for name in ("", "truth -MS", "ours -XS", "coherent", "dm -MS", "ours +image", "ours +program +offline"):
        with pytest.raises(ConfigError, match="unknown method"):
            parse_method(name)


def test_contact_sheet(bench: Path, tmp_path: Path) -> None:
    run_benchmark(bench, tmp_path / "out", [], editors={"fake": Editor()})
    paths = contact_sheets(tmp_path / "out", tmp_path / "sheet.png", method="fake", rows=2)
    assert [p.name for p in paths] == ["sheet-1.png", "sheet-2.png"] and all(p.exists() for p in paths)
    (one,) = contact_sheets(tmp_path / "out", tmp_path / "wrong.png", method="fake", only="wrong")
    assert one.exists()
    with pytest.raises(InputError, match="no method 'x'"):
        contact_sheets(tmp_path / "out", tmp_path / "sheet.png", method="x")
    with pytest.raises(InputError, match="no finished run"):
        contact_sheets(bench, tmp_path / "sheet.png")
