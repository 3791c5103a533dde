"""The checks of the benchmark: every solution passes, doing nothing or something lazy does not."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from evaluation_support import BENCHMARK, scale, shift, turn

from iconjax.evaluation.cases import EvalCase, list_cases, load_eval_case
from iconjax.evaluation.checks import judge
from iconjax.evaluation.metrics import chamfer, mse

FOLDERS = list_cases(BENCHMARK)

# What somebody might do to the whole picture without reading the request.
LAZY = {
    "mirrored": scale(-1, 1, (256, 0)),
    "shrunk": scale(0.5, 0.5, (256, 256)),
    "turned over": turn(180, (256, 256)),
    "pushed out": shift(600, 0),
}


@cache
def case_of(folder: Path) -> EvalCase:
    return load_eval_case(folder)


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda f: f.name)
def test_the_solution_passes_every_check(folder: Path) -> None:
    case = case_of(folder)
    verdict = judge(case, case.truth)
    assert verdict.right, "\n".join(map(str, verdict.failed))
    assert chamfer(case, case.truth) == 0
    assert mse(case.truth_image, case.truth_image) == 0


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda f: f.name)
def test_doing_nothing_misses_the_goal(folder: Path) -> None:
    case = case_of(folder)
    assert not judge(case, {}).goal_met
    assert chamfer(case, {}) > 0


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda f: f.name)
def test_lazy_edits_are_not_right(folder: Path) -> None:
    case = case_of(folder)
    right = [n for n, m in LAZY.items() if judge(case, dict.fromkeys(case.labels, np.array(m))).right]
    assert not right


@pytest.mark.parametrize(
    ("name", "left_out"),
    [
        ("android-short-body", "Android:Head"),
        ("cake-sponge-half", "Sprinkles:3"),
        ("umbrella-45", "Umbrella:Pole"),
        ("truck-cargo-shorter", "Truck:Rear Hub"),
    ],
)
def test_forgetting_a_part_is_not_coherent(name: str, left_out: str) -> None:
    case = case_of(BENCHMARK / name)
    kept = {key: matrix for key, matrix in case.truth.items() if case.labels[key] != left_out}
    assert len(kept) < len(case.truth)
    verdict = judge(case, kept)
    assert verdict.goal_met or left_out == "Umbrella:Pole"
    assert not verdict.coherent
