"""What the paper's two baselines ask a language model, and how its replies are read.

`dm` asks for the motion of each segment, `dc` for all constraints (paper, section "Our method greatly outperforms other
LLM based parametric editing baselines"). Both are shown the outline of every segment; with `+image` also the picture of
the coloured segments. Unlike `iconjax.edit`, they are asked once: a reply that cannot be used is a failed case.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any

from iconjax.language.base import Hint
from iconjax.language.llm.exchange import Exchange, Turn
from iconjax.language.llm.faults import LlmError
from iconjax.language.llm.jsontext import object_schema, read_json_object
from iconjax.language.llm.picture import segmentation_picture
from iconjax.language.llm.scene_text import outline_vertices
from iconjax.scene.types import Scene

MOST_CALLS = 120
"""Constraints that a reply may hold."""

NUMBERS = {"type": "array", "items": {"type": "number"}}
TEXT = {"type": "string"}


def baseline_exchange(base: str, request: str, scene: Scene, image: bool) -> Exchange:
    """The question that a baseline asks.

    Args:
        base: "dm" or "dc".
        request: the instruction.
        scene: the picture.
        image: whether the model sees the coloured segments.
    """
    text = f"{outline_text(scene)}\n\nRequest: {request}"
    picture = segmentation_picture(scene) if image else None
    return Exchange(base, request, system_text(base), (Turn("user", text, picture),), schema(base))


@cache
def system_text(base: str) -> str:
    """The constant part of a baseline's prompt."""
    text = files("iconjax.evaluation").joinpath("prompts", f"{base}.md").read_text(encoding="utf-8")
    if base == "dm":
        return text
    from iconjax.language.llm.prompt import operator_reference

    return text.format(operators=operator_reference())


def outline_text(scene: Scene) -> str:
    """The segments of a scene with their boxes and simplified outlines, in whole pixels."""
    lines = [f"Picture: {scene.width} x {scene.height} pixels. Segments, with the vertices x,y of their outlines:"]
    for segment in scene.segments:
        x0, y0, x1, y1 = segment.box
        pieces = " | ".join(" ".join(f"{x:.0f},{y:.0f}" for x, y in piece) for piece in outline_vertices(segment))
        lines.append(
            f"- {json.dumps(segment.name, ensure_ascii=False)}: box {x0:.0f},{y0:.0f} to {x1:.0f},{y1:.0f}, "
            f"centre {(x0 + x1) / 2:.1f},{(y0 + y1) / 2:.1f}\n  outline {pieces}"
        )
    return "\n".join(lines)


def schema(base: str) -> dict[str, Any]:
    """JSON schema of a baseline's reply."""
    motion = {"segment": TEXT, "translate": NUMBERS, "rotate": {"type": "number"}, "scale": NUMBERS}
    rows = {"motions": _list(object_schema(motion))} if base == "dm" else {"program": _list(TEXT)}
    return object_schema({"plan": TEXT, **rows})


def read_motions(text: str, scene: Scene) -> tuple[Hint, ...]:
    """The motions in a reply to `dm`.

    Raises:
        LlmError: it does not have the form asked for.
    """
    rows = read_json_object(text).get("motions")
    if not isinstance(rows, list):
        raise LlmError('the reply holds no list "motions"')
    hints = [_motion(row, scene) for row in rows]
    if len({hint.segment for hint in hints}) < len(hints):
        raise LlmError("the reply moves a segment twice")
    return tuple(hints)


def read_program(text: str) -> tuple[str, ...]:
    """The constraints in a reply to `dc`.

    Raises:
        LlmError: it does not have the form asked for.
    """
    calls = read_json_object(text).get("program")
    if not isinstance(calls, list) or not calls or not all(isinstance(call, str) for call in calls):
        raise LlmError('the reply holds no list "program" of constraints')
    if len(calls) > MOST_CALLS:
        raise LlmError(f"the reply holds {len(calls)} constraints; at most {MOST_CALLS} are read")
    return tuple(calls)


def _motion(row: Any, scene: Scene) -> Hint:
    if not isinstance(row, Mapping) or row.get("segment") not in scene.names:
        known = ", ".join(scene.names)
        raise LlmError(f"the reply moves {_shown(row)}, which is not a segment; there are {known}")
    name = str(row["segment"])
    shift = _numbers(row.get("translate", [0, 0]), 2, name)
    (turn,) = _numbers([row.get("rotate", 0)], 1, name)
    scale = _numbers(row.get("scale", [1, 1]), 2, name)
    return Hint(name, (shift[0], shift[1]), turn, (scale[0], scale[1]))


def _numbers(values: Any, count: int, name: str) -> list[float]:
    whole = isinstance(values, list) and len(values) == count
    if not whole or any(isinstance(v, bool) or not isinstance(v, int | float) or not math.isfinite(v) for v in values):
        raise LlmError(f"the reply's motion of {name!r} holds something that is no number")
    return [float(v) for v in values]


def _shown(row: Any) -> str:
    return repr(row.get("segment") if isinstance(row, Mapping) else row)[:80]


def _list(items: Mapping[str, Any]) -> dict[str, Any]:
    return {"type": "array", "items": dict(items)}
