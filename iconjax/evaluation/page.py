"""The report page: one self-contained HTML file, a row a case, each method's picture beside the solution."""

from __future__ import annotations

import base64
import io
from collections.abc import Sequence
from html import escape
from pathlib import Path

import numpy as np
from jaxtyping import UInt8
from PIL import Image

from iconjax.errors import InputError
from iconjax.evaluation.bootstrap import Figure
from iconjax.evaluation.cases import EvalCase, load_eval_case, read_image
from iconjax.evaluation.fingerprint import versions
from iconjax.evaluation.methods import BASELINES, folder_name
from iconjax.evaluation.page_style import SCRIPT, STYLE
from iconjax.evaluation.paper import published
from iconjax.evaluation.record import CaseRecord
from iconjax.evaluation.report import Report, trouble
from iconjax.evaluation.summary import METRICS, Row, numbers_of
from iconjax.evaluation.tables import NOTE, comparison_table, time_table, usage_table

SIDE = 256
"""Larger side of an embedded picture in pixels."""

ORDERS = {
    "worst": "worst first", "best": "best first", "cd": "largest CD", "slow": "slowest", "tokens": "most tokens",
    "apart": "where methods differ", "name": "name",
}  # fmt: skip


def benchmark_page(out: Path, report: Report, cases: Sequence[Path]) -> str:
    """The page as HTML text; nothing in it is loaded from elsewhere.

    Args:
        out: folder of the run, for the methods' pictures.
        report: what the run found.
        cases: the case folders, for the pictures before and of the solution.
    """
    methods = [name for name in report.methods if name not in BASELINES] or list(report.methods)
    heads = "".join(f'<th data-method="{k}">{escape(name)}</th>' for k, name in enumerate(methods))
    rows = "".join(_case_row(folder, out, report, methods) for folder in cases)
    return "".join(
        (
            '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>iconjax: {len(cases)} cases</title><style>{STYLE}</style></head>\n<body>\n",
            _header(report, len(cases)),
            _controls(methods),
            f'<table class="cases"><thead><tr><th>case</th><th>before</th><th>one solution</th>{heads}</tr></thead>',
            f"<tbody>\n{rows}</tbody></table>\n",
            _footer(),
            '<dialog><p></p><div class="strip"></div></dialog>',
            f"<script>{SCRIPT}</script></body></html>\n",
        )
    )


def _header(report: Report, count: int) -> str:
    rows = report.rows
    tables = (_result_table(rows), *map(_html, (comparison_table(report.comparisons), time_table(rows))))
    return (
        f"<header><h1>{count} case{'s' * (count != 1)}, {len(rows)} methods</h1><p>{escape(NOTE)}</p>"
        f"{''.join(tables)}{_html(usage_table(rows))}</header>\n"
    )


def _result_table(rows: Sequence[Row]) -> str:
    head = "".join(f"<th>{name}</th>" for name in ("method", "cases", "failed", *METRICS, "paper: CD", "paper: MSE"))
    lines = []
    for row in rows:
        paper = published(row.method)
        cells = [row.method, str(row.cases), str(row.failed)]
        figures = [_figure(row.figures[name], style) for name, style in METRICS.items()]
        ends = (paper.cd, paper.mse) if paper else ("", "")
        lines.append("".join(f"<td>{cell}</td>" for cell in (*map(escape, cells), *figures, *ends)))
    body = "".join(f"<tr>{line}</tr>" for line in lines)
    return f'<div class="numbers"><table><tr>{head}</tr>{body}</table></div><br>'


def _figure(figure: Figure | None, style: str) -> str:
    if figure is None:
        return ""
    return f"{figure.mean:{style}}<small>{figure.low:{style}} to {figure.high:{style}}</small>"


def _html(markdown: str) -> str:
    """A Markdown table of ours as HTML."""
    if not markdown:
        return ""
    lines = [line.strip("|\n ").split(" | ") for line in markdown.strip().split("\n")]
    head = "".join(f"<th>{escape(cell)}</th>" for cell in lines[0])
    body = "".join("<tr>" + "".join(f"<td>{escape(c)}</td>" for c in line) + "</tr>" for line in lines[2:])
    return f'<div class="numbers"><table><tr>{head}</tr>{body}</table></div>'


