"""What the search tried, as a table that can be sorted."""

from __future__ import annotations

import math
from collections.abc import Sequence
from html import escape

from iconjax.edit.page_style import COLOURS
from iconjax.search.types import TraceEntry

LONGEST = 400
"""Rows shown; a browser gets slow beyond some thousands, and nobody reads as many."""


HEADS = (
    ("Round", "number"), ("Candidate", ""), ("States", "number wide"), ("Cost", "number"),
    ("Cost by term", "number wide"), ("Outcome", ""),
)  # fmt: skip
"""Columns, each with the classes of its head; the script sorts a "number" column by value."""

LEGEND = (
    "What a segment may do: T move, R turn, S scale; or go with a host as one. Those not shown do not move. "
    "A relation: ST held at its meeting point, WK held but sliding, N given up; those not shown are ST. "
    "An infinite cost means that a constraint is missed."
)


def search_section(trace: Sequence[TraceEntry]) -> str:
    """The table of candidates with its heading."""
    if not trace:
        return '<h2>What the search tried</h2><div class="card text quiet">The search left no record.</div>\n'
    shown = choose_rows(trace)
    colours = term_colours(trace)
    head = "".join(f'<th class="{kind}"><button type="button">{name}</button></th>' for name, kind in HEADS)
    rows = "".join(_row(e, colours) for e in shown)
    left_out = len(trace) - len(shown)
    note = f'<p class="quiet">{left_out} more candidates, which cost more, are left out here.</p>' if left_out else ""
    return (
        f'<h2>What the search tried</h2><p class="legend">{LEGEND}</p>'
        f'<div class="card"><table class="search"><thead><tr>{head}</tr></thead>'
        f"<tbody>{rows}</tbody></table></div>{note}\n"
    )


def choose_rows(trace: Sequence[TraceEntry]) -> list[TraceEntry]:
    """The candidates to show, in order: those that were kept first of all, then the cheapest."""
    rank = sorted(range(len(trace)), key=lambda i: (not trace[i].kept, _order(trace[i].cost), i))
    return [trace[i] for i in sorted(rank[:LONGEST])]


def term_colours(trace: Sequence[TraceEntry]) -> dict[str, str]:
    """A colour for each cost term, the most costly terms first."""
    totals: dict[str, float] = {}
    for entry in trace:
        for name, value in entry.terms.items():
            totals[name] = totals.get(name, 0.0) + (abs(value) if math.isfinite(value) else 0.0)
    names = sorted(totals, key=lambda n: (-totals[n], n))
    return {name: COLOURS[i % len(COLOURS)] for i, name in enumerate(names)}


def _row(entry: TraceEntry, colours: dict[str, str]) -> str:
    kept = ' class="kept"' if entry.kept else ""
    verdict = "kept" if entry.kept else "dropped"
    total = sum(v for v in entry.terms.values() if math.isfinite(v))
    cells = (
        ("number", _key(entry.round), str(entry.round)),
        ("wide", escape(entry.origin, quote=True), escape(entry.origin)),
        ("wide", str(len(entry.relations)), _states(entry)),
        ("number", _key(entry.cost), cost_text(entry.cost)),
        ("wide", _key(total), _terms(entry, colours)),
        ("wide", f"{verdict} {escape(entry.reason, quote=True)}", f"<b>{verdict}</b> {escape(entry.reason)}"),
    )
    return f"<tr{kept}>" + "".join(f'<td class="{c}" data-key="{k}">{html}</td>' for c, k, html in cells) + "</tr>\n"


def _states(entry: TraceEntry) -> str:
    tags = []
    for name, state in entry.motion.items():
        if _root_state(entry, name) == "N":
            continue  # it does not move, be it fused or not
        host = state.removeprefix("F:")
        if host != state:
            tags.append(f'<span class="tag">{escape(name)} with <b>{escape(host)}</b></span>')
        else:
            tags.append(f'<span class="tag mark">{escape(name)}&nbsp;<b>{escape(state)}</b></span>')
    for a, b, state in entry.relations:
        kind = "bad" if state == "N" else ""
        tags.append(f'<span class="tag {kind}">{escape(a)} – {escape(b)}&nbsp;<b>{escape(state)}</b></span>')
    return " ".join(tags) or '<span class="quiet">nothing moves</span>'


def _root_state(entry: TraceEntry, name: str) -> str:
    """The state of the host that a fused segment ends up with, or its own."""
    for _ in entry.motion:
        state = entry.motion.get(name, "N")
        if not state.startswith("F:"):
            return state
        name = state.removeprefix("F:")
    return "F"  # a ring of hosts, which no search should make


def _terms(entry: TraceEntry, colours: dict[str, str]) -> str:
    terms = sorted(((n, v) for n, v in entry.terms.items() if v), key=lambda item: _order(-abs(item[1])))
    if not terms:
        return '<span class="quiet">none</span>'
    total = sum(abs(v) for _, v in terms if math.isfinite(v)) or 1.0
    bar = "".join(
        f'<span title="{escape(n)}" style="width:{100 * abs(v) / total:.1f}%;background:{colours[n]}"></span>'
        for n, v in terms
        if math.isfinite(v)
    )
    text = ", ".join(f'<span style="color:{colours[n]}">{escape(n)}</span>&nbsp;{cost_text(v)}' for n, v in terms)
    return f'<div class="bar">{bar}</div>{text}'


def cost_text(value: float) -> str:
    """A cost for reading; an infinite one means that a primary constraint fails."""
    return f"{value:.3g}" if math.isfinite(value) else "∞"


def _key(value: float) -> str:
    return repr(float(value)) if math.isfinite(value) else "1e308"


def _order(value: float) -> float:
    return value if not math.isnan(value) else math.inf
