"""The syntax tree of a constraint program: plain, frozen, compared by structure and never by position."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field


@dataclass(frozen=True)
class SegmentRef:
    """A name in quotes: one segment, an object (the union of its parts), or `"canvas"`."""

    name: str
    line: int = field(default=0, compare=False)
    column: int = field(default=0, compare=False)


@dataclass(frozen=True)
class Number:
    """A number literal; it takes the unit of what it is compared with."""

    value: float
    line: int = field(default=0, compare=False)
    column: int = field(default=0, compare=False)


@dataclass(frozen=True)
class Point:
    """A place `[x, y]` in pixels of the unedited picture."""

    x: float
    y: float
    line: int = field(default=0, compare=False)
    column: int = field(default=0, compare=False)


@dataclass(frozen=True)
class Call:
    """An operator applied to its arguments."""

    name: str
    args: tuple[Node, ...]
    line: int = field(default=0, compare=False)
    column: int = field(default=0, compare=False)


@dataclass(frozen=True)
class Invalid:
    """What could not be parsed; its problem has been noted, so that the check goes on around it."""

    line: int = field(default=0, compare=False)
    column: int = field(default=0, compare=False)


Node = Call | SegmentRef | Number | Point | Invalid


@dataclass(frozen=True)
class Program:
    """A list of calls, each of which states one constraint."""

    calls: tuple[Call, ...]


def walk(node: Node) -> Iterator[Node]:
    """All nodes of a tree, parents before children, from left to right."""
    yield node
    if isinstance(node, Call):
        for arg in node.args:
            yield from walk(arg)


def segment_names(node: Node) -> tuple[str, ...]:
    """The names a call mentions, each once, in order of appearance."""
    return tuple(dict.fromkeys(n.name for n in walk(node) if isinstance(n, SegmentRef)))
