"""Chamfer distance, mean squared error, and whether a program holds."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from evaluation_support import scale, shift, write_case

from iconjax.errors import InputError
from iconjax.evaluation.cases import list_cases, load_eval_case
from iconjax.evaluation.metrics import chamfer, mse, satisfied
from iconjax.search.types import ConstraintReport


def report(violation: float, unit: str) -> ConstraintReport:
    return ConstraintReport("touch(...)", "primary", violation, unit, satisfied=True)


def test_chamfer_of_far_squares_is_their_distance_in_sides(tmp_path: Path) -> None:
    case = load_eval_case(write_case(tmp_path / "a"))
    # Red squares of side 10, 1000 apart: mean nearest distance about 1000 each way; green is equal.
    far = chamfer(case, {1: shift(1020, 0)})
    assert far == pytest.approx(2 * 1000 / 10 / 2, rel=0.01)


def test_chamfer_divides_by_the_box_of_the_solution(tmp_path: Path) -> None:
    case = load_eval_case(write_case(tmp_path / "a"))
    twice = chamfer(case, {1: scale(2, 2) @ np.vstack([shift(520, 0), [0, 0, 1]])}, {1: scale(2, 2)})
    assert twice == pytest.approx(chamfer(case, {1: shift(520, 0)}, {}), rel=0.05)


def test_chamfer_survives_a_solution_without_size(tmp_path: Path) -> None:
    case = load_eval_case(write_case(tmp_path / "a"))
    assert np.isfinite(chamfer(case, {}, {1: scale(0, 0)}))


def test_mse() -> None:
    black, grey = np.zeros((4, 5, 3), np.uint8), np.full((4, 5, 3), 200, np.uint8)
    assert mse(black, grey) == mse(grey, black) == 200**2
    with pytest.raises(InputError, match="shape"):
        mse(black, grey[:3])


@pytest.mark.parametrize(
    ("violation", "unit", "size", "holds"),
    [
        (5.1, "px", 512, True),
        (5.2, "px", 512, False),
        (5.2, "px", 1024, True),
        (2.0, "deg", 512, True),
        (2.1, "deg", 1024, False),
        (0.02, "", 512, False),
        (600.0, "px2", 512, True),
        (700.0, "px2", 512, False),
        (float("nan"), "px", 512, False),
        (float("inf"), "deg", 512, False),
    ],
)
def test_satisfied(violation: float, unit: str, size: int, holds: bool) -> None:
    assert satisfied([report(0.0, "px"), report(violation, unit)], size) is holds


def test_a_broken_case_says_what_is_wrong(tmp_path: Path) -> None:
    folder = write_case(tmp_path / "a")
    (folder / "checks.json").write_text("{")
    with pytest.raises(InputError, match=r"case a: checks.json is not JSON"):
        load_eval_case(folder)
    (folder / "checks.json").write_text("{}")
    with pytest.raises(InputError, match=r"case a: 'goal' is missing"):
        load_eval_case(folder)
    (folder / "ground_truth.json").unlink()
    with pytest.raises(InputError, match=r"case a: cannot read ground_truth.json"):
        load_eval_case(folder)


def test_a_case_folder_is_a_benchmark_of_one(tmp_path: Path) -> None:
    folder = write_case(tmp_path / "a")
    assert list_cases(folder) == list_cases(tmp_path) == (folder,)
    with pytest.raises(InputError, match="no case folders"):
        list_cases(folder / "nothing")
