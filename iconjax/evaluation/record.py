"""The record of one method on one case: made by scoring an edit, kept as JSON, read again to go on later."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass, field, fields, replace
from pathlib import Path
from typing import Any, TypeVar

from iconjax.errors import IconjaxError
from iconjax.evaluation.affine import read_transforms
from iconjax.evaluation.cases import EvalCase
from iconjax.evaluation.checks import CheckResult, Verdict, judge
from iconjax.evaluation.editors import Edited
from iconjax.evaluation.metrics import chamfer, holds, mse, satisfied
from iconjax.files import write_text

FORMAT = 2
"""Version of the record's file format."""

T = TypeVar("T")


@dataclass(frozen=True)
class Violation:
    """How far a constraint of the reference program is from holding.

    Attributes:
        text: the constraint.
        amount, unit: by how much it is missed.
        holds: whether that is within the tolerance of the metric.
    """

    text: str
    amount: float
    unit: str
    holds: bool


@dataclass(frozen=True)
class CaseRecord:
    """How a method did on a case.

    Attributes:
        case, method: their names.
        fingerprint: of everything that the result depends on; a record with another one is out of date.
        cd: relative Chamfer distance; None where the case itself could not be read.
        mse: mean squared error of the picture; None where none was drawn.
        satisfied: whether the reference program holds; None where nobody measured.
        goal, coherence: the checks.
        seconds: time the edit took.
        transforms: segment id -> 2x3 matrix.
        violations: the reference program, constraint by constraint; empty where nobody measured.
        error: why there is no edit; the numbers are then those of the unedited picture, and nothing is right.
        details: further facts from the method.
    """

    case: str
    method: str
    fingerprint: str
    cd: float | None
    mse: float | None
    satisfied: bool | None
    goal: tuple[CheckResult, ...]
    coherence: tuple[CheckResult, ...]
    seconds: float
    transforms: Mapping[str, list[list[float]]]
    violations: tuple[Violation, ...] = ()
    error: str | None = None
    details: Mapping[str, Any] = field(default_factory=dict)

    @property
    def verdict(self) -> Verdict:
        """The checks together."""
        return Verdict(self.goal, self.coherence)

    @property
    def goal_met(self) -> bool:
        """Whether the edit does what was asked."""
        return self.error is None and self.verdict.goal_met

    @property
    def coherent(self) -> bool:
        """Whether the edit leaves a coherent picture."""
        return self.error is None and self.verdict.coherent

    @property
    def right(self) -> bool:
        """Whether the edit passes all checks."""
        return self.goal_met and self.coherent


ROWS: dict[str, Callable[..., Any]] = {"goal": CheckResult, "coherence": CheckResult, "violations": Violation}
"""Fields of a record that are tables, and what their rows are."""


def score(case: EvalCase, method: str, edited: Edited, seconds: float = 0.0, fingerprint: str = "") -> CaseRecord:
    """Score an edit by all metrics.

    Args:
        case, method: whose edit it is.
        edited: the edit.
        seconds: time that the editor took, where the edit itself does not know.
        fingerprint: of everything that the edit depends on.

    Raises:
        InputError: transforms or a picture that do not fit the case.
    """
    matrices = read_transforms(edited.transforms, sorted(case.labels))
    verdict = judge(case, matrices)
    reports = edited.constraints
    return CaseRecord(
        case=case.id,
        method=method,
        fingerprint=fingerprint,
        cd=chamfer(case, matrices),
        mse=None if edited.image is None else mse(edited.image, case.truth_image),
        satisfied=None if reports is None else satisfied(reports, max(case.size)),
        goal=verdict.goal,
        coherence=verdict.coherence,
        seconds=seconds if edited.seconds is None else edited.seconds,
        transforms={str(key): matrix.tolist() for key, matrix in matrices.items()},
        violations=tuple(
            Violation(r.text, float(r.violation), r.unit, holds(r, max(case.size))) for r in reports or ()
        ),
        details=dict(edited.details),
    )


def failure(case: EvalCase | str, method: str, error: BaseException, seconds: float = 0.0) -> CaseRecord:
    """Record of a case that a method could not edit, or (given by name) of one that could not be read."""
    text = str(error) if isinstance(error, IconjaxError) else f"{type(error).__name__}: {error}"
    text = " ".join(text.split()).removesuffix(":")
    if isinstance(case, str):
        return CaseRecord(case, method, "", None, None, False, (), (), seconds, {}, error=text)
    return replace(score(case, method, Edited({}, case.image), seconds), satisfied=False, error=text)


def write_record(path: Path, record: CaseRecord) -> None:
    """Write a record; the file appears whole or not at all."""
    data = {"format": FORMAT, **_fields(record), "right": record.right}
    data |= {name: [asdict(item) for item in getattr(record, name)] for name in ROWS}
    write_text(path, json.dumps(_plain(data), indent=1, ensure_ascii=False, allow_nan=False) + "\n")


def read_record(path: Path) -> CaseRecord | None:
    """Read a record; None where there is none that is whole and of this format."""
    with suppress(OSError, ValueError, TypeError, KeyError):
        data = json.loads(path.read_text(encoding="utf-8"))
        if data.pop("format") == FORMAT:
            data.pop("right")
            data |= {name: _rows(data[name], kind) for name, kind in ROWS.items()}
            return CaseRecord(**data)
    return None


def _rows(rows: list[dict[str, Any]], kind: Callable[..., T]) -> tuple[T, ...]:
    # What JSON has no number for was written as null.
    rows = [{key: math.inf if value is None else value for key, value in row.items()} for row in rows]
    return tuple(kind(**row) for row in rows)


def _fields(record: CaseRecord) -> dict[str, Any]:
    return {item.name: getattr(record, item.name) for item in fields(record)}


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
