"""Syntax tree to text; what it writes parses back to the same tree."""

from __future__ import annotations

import json
from typing import overload

from iconjax.dsl.nodes import Call, Node, Number, Point, Program, SegmentRef


@overload
def to_text(node: Program) -> list[str]: ...
@overload
def to_text(node: Node) -> str: ...
def to_text(node: Program | Node) -> str | list[str]:
    """The text of a call, or the list of the calls of a program."""
    if isinstance(node, Program):
        return [to_text(call) for call in node.calls]
    if isinstance(node, Call):
        return f"{node.name}({', '.join(to_text(arg) for arg in node.args)})"
    if isinstance(node, SegmentRef):
        return json.dumps(node.name, ensure_ascii=False)
    if isinstance(node, Number):
        return _number(node.value)
    if isinstance(node, Point):
        return f"[{_number(node.x)}, {_number(node.y)}]"
    raise ValueError("an invalid node has no text")


def _number(value: float) -> str:
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)
