"""A method in numbers: means over its cases, each with a bootstrap interval, and two methods held side by side."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from iconjax.evaluation.bootstrap import Figure, mean_over_cases, ratio_of_means
from iconjax.evaluation.record import CaseRecord

METRICS = {"CD": ".3f", "MSE": ".0f", "satisfied": ".3f", "goal": ".3f", "coherence": ".3f", "right": ".3f"}
"""Metric -> how it is written. CD and MSE are means, the others shares of cases."""

STAGES = ("translate", "compile", "search", "render")
"""Stages of an edit; what their times leave of the total is reading the picture and the like."""

USAGE = (
    *("calls", "prompt_characters", "reply_characters"),
    *("input_tokens", "output_tokens", "cache_read_tokens", "cache_write_tokens"),
)
"""What asking a language model takes; characters are always known, tokens where the replies say."""


@dataclass(frozen=True)
class Row:
    """One method in numbers; a share counts all its cases, and a failed case counts as not met.

    Attributes:
        method: its name.
        cases: how many cases were run.
        failed: how many gave an error; for CD and MSE such a case counts as unedited.
        figures: by the names in `METRICS`; None where no case has the number.
        seconds: mean time of each stage that was measured, and of the whole edit as "total".
        usage: means of `USAGE`; empty where no language model was asked.
    """

    method: str
    cases: int
    failed: int
    figures: Mapping[str, Figure | None]
    seconds: Mapping[str, float]
    usage: Mapping[str, float]


@dataclass(frozen=True)
class Comparison:
    """A method held against the first one, over the cases that both have.

    Attributes:
        first, method: their names.
        cd: CD of the first, divided by that of the method.
        only_first, only_method, both: how many cases are right by the first alone, by the method alone, by both.
    """

    first: str
    method: str
    cd: Figure | None
    only_first: int
    only_method: int
    both: int


def summarise(method: str, records: Sequence[CaseRecord]) -> Row:
    """Bring the records of a method to one row."""
    measured = any(r.satisfied is not None and r.error is None for r in records)
    satisfied = [float(r.satisfied) for r in records if r.satisfied is not None]
    values: dict[str, list[float]] = {
        "CD": [r.cd for r in records if r.cd is not None],
        "MSE": [r.mse for r in records if r.mse is not None],
        "satisfied": satisfied if measured else [],
        "goal": [float(r.goal_met) for r in records],
        "coherence": [float(r.coherent) for r in records],
        "right": [float(r.right) for r in records],
    }
    return Row(
        method=method,
        cases=len(records),
        failed=sum(r.error is not None for r in records),
        figures={name: mean_over_cases(values[name]) for name in METRICS},
        seconds=mean_seconds(records),
        usage=_mean_usage(records),
    )


def mean_seconds(records: Sequence[CaseRecord]) -> dict[str, float]:
    """Mean time of each stage, over the cases that measured it, and of the whole edit; what failed is left out."""
    rows = [numbers_of(r, "timings") | {"total": r.seconds} for r in records if r.error is None]
    return _means(rows, (*STAGES, "total"))


def numbers_of(record: CaseRecord, name: str) -> dict[str, float]:
    """A table of numbers among a record's details; empty where there is none."""
    found: Any = record.details.get(name)
    if not isinstance(found, Mapping):
        return {}
    return {str(k): float(v) for k, v in found.items() if isinstance(v, (int, float))}


def compare(first: Sequence[CaseRecord], others: Sequence[CaseRecord]) -> Comparison | None:
    """Hold a method against the first one; None where they share no case."""
    mine = {r.case: r for r in first if r.cd is not None}
    pairs = [(mine[r.case], r) for r in others if r.case in mine and r.cd is not None]
    if not pairs:
        return None
    right = [(a.right, b.right) for a, b in pairs]
    return Comparison(
        first=pairs[0][0].method,
        method=pairs[0][1].method,
        cd=ratio_of_means([a.cd or 0.0 for a, _ in pairs], [b.cd or 0.0 for _, b in pairs]),
        only_first=right.count((True, False)),
        only_method=right.count((False, True)),
        both=right.count((True, True)),
    )


def _mean_usage(records: Sequence[CaseRecord]) -> dict[str, float]:
    rows = [numbers_of(r, "usage") for r in records]
    return _means([row for row in rows if any(row.values())], USAGE)


def _means(rows: Sequence[Mapping[str, float]], names: Sequence[str]) -> dict[str, float]:
    columns = {name: [row[name] for row in rows if name in row] for name in names}
    return {name: sum(column) / len(column) for name, column in columns.items() if column}
