"""The offline translator on a set of requests in varied words, written before the grammar was."""

from __future__ import annotations

import json
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from iconjax.errors import TranslationError
from iconjax.language.canonical import canonical
from iconjax.language.offline import OfflineTranslator
from iconjax.scene.types import Scene, Segment

DATA = json.loads((Path(__file__).parent / "data" / "requests.json").read_text(encoding="utf-8"))


def make_scene(shapes: dict[str, Any], size: int = 512) -> Scene:
    """A scene of boxes [x0, y0, x1, y1] and polygons [[x, y], ...]."""
    segments = []
    for number, (name, shape) in enumerate(shapes.items(), 1):
        if not isinstance(shape[0], list):
            x0, y0, x1, y1 = shape
            shape = [[x0, y0], [x0, y1], [x1, y1], [x1, y0]]
        loop = np.array(shape, float)
        (x0, y0), (x1, y1) = loop.min(0), loop.max(0)
        whole, _, part = name.partition(":")
        mask = np.zeros((1, 1), bool)
        area = float((x1 - x0) * (y1 - y0))
        segments.append(Segment(number, name, whole, part or None, mask, (loop,), area, (x0, y0, x1, y1)))
    return Scene(np.zeros((size, size, 3), np.uint8), tuple(segments), np.full(3, 255, np.uint8))


SCENES = {name: make_scene(shapes) for name, shapes in DATA["scenes"].items()}


def translate(scene: str, request: str) -> tuple[str, ...]:
    return OfflineTranslator().translate(request, SCENES[scene]).program


@pytest.mark.parametrize("case", [c for c in DATA["requests"] if c["program"] is not None], ids=lambda c: c["request"])
def test_reads_right(case: dict[str, Any]) -> None:
    """Lines that begin with "?" may be there or not."""
    got = {canonical(line) for line in translate(case["scene"], case["request"])}
    needed = {canonical(line) for line in case["program"] if not line.startswith("?")}
    allowed = {canonical(line[1:]) for line in case["program"] if line.startswith("?")}
    assert needed - got == set()
    assert got - needed - allowed == set()


@pytest.mark.parametrize("case", [c for c in DATA["requests"] if c["program"] is None], ids=lambda c: c["request"])
def test_refuses(case: dict[str, Any]) -> None:
    with pytest.raises(TranslationError) as caught:
        translate(case["scene"], case["request"])
    assert "\n" not in str(caught.value)
    assert SCENES[case["scene"]].objects[0] in str(caught.value)


def test_is_fast() -> None:
    """Under 50 ms a request, the lexicon being read."""
    translate("desk", "move the mug 20 px up")
    start = time.perf_counter()
    for case in DATA["requests"]:
        with suppress(TranslationError):
            translate(case["scene"], case["request"])
    assert (time.perf_counter() - start) / len(DATA["requests"]) < 0.05


def test_programs_parse() -> None:
    """Every program the translator writes is one the DSL accepts."""
    parse = pytest.importorskip("iconjax.dsl.parse").parse
    for case in DATA["requests"]:
        if case["program"] is not None:
            scene = SCENES[case["scene"]]
            parse(translate(case["scene"], case["request"]), scene.names, scene.objects)