def _controls(methods: Sequence[str]) -> str:
    def select(name: str, options: Sequence[tuple[str, str]]) -> str:
        inner = "".join(f'<option value="{value}">{escape(text)}</option>' for value, text in options)
        return f'<select name="{name}">{inner}</select>'

    numbered = [(str(k), name) for k, name in enumerate(methods)]
    boxes = "".join(
        f'<label><input type="checkbox" value="{k}" checked> {escape(name)}</label>' for k, name in numbered
    )
    only = [("all", "all cases"), ("wrong", "not right"), ("right", "right")]
    return (
        f"<nav><label>Sort {select('sort', list(ORDERS.items()))}</label>"
        f"<label>judged by {select('judge', numbered)}</label><label>Show {select('only', only)}</label>"
        f'<fieldset>{boxes}</fieldset><span id="shown"></span></nav>\n'
    )


def _case_row(folder: Path, out: Path, report: Report, methods: Sequence[str]) -> str:
    records = {record.method: record for record in report.records if record.case == folder.name}
    try:
        case: EvalCase | None = load_eval_case(folder)
        pictures = [(case.image, "before"), (case.truth_image, "one solution")] if case else []
    except InputError:
        case, pictures = None, []
    shown = [_picture(image, name) for image, name in pictures] or [_nothing(), _nothing()]
    cells = "".join(
        _method_cell(k, records[name], out / folder_name(name) / f"{folder.name}.png")
        for k, name in enumerate(methods)
        if name in records
    )
    first = _case_cell(folder.name, case)
    return f'<tr id="{escape(folder.name)}">{first}{"".join(f"<td>{p}</td>" for p in shown)}{cells}</tr>\n'


def _case_cell(name: str, case: EvalCase | None) -> str:
    if case is None:
        return f'<td><b>{escape(name)}</b><div class="request">cannot be read</div></td>'
    program = _program("reference program", case.program.strip().split("\n")) if case.program else ""
    return f'<td><b>{escape(name)}</b><div class="request">{escape(case.request)}</div>{program}</td>'


def _method_cell(number: int, record: CaseRecord, png: Path) -> str:
    tokens = sum(n for name, n in numbers_of(record, "usage").items() if name.endswith("tokens"))
    data = {
        "method": number, "right": int(record.right), "bad": f"{badness(record):.4f}",
        "cd": f"{record.cd or 0:.4f}", "seconds": f"{record.seconds:.2f}", "tokens": f"{tokens:.0f}",
    }  # fmt: skip
    has_picture = record.error is None and png.is_file()
    picture = _picture(read_image(png), record.method) if has_picture else _nothing()
    marks = [("right", True) if record.right else ("failed" if record.error else "not right", False)]
    if record.satisfied is not None and record.error is None and not record.satisfied:
        marks.append(("program missed", False))
    tags = "".join(f'<span class="tag {"good" if good else "bad"}">{text}</span>' for text, good in marks)
    facts = [
        "" if record.cd is None else f"CD {record.cd:.3f}",
        "" if record.mse is None else f"MSE {record.mse:.0f}",
        f"{record.seconds:.1f} s",
        f"{tokens:.0f} tokens" if tokens else "",
    ]
    wrong = "".join(f"<li>{escape(line)}</li>" for line in trouble(record))
    written = record.details.get("program") or []
    attributes = " ".join(f'data-{name}="{value}"' for name, value in data.items())
    return (
        f"<td {attributes}>{picture}{tags}"
        f'<div class="facts">{" · ".join(filter(None, facts))}</div>{f"<ul>{wrong}</ul>" if wrong else ""}'
        f"{_program('program', list(map(str, written))) if written else ''}</td>"
    )


def badness(record: CaseRecord) -> float:
    """How far a result is from what it should be: failed over not right over missed over far, 0 being perfect."""
    cd = record.cd or 0.0
    missed = record.satisfied is False
    return 4.0 * (record.error is not None) + 2.0 * (not record.right) + 1.0 * missed + cd / (1.0 + cd)


def _program(title: str, lines: Sequence[str]) -> str:
    return f"<details><summary>{title}</summary><pre>{escape(chr(10).join(lines))}</pre></details>"


def _picture(image: UInt8[np.ndarray, "H W 3"], name: str) -> str:
    small = Image.fromarray(np.ascontiguousarray(image))
    small.thumbnail((SIDE, SIDE), Image.Resampling.LANCZOS)
    stream = io.BytesIO()
    small.save(stream, "WEBP", quality=82, method=3)
    data = base64.b64encode(stream.getvalue()).decode("ascii")
    return f'<img loading="lazy" alt="{escape(name)}" src="data:image/webp;base64,{data}">'


def _nothing() -> str:
    return '<div class="none">no picture</div>'


def _footer() -> str:
    known = ", ".join(f"{name} {number}" for name, number in versions().items())
    return f"<footer>Made by iconjax eval. {escape(known)}.</footer>"
