"""Tables of a benchmark: one row for each method, and one for each case and method."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from iconjax.evaluation.record import CaseRecord
from iconjax.files import write_text

COLUMNS = ("method", "cases", "failed", "CD", "MSE", "satisfied", "right", "goal", "coherence", "seconds")


@dataclass(frozen=True)
class Row:
    """One method in numbers; a share counts all its cases, and a failed case counts as not met.

    Attributes:
        method: its name.
        cases: how many cases were run.
        failed: how many gave an error; for CD and MSE such a case counts as unedited.
        cd, mse: means over the cases that have the number; None where none has.
        satisfied, right, goal, coherence: shares of cases, 0..1; `satisfied` is None where nobody measured.
        seconds: mean time of an edit.
    """

    method: str
    cases: int
    failed: int
    cd: float | None
    mse: float | None
    satisfied: float | None
    right: float | None
    goal: float | None
    coherence: float | None
    seconds: float | None

    def cells(self) -> tuple[str, ...]:
        """The row as text, in the order of `COLUMNS`."""
        shares = (self.satisfied, self.right, self.goal, self.coherence)
        return (
            self.method,
            str(self.cases),
            str(self.failed),
            _number(self.cd, ".3f"),
            _number(self.mse, ".0f"),
            *(_number(share, ".3f") for share in shares),
            _number(self.seconds, ".1f"),
        )


@dataclass(frozen=True)
class Report:
    """Everything a benchmark found.

    Attributes:
        records: one for each case and method.
        methods: the methods in the order of the table.
    """

    records: tuple[CaseRecord, ...]
    methods: tuple[str, ...]

    @property
    def rows(self) -> tuple[Row, ...]:
        """One row for each method."""
        return tuple(summarise(name, [r for r in self.records if r.method == name]) for name in self.methods)

    def markdown(self) -> str:
        """The rows as a Markdown table."""
        lines = [COLUMNS, ("---",) + ("---:",) * (len(COLUMNS) - 1), *(row.cells() for row in self.rows)]
        return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def summarise(method: str, records: Sequence[CaseRecord]) -> Row:
    """Bring the records of a method to one row."""
    measured = any(r.satisfied is not None and r.error is None for r in records)
    satisfied = [float(r.satisfied) for r in records if r.satisfied is not None]
    return Row(
        method=method,
        cases=len(records),
        failed=sum(r.error is not None for r in records),
        cd=_mean([r.cd for r in records if r.cd is not None]),
        mse=_mean([r.mse for r in records if r.mse is not None]),
        satisfied=_mean(satisfied) if measured else None,
        right=_mean([float(r.right) for r in records]),
        goal=_mean([float(r.goal_met) for r in records]),
        coherence=_mean([float(r.coherent) for r in records]),
        seconds=_mean([r.seconds for r in records]),
    )


def case_cells(record: CaseRecord) -> tuple[str, ...]:
    """A record as a row of `cases.csv`."""
    trouble = record.error or "; ".join(f"{check.text}: {check.detail}" for check in record.verdict.failed)
    flags = (record.satisfied, record.right, record.goal_met, record.coherent)
    return (
        record.case,
        record.method,
        _number(record.cd, ".4f"),
        _number(record.mse, ".1f"),
        *("" if flag is None else str(int(flag)) for flag in flags),
        f"{record.seconds:.2f}",
        trouble,
    )


def write_report(out: Path, report: Report) -> None:
    """Write `table.md`, `table.csv` and `cases.csv`.

    Raises:
        InputError: the folder cannot be written.
    """
    write_text(out / "table.md", report.markdown())
    write_text(out / "table.csv", _csv([COLUMNS, *(row.cells() for row in report.rows)]))
    head = ("case", "method", "CD", "MSE", "satisfied", "right", "goal", "coherence", "seconds", "trouble")
    write_text(out / "cases.csv", _csv([head, *(case_cells(record) for record in report.records)]))


def _csv(rows: Sequence[Sequence[str]]) -> str:
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerows(rows)
    return stream.getvalue()


def _mean(values: Sequence[float]) -> float | None:
    return sum(values) / len(values) if values else None


def _number(value: float | None, style: str) -> str:
    return "" if value is None else format(value, style)
