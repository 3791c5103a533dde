"""Names for the segments of a picture that has none, by a vision LLM: from a sheet on which they are numbered."""

from __future__ import annotations

import hashlib
from typing import Any

from iconjax.errors import InputError
from iconjax.language.llm.exchange import Client, Exchange, Picture, Turn
from iconjax.language.llm.faults import LlmError, one_line
from iconjax.language.llm.jsontext import object_schema, read_json_object
from iconjax.language.llm.prompt import text
from iconjax.scene.labels import check_labels

MOST_SEGMENTS = 200
LONGEST_NAME = 60
_ROW = object_schema({"number": {"type": "integer"}, "name": {"type": "string"}})
SCHEMA = object_schema({"labels": {"type": "array", "items": _ROW}})


def name_segments(sheet: bytes, count: int, client: Client) -> dict[int, str]:
    """`Object:Part` names of the segments 1 to `count`, as far as the model knows them.

    Args:
        sheet: PNG on which every segment is numbered.
        count: how many there are.
        client: who answers; it has to see pictures.

    Raises:
        LlmError: no usable answer.
    """
    return read_names(client.send(labels_exchange(sheet, count)).text, count)


def labels_exchange(sheet: bytes, count: int) -> Exchange:
    """The question about a numbered sheet."""
    if not 1 <= count <= MOST_SEGMENTS:
        raise LlmError(f"{count} segments cannot be named at once; it can be 1 to {MOST_SEGMENTS}")
    digest = _pixels(sheet)
    question = Turn("user", f"The picture has {count} numbered segments.", Picture(sheet, digest))
    return Exchange(
        "labels", f"names of {count} segments of sheet {digest[:8]}", text("labels.md"), (question,), SCHEMA
    )


def read_names(reply: str, count: int) -> dict[int, str]:
    """The names in a reply; what is no name of a known segment is left out.

    Raises:
        LlmError: it holds none.
    """
    rows = read_json_object(reply).get("labels")
    names: dict[int, str] = {}
    for row in rows if isinstance(rows, list) else ():
        name = _name(row, count)
        if name is not None:
            names.setdefault(row["number"], name)
    if not names:
        raise LlmError("the model's reply names no segment")
    return dict(sorted(names.items()))


def _name(row: Any, count: int) -> str | None:
    number, name = (row.get("number"), row.get("name")) if isinstance(row, dict) else (None, None)
    if not isinstance(number, int) or isinstance(number, bool) or not 1 <= number <= count or not isinstance(name, str):
        return None
    try:
        return check_labels({number: one_line(name, LONGEST_NAME)})[number]
    except InputError:
        return None


def _pixels(sheet: bytes) -> str:
    """Hash of what a PNG shows, whatever wrote it."""
    import io

    from PIL import Image, UnidentifiedImageError

    try:
        image = Image.open(io.BytesIO(sheet)).convert("RGB")
    except (OSError, UnidentifiedImageError, Image.DecompressionBombError) as error:
        raise LlmError(f"the numbered sheet is no picture: {error}") from None
    return hashlib.sha256(repr(image.size).encode() + image.tobytes()).hexdigest()
