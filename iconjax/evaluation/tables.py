"""The tables of a benchmark as Markdown, the paper's figures alongside."""

from __future__ import annotations

from collections.abc import Sequence

from iconjax.evaluation.bootstrap import LEVEL
from iconjax.evaluation.paper import published
from iconjax.evaluation.summary import METRICS, STAGES, USAGE, Comparison, Row

Cells = tuple[str, ...]

RESULT_HEAD = ("method", "cases", "failed", *METRICS, "paper: CD", "paper: MSE")

NOTE = (
    f"Means over cases with {LEVEL:.0%} intervals (bootstrap over cases). A failed case counts as not right and, for "
    "CD and MSE, as unedited. The paper's figures are for other icons, requests and language models."
)


def result_table(rows: Sequence[Row]) -> str:
    """One row for each method: all metrics with their intervals."""
    return markdown_table(RESULT_HEAD, [result_cells(row) for row in rows])


def result_cells(row: Row) -> Cells:
    """A row of the main table."""
    figures = [(row.figures[name], style) for name, style in METRICS.items()]
    paper = published(row.method)
    return (
        row.method,
        str(row.cases),
        str(row.failed),
        *("" if figure is None else figure.text(style) for figure, style in figures),
        paper.cd if paper else "",
        paper.mse if paper else "",
    )


def time_table(rows: Sequence[Row]) -> str:
    """Seconds a case by stage; empty where nobody measured any stage."""
    timed = [row for row in rows if any(stage in row.seconds for stage in STAGES)]
    body = [(row.method, *(_number(row.seconds.get(s), ".2f") for s in (*STAGES, "total"))) for row in timed]
    return markdown_table(("seconds a case", *STAGES, "total"), body) if timed else ""


def usage_table(rows: Sequence[Row]) -> str:
    """What a case costs in calls, characters and tokens; empty where no language model was asked."""
    asked = [row for row in rows if row.usage]
    names = [name for name in USAGE if any(row.usage.get(name) for row in asked)]
    body = [
        (row.method, *(_number(row.usage.get(n) or None, ".0f" if n != "calls" else ".2f") for n in names))
        for row in asked
    ]
    return markdown_table(("asked, a case", *(name.replace("_", " ") for name in names)), body) if asked else ""


def comparison_table(comparisons: Sequence[Comparison]) -> str:
    """The first method against each other one; empty where there is none."""
    if not comparisons:
        return ""
    first = comparisons[0].first
    head = (f"{first} against", "ratio of CD", f"right: only {first}", "right: only this", "right: both")
    body = [
        (c.method, "" if c.cd is None else c.cd.text(".2f"), str(c.only_first), str(c.only_method), str(c.both))
        for c in comparisons
    ]
    return markdown_table(head, body)


def markdown_table(head: Sequence[str], body: Sequence[Sequence[str]]) -> str:
    """A table, the first column to the left and all others to the right."""
    lines = [head, ("---", *("---:",) * (len(head) - 1)), *body]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def _number(value: float | None, style: str) -> str:
    return "" if value is None else format(value, style)
