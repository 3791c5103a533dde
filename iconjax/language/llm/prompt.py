"""The prompt: operators from their declarations, rules, worked examples, then the scene and the request.

The constant part is the system prompt, which servers cache; what differs from request to request comes after it.
"""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from iconjax.dsl.docs import to_reference
from iconjax.errors import TranslationError
from iconjax.language.base import Hint, Miss, Reading, SolveReport
from iconjax.language.llm.exchange import Exchange, Turn
from iconjax.language.llm.picture import segmentation_picture
from iconjax.language.llm.reply import reply_schema
from iconjax.language.llm.scene_text import Box, Connections, describe_boxes, describe_scene
from iconjax.scene.types import Scene

LONGEST_REQUEST = 4_000


@dataclass(frozen=True)
class Example:
    """A worked example: an invented scene, a request and the reply to it.

    Attributes:
        request: the request.
        size: width and height of the picture.
        boxes: name -> box of each segment.
        connections: which of them are connected.
        understood, reading, refusal: the reply; the reading holds motion hints too.
    """

    request: str
    size: tuple[int, int]
    boxes: Mapping[str, Box]
    connections: Connections
    understood: tuple[str, ...]
    reading: Reading | None
    refusal: str


def text(name: str) -> str:
    """A prompt text of the package."""
    return files("iconjax.language.llm").joinpath("prompts", name).read_text(encoding="utf-8").strip()


def operator_reference() -> str:
    """All operators of the constraint language, from the declarations that `iconjax dsl` shows too."""
    return to_reference()


@cache
def system_prompt(hints: bool = False) -> str:
    """The constant part."""
    parts = [text("role.md"), text("language.md") + "\n\n" + operator_reference(), text("rules.md"), text("reply.md")]
    if hints:
        parts[-1] += "\n" + text("hints.md")
    parts += ["# Examples", *(_worked(e, hints) for e in examples())]
    return "\n\n".join(parts) + "\n"


def translation_exchange(
    request: str,
    scene: Scene,
    connections: Connections,
    *,
    readings: int = 1,
    image: bool = False,
    hints: bool = False,
) -> Exchange:
    """The first question about a request.

    Raises:
        TranslationError: the request is longer than any request.
    """
    if len(request) > LONGEST_REQUEST:
        raise TranslationError(f"the request has {len(request)} characters; at most {LONGEST_REQUEST} are read")
    said = " ".join(request.encode("utf-8", "replace").decode().split())
    parts = [describe_scene(scene, connections, outlines=hints), f"Request: {said}"]
    if image:
        parts.insert(1, "The image shows the segments in colours of their own, each with its label.")
    if readings > 1:
        parts.append(f"Give up to {readings} readings, as far as the request can be understood in different ways.")
    picture = segmentation_picture(scene) if image else None
    turn = Turn("user", "\n\n".join(parts), picture)
    return Exchange("translate", said, system_prompt(hints), (turn,), reply_schema(hints))


def repair_text(problems: Sequence[str]) -> str:
    """What the model is told about a reply that cannot be used."""
    return text("repair.md").format(problems="\n".join(f"- {p}" for p in problems))


def unsolved_text(report: SolveReport, scene: Scene) -> str:
    """What the model is told about constraints that cannot hold together."""
    before = {s.name: s.box for s in scene.segments}
    moved = {
        name: box
        for name, box in report.boxes.items()
        if name in before and max(abs(a - b) for a, b in zip(box, before[name], strict=True)) > 0.5
    }
    return text("unsolved.md").format(
        missed="\n".join(f"- {_missed(m)}" for m in report.missed),
        boxes="\n".join(f"- {_box(name, box)}" for name, box in moved.items()) or "- none",
    )


@cache
def examples() -> tuple[Example, ...]:
    """The worked examples of the prompt."""
    return tuple(_example(e) for e in tomllib.loads(text("examples.toml"))["example"])


def _example(entry: Mapping[str, object]) -> Example:
    data: dict[str, object] = dict(entry)
    boxes = {
        str(row[0]): (float(row[1]), float(row[2]), float(row[3]), float(row[4])) for row in _rows(data, "segments")
    }
    hints = tuple(
        Hint(str(r[0]), (float(r[1]), float(r[2])), float(r[3]), (float(r[4]), float(r[5])))
        for r in _rows(data, "motions")
    )
    program = tuple(str(call) for call in _list(data, "program"))
    width, height = _list(data, "size")
    return Example(
        request=str(data["request"]),
        size=(int(str(width)), int(str(height))),
        boxes=boxes,
        connections=[(str(a), str(how), str(b)) for a, how, b in _rows(data, "connections")],
        understood=tuple(str(line) for line in _list(data, "understood")),
        reading=Reading(str(data["gloss"]), program, hints) if program else None,
        refusal=str(data.get("refusal", "")),
    )


def _list(data: Mapping[str, object], key: str) -> list[object]:
    value = data.get(key, [])
    assert isinstance(value, list)
    return value


def _rows(data: Mapping[str, object], key: str) -> list[list[str]]:
    return [row for row in _list(data, key) if isinstance(row, list)]


def _worked(example: Example, hints: bool) -> str:
    scene = describe_boxes(example.size, example.boxes, example.connections)
    reply = json.dumps(example_reply(example, hints), ensure_ascii=False)
    return f"<example>\n{scene}\n\nRequest: {example.request}\n\nReply:\n{reply}\n</example>"


def example_reply(example: Example, hints: bool) -> dict[str, object]:
    """The reply of a worked example, as data."""
    readings: list[dict[str, object]] = []
    if example.reading is not None:
        reading: dict[str, object] = {"gloss": example.reading.gloss, "program": list(example.reading.program)}
        if hints:
            reading["motion_hints"] = [
                {"segment": h.segment, "translate": h.translate, "rotate": h.rotate, "scale": h.scale}
                for h in example.reading.hints
            ]
        readings.append(reading)
    return {"understood": list(example.understood), "readings": readings, "refusal": example.refusal or None}


def _missed(miss: Miss) -> str:
    return f"{miss.call} is missed by {miss.amount}"


def _box(name: str, box: Box) -> str:
    return f"{json.dumps(name, ensure_ascii=False)}: x {box[0]:.0f} to {box[2]:.0f}, y {box[1]:.0f} to {box[3]:.0f}"
