"""JSON out of a reply, and its schema. A reply is data from outside: bounded, checked, and never run."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from iconjax.language.llm.faults import LlmError

MAX_REPLY = 32_000
"""Characters; a reply for thirty segments with hints takes less than a third."""


class NotJsonError(LlmError):
    """A reply that is no JSON object; the model can be told and asked again."""


def read_json_object(text: str, limit: int = MAX_REPLY) -> dict[str, Any]:
    """The JSON object that `text` is. A Markdown fence around it is taken off: models without structured output add it.

    Raises:
        NotJsonError: it is none.
        LlmError: it is longer than `limit`, so that going on makes no sense.
    """
    if len(text) > limit:
        raise LlmError(f"the model's reply has {len(text)} characters; at most {limit} are read")
    try:
        data = json.loads(_unfenced(text.strip()), parse_constant=_no_constant)
    except (ValueError, RecursionError) as error:
        reason = "nested too deeply" if isinstance(error, RecursionError) else str(error)
        raise NotJsonError(f"the model's reply is not JSON: {reason}") from None
    if not isinstance(data, dict):
        raise NotJsonError(f"the model's reply is a JSON {type(data).__name__}, not an object")
    return data


def object_schema(properties: Mapping[str, Any]) -> dict[str, Any]:
    """JSON schema of an object with just these properties, all of them."""
    return {
        "type": "object",
        "properties": dict(properties),
        "required": list(properties),
        "additionalProperties": False,
    }


def _unfenced(text: str) -> str:
    if text.startswith("```") and text.endswith("```") and "\n" in text:
        return text[text.index("\n") : -3].strip()
    return text


def _no_constant(name: str) -> Any:
    raise ValueError(f"{name} is no JSON number")
