"""The reply to a request: its schema, and the checked data in it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from iconjax.language.base import Hint, Reading
from iconjax.language.llm.faults import one_line
from iconjax.language.llm.jsontext import NotJsonError, object_schema, read_json_object

MAX_CALLS, MAX_CALL, MAX_LINES, MAX_LINE = 60, 1_000, 24, 300
"""Limits on a reply: calls of a program, characters of a call, lines of explanation, characters of a line."""
MAX_SHIFT, MAX_FACTOR = 20_000.0, 50.0


@dataclass(frozen=True)
class Answer:
    """A reply as data.

    Attributes:
        understood: the request in plain words, one line per clause.
        readings: ways to understand it, best first.
        refusal: why there is nothing to do, or "".
    """

    understood: tuple[str, ...]
    readings: tuple[Reading, ...]
    refusal: str


class ReplyError(NotJsonError):
    """A reply that does not have the form asked for; the model can be told and asked again."""


def reply_schema(hints: bool) -> dict[str, Any]:
    """JSON schema of a reply. Structured output knows no limits on lengths, so they stand in words."""
    text = {"type": "string"}
    reading: dict[str, Any] = {
        "gloss": {**text, "description": "this reading in one line of plain words"},
        "program": {
            "type": "array",
            "items": text,
            "description": f"the primary constraints, one call an item, at most {MAX_CALLS}",
        },
    }
    if hints:
        pair = {"type": "array", "items": {"type": "number"}}
        motion = {
            "segment": {**text, "description": "label of one segment, never of a whole object"},
            "translate": {**pair, "description": "[dx, dy] of the centre of its box, pixels, y down"},
            "rotate": {"type": "number", "description": "degrees, clockwise positive"},
            "scale": {**pair, "description": "[sx, sy] factors along x and y, before turning"},
        }
        reading["motion_hints"] = {
            "type": "array",
            "items": object_schema(motion),
            "description": "one entry for every segment that moves in the finished picture, also those that follow",
        }
    return object_schema(
        {
            "understood": {
                "type": "array",
                "items": text,
                "description": "the request as you understand it, one short line per clause",
            },
            "readings": {"type": "array", "items": object_schema(reading), "description": "empty in a refusal"},
            "refusal": {
                "anyOf": [text, {"type": "null"}],
                "description": "null, or one line that says why nothing can be done and what to write instead",
            },
        }
    )


def read_reply(text: str, names: Sequence[str], readings: int = 1) -> Answer:
    """The data of a reply; of more readings than were asked for, the first ones count.

    Hints for no known segment or with impossible numbers are dropped: they are only guesses.

    Raises:
        ReplyError: it has not the form asked for.
        NotJsonError: it is not JSON.
        LlmError: it is beyond all limits.
    """
    data = read_json_object(text)
    refusal = data.get("refusal")
    if refusal is not None and not isinstance(refusal, str):
        raise ReplyError('"refusal" has to be text or null')
    understood = _strings(data, "understood", MAX_LINES)
    given = data.get("readings")
    if not isinstance(given, list):
        raise ReplyError('"readings" has to be a list')
    found = tuple(_reading(r, k, names) for k, r in enumerate(given[:readings]))
    if not found and not (refusal or "").strip():
        raise ReplyError("it holds neither a reading nor a refusal")
    lines = tuple(one_line(line, MAX_LINE) for line in understood)
    return Answer(tuple(line for line in lines if line), _distinct(found), one_line(refusal or "", MAX_LINE))


def _reading(data: Any, k: int, names: Sequence[str]) -> Reading:
    if not isinstance(data, Mapping):
        raise ReplyError(f"reading {k + 1} is no object")
    gloss = data.get("gloss", "")
    if not isinstance(gloss, str):
        raise ReplyError(f'"gloss" of reading {k + 1} has to be text')
    program = _strings(data, "program", MAX_CALLS)
    if not program:
        raise ReplyError(f"the program of reading {k + 1} is empty")
    long = next((n for n, call in enumerate(program) if len(call) > MAX_CALL), None)
    if long is not None:
        raise ReplyError(f"call {long + 1} of reading {k + 1} has more than {MAX_CALL} characters")
    hints = data.get("motion_hints") or ()
    guesses = (_hint(h, names) for h in (hints if isinstance(hints, list) else ()))
    unique = {h.segment: h for h in guesses if h is not None}
    return Reading(one_line(gloss, MAX_LINE), program, tuple(unique.values()))


def _strings(data: Mapping[str, Any], key: str, at_most: int) -> tuple[str, ...]:
    values = data.get(key)
    if not isinstance(values, list) or not all(isinstance(v, str) for v in values):
        raise ReplyError(f'"{key}" has to be a list of strings')
    if len(values) > at_most:
        raise ReplyError(f'"{key}" has {len(values)} entries; at most {at_most} are allowed')
    return tuple(values)


def _hint(data: Any, names: Sequence[str]) -> Hint | None:
    if not isinstance(data, Mapping) or data.get("segment") not in names:
        return None
    shift = _numbers(data.get("translate", [0, 0]), 2, -MAX_SHIFT, MAX_SHIFT)
    turn = _numbers([data.get("rotate", 0)], 1, -3600, 3600)
    scale = _numbers(data.get("scale", [1, 1]), 2, 1 / MAX_FACTOR, MAX_FACTOR)
    if shift is None or turn is None or scale is None:
        return None
    return Hint(data["segment"], (shift[0], shift[1]), turn[0], (scale[0], scale[1]))


def _numbers(values: Any, count: int, least: float, most: float) -> list[float] | None:
    if not isinstance(values, list) or len(values) != count:
        return None
    if any(isinstance(v, bool) or not isinstance(v, int | float) for v in values):
        return None
    return [float(v) for v in values] if all(math.isfinite(v) and least <= v <= most for v in values) else None


def _distinct(readings: tuple[Reading, ...]) -> tuple[Reading, ...]:
    first: dict[frozenset[str], Reading] = {}
    for reading in readings:
        first.setdefault(frozenset("".join(call.split()) for call in reading.program), reading)
    return tuple(first.values())
