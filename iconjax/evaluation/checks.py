"""Judging an edit by the checks of a case: does it do what was asked, and is the picture still coherent?"""

from __future__ import annotations

import inspect
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from iconjax.errors import InputError
from iconjax.evaluation import kinds
from iconjax.evaluation.affine import Transforms
from iconjax.evaluation.cases import EvalCase
from iconjax.evaluation.stage import Stage


@dataclass(frozen=True)
class CheckResult:
    """How one check came out.

    Attributes:
        kind: type of the check, e.g. "ratio".
        text: what it asks for.
        passed: whether it holds.
        value: what was measured (of several parts or conditions: of the worst).
        limit: the bound or the number that `value` is held against.
        detail: the finding in words.
    """

    kind: str
    text: str
    passed: bool
    value: float
    limit: float
    detail: str

    def __str__(self) -> str:
        return f"{'ok  ' if self.passed else 'FAIL'} {self.text}: {self.detail}"


@dataclass(frozen=True)
class Verdict:
    """All checks of a case.

    Attributes:
        goal: is what was asked for done?
        coherence: is the rest of the picture as it should be?
    """

    goal: tuple[CheckResult, ...]
    coherence: tuple[CheckResult, ...]

    @property
    def goal_met(self) -> bool:
        """Whether every goal check passes."""
        return all(check.passed for check in self.goal)

    @property
    def coherent(self) -> bool:
        """Whether every coherence check passes."""
        return all(check.passed for check in self.coherence)

    @property
    def right(self) -> bool:
        """Whether everything passes."""
        return self.goal_met and self.coherent

    @property
    def failed(self) -> tuple[CheckResult, ...]:
        """The checks that do not pass, goal first."""
        return tuple(check for check in (*self.goal, *self.coherence) if not check.passed)


def judge(case: EvalCase, transforms: Transforms) -> Verdict:
    """Run all checks of a case on an edit.

    Args:
        case: the case.
        transforms: segment id -> 2x3 matrix in pixels; a segment left out stays.

    Raises:
        InputError: transforms that do not fit, or a check that cannot be read.
    """
    stage = Stage(case.size, case.outlines, case.labels, transforms)
    return Verdict(run_checks(stage, case.goal), run_checks(stage, case.coherence))


def run_checks(stage: Stage, checks: Sequence[Mapping[str, Any]]) -> tuple[CheckResult, ...]:
    """Run checks in order; see `run_check`."""
    return tuple(run_check(stage, check) for check in checks)


def run_check(stage: Stage, check: Mapping[str, Any]) -> CheckResult:
    """Run one check, given as in `checks.json`: its type under "t" and the fields of that type.

    Raises:
        InputError: unknown type, missing or unknown field, unknown name.
    """
    fields = dict(check)
    kind = fields.pop("t", None)
    function = kinds.KINDS.get(kind)
    if function is None:
        raise InputError(f"unknown check type {kind!r}; there are {', '.join(kinds.KINDS)}")
    try:
        inspect.signature(function).bind(stage, **fields)
    except TypeError as error:
        raise InputError(f"check {kind!r}: {error}") from error
    finding = function(stage, **fields)
    value, limit = float(finding.value), float(finding.limit)
    return CheckResult(kind, finding.text, bool(finding.passed), value, limit, finding.detail)
