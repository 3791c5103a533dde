"""The trace page: one HTML file, with everything inside, that shows an edit and what the search tried."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import TYPE_CHECKING

from iconjax.edit.explain import STATES, amount, centre, describe_motion
from iconjax.edit.page_style import SCRIPT, STYLE
from iconjax.edit.page_trace import search_section
from iconjax.edit.result import data_uri
from iconjax.render.sheet import palette, segment_sheet

if TYPE_CHECKING:
    from iconjax.edit.result import EditResult


def page(result: EditResult) -> str:
    """The page as HTML text. Nothing in it is loaded from elsewhere, and every text is escaped."""
    title = result.request or "Edit by program"
    return "".join(
        (
            '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>{escape(title)}</title><style>{STYLE}</style></head>\n<body><main>\n",
            _header(result, title),
            _pictures(result),
            '<div class="columns"><div>',
            _constraints(result),
            "</div><div>",
            _understood(result),
            "</div></div>",
            _notes(result),
            _segments(result),
            _relations(result),
            search_section(result.trace),
            _footer(result),
            f"</main><script>{SCRIPT}</script></body></html>\n",
        )
    )


def _header(result: EditResult, title: str) -> str:
    missed = len(result.missed())
    verdict = (
        tag("every constraint holds", "good")
        if not missed
        else tag(f"{missed} of {len(result.constraints)} constraints missed", "bad")
    )
    seconds = sum(v for v in result.timings.values())
    return (
        f"<header><h1>{escape(title)}</h1><p>{verdict} {_reader(result)} · "
        f"{len(result.trace)} candidates tried · {seconds:.1f} s</p></header>\n"
    )


def _reader(result: EditResult) -> str:
    if result.translator == "program":
        return "by a given program"
    return f"request read by the translator <b>{escape(result.translator)}</b>"


def _pictures(result: EditResult) -> str:
    sheet = segment_sheet(result.scene)
    figures = (
        ("Before", result.scene.image),
        ("After", result.image),
        ("Segments", sheet),
    )
    cells = "".join(
        f'<figure><img alt="{name}" src="{data_uri(image)}"><figcaption>{name}</figcaption></figure>'
        for name, image in figures
    )
    return f'<div class="pictures">{cells}</div>\n'


def _understood(result: EditResult) -> str:
    lines = result.understood or ("A program was given; nothing was translated.",)
    return f'<h2>Understood as</h2><div class="card text">{escape(chr(10).join(lines))}</div>\n'


def _constraints(result: EditResult) -> str:
    rows = [
        (
            f"<code>{escape(c.text)}</code>",
            escape(amount(c)),
            tag("holds", "good") if c.satisfied else tag("missed", "bad"),
        )
        for c in result.constraints
    ]
    return "<h2>Constraints</h2>" + table(("Constraint", "Violation", ""), rows, numbers=(1,))


def _notes(result: EditResult) -> str:
    if not result.notes:
        return ""
    return f'<h2>Notes</h2><div class="card text">{escape(chr(10).join(result.notes))}</div>\n'


def _segments(result: EditResult) -> str:
    depth = {k: str(i + 1) for i, k in enumerate(result.depth_order)}
    colours = palette(len(result.scene.segments))
    rows = []
    for s, colour in zip(result.scene.segments, colours, strict=True):
        state = result.motion_states.get(s.id, "N")
        swatch = f'<span class="swatch" style="background:rgb({",".join(map(str, colour.tolist()))})"></span>'
        became = escape(describe_motion(result.transforms[s.id], centre(s.box)))
        rows.append(
            (
                f"{swatch}{s.id}",
                escape(s.name),
                tag(state, "mark" if state != "N" else ""),
                became or '<span class="quiet">stayed exactly as it was</span>',
                depth.get(s.id, ""),
            )
        )
    heads = ("Number", "Segment", "Freedom", "What became of it", "Depth, from the back")
    return "<h2>Segments</h2>" + table(heads, rows, numbers=(4,))


def _relations(result: EditResult) -> str:
    kinds = {"ST": "good", "WK": "mark", "N": "bad", "F": "good"}
    rows = [
        (
            escape(r.a),
            escape(r.b),
            escape(r.kind),
            escape(r.scope),
            tag(r.state, kinds.get(r.state, "")) + f'<span class="quiet">{escape(STATES.get(r.state, ""))}</span>',
        )
        for r in result.relations
    ]
    heads = ("Segment", "Other", "Relation", "Scope", "Final state")
    return "<h2>Relations</h2>" + table(heads, rows, empty="No relations were found.")


def _footer(result: EditResult) -> str:
    times: Mapping[str, float] = result.timings
    parts = " · ".join(f"{escape(k)} {v:.2f} s" for k, v in times.items())
    return f"<footer>{parts} · iconjax {escape(result.version)}</footer>\n"


def table(
    heads: Sequence[str], rows: Iterable[Sequence[str]], numbers: Sequence[int] = (), empty: str = "None."
) -> str:
    """A table of cells that are HTML already; `numbers` are the columns to align right."""
    kinds = [' class="number"' if i in numbers else "" for i in range(len(heads))]
    body = "".join(
        "<tr>" + "".join(f"<td{k}>{c}</td>" for k, c in zip(kinds, row, strict=True)) + "</tr>\n" for row in rows
    )
    if not body:
        return f'<div class="card text quiet">{escape(empty)}</div>\n'
    head = "".join(f"<th{k}>{escape(h)}</th>" for k, h in zip(kinds, heads, strict=True))
    return f'<div class="card"><table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>\n'


def tag(text: str, kind: str = "") -> str:
    """A word in a pill: `kind` is "good", "bad", "mark" or ""."""
    return f'<span class="tag {kind}">{escape(text)}</span> '
