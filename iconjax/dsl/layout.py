"""Cut the text of a program into calls, so that an error in one leaves the others readable."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

_LONGEST = 64  # lines of one call


@dataclass(frozen=True)
class Chunk:
    """The text of one call.

    Attributes:
        text: one or more lines, the first without its indentation.
        indent: how many characters that was.
        line: 1-based line of its first line, or the number of its entry when the program is a list.
        numbered: whether `line` is the number of an entry.
    """

    text: str
    indent: int
    line: int
    numbered: bool


def chunks(entries: Sequence[str], numbered: bool, parses: Callable[[str], bool]) -> Iterator[Chunk]:
    """The calls of a program, in order.

    Args:
        entries: the whole text as one entry, or one call an entry.
        numbered: whether problems count entries rather than lines.
        parses: whether a text is complete; decides between a call over several lines and a missing bracket.
    """
    for number, entry in enumerate(entries, start=1):
        lines = entry.replace("\r\n", "\n").replace("\r", "\n").split("\n")
        start = 0
        while start < len(lines):
            if not lines[start].split("#", 1)[0].strip():
                start += 1
                continue
            stop = _end(lines, start, parses)
            indent = len(lines[start]) - len(lines[start].lstrip())
            yield Chunk(_dedent(lines[start:stop]), indent, number if numbered else start + 1, numbered)
            start = stop


def _end(lines: Sequence[str], start: int, parses: Callable[[str], bool]) -> int:
    """Where the call that begins at `start` ends; one that never becomes whole ends with its first line."""
    depth = 0
    for stop in range(start, min(len(lines), start + _LONGEST)):
        depth += _balance(lines[stop])
        if depth <= 0:
            whole = stop == start or parses(_dedent(lines[start : stop + 1]))
            return stop + 1 if whole else start + 1
    return start + 1


def _dedent(lines: Sequence[str]) -> str:
    return "\n".join([lines[0].lstrip(), *lines[1:]])


def _balance(line: str) -> int:
    """Opening minus closing brackets outside strings and comments."""
    depth, quote, escaped = 0, "", False
    for char in line:
        if escaped:
            escaped = False
        elif quote:
            escaped = char == "\\"
            quote = "" if char == quote else quote
        elif char in "\"'":
            quote = char
        elif char == "#":
            break
        else:
            depth += (char in "([{") - (char in ")]}")
    return depth
