"""Everything a benchmark found, and the files that tell it: tables, one row a case, and a page to look at."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from iconjax.evaluation.methods import BASELINES
from iconjax.evaluation.record import CaseRecord
from iconjax.evaluation.summary import METRICS, STAGES, USAGE, Comparison, Row, compare, numbers_of, summarise
from iconjax.evaluation.tables import NOTE, comparison_table, result_table, time_table, usage_table
from iconjax.files import write_text

CASE_HEAD = (
    *("case", "method", "CD", "MSE", "satisfied", "right", "goal", "coherence", "seconds"),
    *(*STAGES, *USAGE, "trouble"),
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

    def of(self, method: str) -> tuple[CaseRecord, ...]:
        """The records of a method."""
        return tuple(record for record in self.records if record.method == method)

    @property
    def rows(self) -> tuple[Row, ...]:
        """One row for each method."""
        return tuple(summarise(name, self.of(name)) for name in self.methods)

    @property
    def comparisons(self) -> tuple[Comparison, ...]:
        """The first method against all others but the solution itself."""
        first, *others = self.methods
        if first in BASELINES:
            return ()
        pairs = (compare(self.of(first), self.of(name)) for name in others if name != "truth")
        return tuple(pair for pair in pairs if pair is not None)

    @property
    def failures(self) -> tuple[CaseRecord, ...]:
        """What gave an error."""
        return tuple(record for record in self.records if record.error is not None)

    def markdown(self) -> str:
        """All tables as Markdown."""
        rows = self.rows
        parts = [result_table(rows), NOTE + "\n", comparison_table(self.comparisons), time_table(rows)]
        return "\n".join(part for part in (*parts, usage_table(rows)) if part)


def write_report(out: Path, report: Report, cases: Sequence[Path]) -> None:
    """Write `table.md`, `table.csv`, `cases.csv` and `report.html`.

    Args:
        out: folder of the run.
        report: what it found.
        cases: the case folders, for the page's pictures.

    Raises:
        InputError: the folder cannot be written.
    """
    from iconjax.evaluation.page import benchmark_page  # here, because it needs this module

    write_text(out / "table.md", report.markdown())
    write_text(out / "table.csv", _csv(row_cells(report.rows)))
    write_text(out / "cases.csv", _csv([CASE_HEAD, *(case_cells(record) for record in report.records)]))
    write_text(out / "report.html", benchmark_page(out, report, cases))


def row_cells(rows: Sequence[Row]) -> list[tuple[str, ...]]:
    """The rows as plain numbers for `table.csv`, with the ends of each interval."""
    ends = [f"{name}{end}" for name in METRICS for end in ("", " low", " high")]
    table = [("method", "cases", "failed", *ends, *STAGES, "seconds", *USAGE)]
    for row in rows:
        numbers: list[float | None] = []
        for name in METRICS:
            figure = row.figures[name]
            numbers += [None] * 3 if figure is None else [figure.mean, figure.low, figure.high]
        numbers += [row.seconds.get(name) for name in (*STAGES, "total")]
        numbers += [row.usage.get(name) for name in USAGE]
        table.append((row.method, str(row.cases), str(row.failed), *(_number(n, ".5g") for n in numbers)))
    return table


def case_cells(record: CaseRecord) -> tuple[str, ...]:
    """A record as a row of `cases.csv`."""
    flags = (record.satisfied, record.right, record.goal_met, record.coherent)
    stages, usage = numbers_of(record, "timings"), numbers_of(record, "usage")
    return (
        record.case,
        record.method,
        _number(record.cd, ".4f"),
        _number(record.mse, ".1f"),
        *("" if flag is None else str(int(flag)) for flag in flags),
        f"{record.seconds:.2f}",
        *(_number(stages.get(name), ".3f") for name in STAGES),
        *(_number(usage.get(name), ".0f") for name in USAGE),
        "; ".join(trouble(record)),
    )


def trouble(record: CaseRecord) -> list[str]:
    """What is wrong with an edit: its error, the constraints missed, the checks not passed."""
    if record.error is not None:
        return [record.error]
    missed = [f"{v.text} missed by {v.amount:.3g} {v.unit}".rstrip() for v in record.violations if not v.holds]
    return missed + [f"{check.text}: {check.detail}" for check in record.verdict.failed]


def _csv(rows: Sequence[Sequence[str]]) -> str:
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerows(rows)
    return stream.getvalue()


def _number(value: float | None, style: str) -> str:
    return "" if value is None else format(value, style)
