"""Which connections hold an object together, as a vision LLM sees it (paper, "Relation Detection", relation types).

One question a scene: the coloured segmentation, and all connections within objects as a numbered list. Answers are kept
by content, so that a scene is asked about once.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from iconjax.errors import InputError
from iconjax.language.llm.exchange import Client, Exchange, Turn, layers
from iconjax.language.llm.faults import LlmError
from iconjax.language.llm.jsontext import object_schema, read_json_object
from iconjax.language.llm.picture import segmentation_picture
from iconjax.language.llm.prompt import text
from iconjax.language.llm.record import Recorder, Replayer, read_recording, write_recording
from iconjax.language.llm.scene_text import describe_boxes
from iconjax.scene.types import Scene

Pairs = Sequence[tuple[str, str]]
MOST_PAIRS = 400
_NUMBERS = {
    "type": "array",
    "items": {"type": "integer"},
    "description": "numbers of the connections that are real",
}
SCHEMA = object_schema({"crucial": _NUMBERS})


def crucial_by_llm(
    scene: Scene, pairs: Pairs, client: Client, folder: str | os.PathLike[str] | None = None
) -> frozenset[frozenset[str]]:
    """The pairs of segments whose connection holds their object together.

    Args:
        scene: the picture.
        pairs: names of the two segments of each connection; those between objects are not asked about.
        client: who answers; it has to see pictures.
        folder: where answers are kept; None is the user's cache folder. A folder that cannot be written is no error.

    Raises:
        LlmError: no usable answer; the offline rule will do then.
    """
    objects = {s.name: s.object for s in scene.segments}
    ordered = dict.fromkeys((min(p), max(p)) for p in pairs)
    inner = [(a, b) for a, b in ordered if a in objects and objects[a] == objects.get(b)]
    if not inner:
        return frozenset()
    exchange = crucial_exchange(scene, inner)
    # What is played back must not depend on what this user happens to have asked before.
    store = None if any(isinstance(c, Replayer) for c in layers(client)) else _store(folder)
    chosen = _kept(store, exchange, len(inner), client)
    if chosen is None:
        reply = client.send(exchange)
        chosen = _numbers(reply.text, len(inner))
        if store is not None:
            with suppress(InputError):
                write_recording(store, exchange, reply)
    return frozenset(frozenset(inner[k - 1]) for k in chosen)


def crucial_exchange(scene: Scene, pairs: Pairs) -> Exchange:
    """The question about the connections `pairs`, which are numbered from 1."""
    if len(pairs) > MOST_PAIRS:
        raise LlmError(f"the picture has {len(pairs)} connections; a model is asked about {MOST_PAIRS} at most")
    boxes = {s.name: s.box for s in scene.segments}
    listed = "\n".join(f"{k}. {json.dumps(a)} and {json.dumps(b)}" for k, (a, b) in enumerate(pairs, 1))
    question = f"{describe_boxes((scene.width, scene.height), boxes, ())}\n\nConnections to judge:\n{listed}"
    digest = hashlib.sha256(question.encode("utf-8", "replace")).hexdigest()[:8]
    turn = Turn("user", question, segmentation_picture(scene))
    return Exchange("crucial", f"connections of scene {digest}", text("crucial.md"), (turn,), SCHEMA)


def _numbers(reply: str, count: int) -> list[int]:
    values = read_json_object(reply).get("crucial")
    if not isinstance(values, list) or not all(isinstance(v, int) and not isinstance(v, bool) for v in values):
        raise LlmError('the model\'s reply about connections has no list of numbers "crucial"')
    return sorted({v for v in values if 1 <= v <= count})


def _kept(store: Path | None, exchange: Exchange, count: int, client: Client) -> list[int] | None:
    """An answer kept from before; a damaged file is the same as none. It belongs into a record like any other."""
    if store is None:
        return None
    try:
        reply = read_recording(store, exchange)
        numbers = _numbers(reply.text, count)
    except LlmError:
        return None
    for recorder in layers(client):
        if isinstance(recorder, Recorder):
            write_recording(recorder.folder, exchange, reply)
    return numbers


def _store(folder: str | os.PathLike[str] | None) -> Path | None:
    if folder is not None:
        return Path(folder)
    chosen = os.environ.get("ICONJAX_CACHE")
    if chosen is not None:
        return Path(chosen).expanduser() if chosen else None
    return Path(os.environ.get("XDG_CACHE_HOME") or Path("~/.cache").expanduser()) / "iconjax"
