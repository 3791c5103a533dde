"""The trace page and the notebook view: complete, self-contained, and safe with any text."""

from __future__ import annotations

import re
from dataclasses import replace
from html.parser import HTMLParser

import pytest
from edit_support import LABELS, PROGRAM, small_picture, use_fake_search

from iconjax import edit
from iconjax.edit import page_trace

NASTY = "</script><img src=x onerror=alert(1)> & \"quotes\" 'too'"


class Reader(HTMLParser):
    """Notes tags, attributes and text, and that every element is closed."""

    VOID = ("meta", "img", "br")

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.text = ""
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text += data


@pytest.fixture
def result(monkeypatch):
    use_fake_search(monkeypatch)
    image, mask = small_picture()
    return edit(image, mask, "Move the shade", labels=LABELS, program=PROGRAM)


def test_page_shows_everything(result):
    read = Reader(result.to_html())
    images = [a for t, a in read.tags if t == "img"]
    assert [a["alt"] for a in images] == ["Before", "After", "Segments"]
    for text in (
        "Move the shade",
        *result.program,
        "Lamp:Foot",
        "moved 8.0 px right",
        "intra-crucial",
        "loosen",
        "slide",
        "∞",
    ):
        assert text in read.text, text
    assert "every constraint holds" in read.text


def test_page_loads_nothing_from_elsewhere(result):
    html = result.to_html()
    for tag, attributes in Reader(html).tags:
        for name in ("src", "href", "action", "data", "poster", "srcset"):
            assert (attributes.get(name) or "data:").startswith("data:"), (tag, attributes)
    assert not re.search(r"https?://|@import|url\(", html)


def test_page_is_safe_with_any_text(result):
    segments = tuple(replace(s, name=NASTY) for s in result.scene.segments)
    trace = tuple(
        replace(
            t,
            origin=NASTY,
            reason=NASTY,
            motion={NASTY: "T"},
            relations=((NASTY, NASTY, NASTY),),
            terms={NASTY: 1.0},
        )
        for t in result.trace
    )
    nasty = replace(
        result,
        request=NASTY,
        understood=(NASTY,),
        notes=(NASTY,),
        translator=NASTY,
        trace=trace,
        scene=replace(result.scene, segments=segments),
        relations=tuple(replace(r, a=NASTY, kind=NASTY, scope=NASTY, state=NASTY) for r in result.relations),
        constraints=tuple(replace(c, text=NASTY, unit=NASTY) for c in result.constraints),
        motion_states=dict.fromkeys(result.motion_states, NASTY),
    )
    for html in (nasty.to_html(), nasty._repr_html_()):
        read = Reader(html)
        assert NASTY in read.text
        assert not any(name.startswith("on") for _, attributes in read.tags for name in attributes)
        assert sum(tag == "script" for tag, _ in read.tags) <= 1


def test_long_traces_are_cut_but_keep_what_was_kept(result):
    many = tuple(replace(result.trace[0], round=i, cost=float(i)) for i in range(1000))
    kept = replace(result.trace[1], round=1000, cost=5000.0)
    rows = page_trace.choose_rows((*many, kept))
    assert len(rows) == page_trace.LONGEST
    assert rows[-1] is kept
    assert [r.round for r in rows] == sorted(r.round for r in rows)
    assert "601 more candidates" in page_trace.search_section((*many, kept))


def test_page_of_an_edit_without_record(result):
    bare = replace(result, trace=(), relations=(), understood=(), request="")
    read = Reader(bare.to_html())
    assert "left no record" in read.text
    assert "No relations" in read.text


def test_a_missed_constraint_is_shown(result):
    missed = replace(result, constraints=tuple(replace(c, satisfied=False, violation=7.0) for c in result.constraints))
    text = Reader(missed.to_html()).text
    assert "2 of 2 constraints missed" in text
    assert "7 px" in text


def test_notebooks_show_before_and_after(result):
    assert result._repr_png_().startswith(b"\x89PNG")
    html = result._repr_html_()
    assert [a["alt"] for t, a in Reader(html).tags if t == "img"] == ["before", "after"]
    assert "Changed:" in html


def test_states_name_hosts_and_leave_out_what_does_not_move(result):
    motion = {"A": "TR", "B": "F:A", "C": "F:D", "D": "N", "E": "F:F", "F": "F:E"}
    html = page_trace.search_section((replace(result.trace[0], motion=motion),))
    text = Reader(html).text
    assert "A\xa0TR" in text
    assert "B with A" in text
    assert "C with" not in text
    assert "E with F" in text
