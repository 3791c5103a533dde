"""Start tags as bytes: reading where an attribute stands, and setting one without touching the rest."""

from __future__ import annotations

import re
from xml.sax.saxutils import escape

_ATTRIBUTE = re.compile(rb"""\s+([^\s=/>"']+)\s*=\s*("[^"]*"|'[^']*')""")
_NAME = re.compile(rb"<[^\s/>]+")


def attribute_span(tag: bytes, name: str) -> tuple[int, int, int, int] | None:
    """(start with its space, start of the value, end of the value, end) of an attribute in a start tag."""
    head = _NAME.match(tag)
    at = head.end() if head else 0
    while found := _ATTRIBUTE.match(tag, at):
        if found[1] == name.encode():
            return found.start(), found.start(2) + 1, found.end(2) - 1, found.end()
        at = found.end()
    return None


def set_attribute(tag: bytes, name: str, value: str) -> bytes:
    """`tag` with one attribute's value replaced, or the attribute put right behind the element's name."""
    span = attribute_span(tag, name)
    if span is None:
        head = _NAME.match(tag)
        assert head is not None, "a start tag begins with a name"
        return tag[: head.end()] + f' {name}="{quoted(value)}"'.encode() + tag[head.end() :]
    quote = tag[span[1] - 1 : span[1]]
    text = escape(value, {"'": "&apos;"} if quote == b"'" else {'"': "&quot;"})
    return tag[: span[1]] + text.encode() + tag[span[2] :]


def drop_attribute(tag: bytes, name: str) -> bytes:
    """`tag` without one attribute."""
    span = attribute_span(tag, name)
    return tag if span is None else tag[: span[0]] + tag[span[3] :]


def prepend_value(tag: bytes, name: str, text: str) -> bytes:
    """`tag` with `text` and a space put before an attribute's value, which is kept as it is written."""
    span = attribute_span(tag, name)
    if span is None or not tag[span[1] : span[2]].strip():
        return set_attribute(tag, name, text)
    return tag[: span[1]] + text.encode() + b" " + tag[span[1] :]


def splice(text: bytes, edits: list[tuple[int, int, bytes]], start: int = 0, end: int | None = None) -> bytes:
    """`text[start:end]` with (start, end, replacement) applied; edits may not overlap."""
    out, at = [], start
    for first, last, new in sorted(edits, key=lambda e: e[:2]):
        out += [text[at:first], new]
        at = last
    out.append(text[at : len(text) if end is None else end])
    return b"".join(out)


def quoted(value: str) -> str:
    """`value` as it stands between double quotes."""
    return escape(value, {'"': "&quot;"})
