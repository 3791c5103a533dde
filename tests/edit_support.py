"""A small picture, and a stand-in for the search, for tests of everything around the engine."""

from __future__ import annotations

import json
import math
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from iconjax.dsl.pretty import to_text
from iconjax.search.types import ConstraintReport, RelationReport, SearchOutcome, TraceEntry

LABELS = {1: "Lamp:Shade", 2: "Lamp:Foot", 3: "Table"}
PROGRAM = 'translate("Lamp:Shade")\nequal(center_x("Lamp:Shade"), plus(center_x(old("Lamp:Shade")), 8))'
REQUEST = "Move the lamp's shade 8 px to the right"


def small_picture() -> tuple[np.ndarray, np.ndarray]:
    """A lamp on a table, 96 x 96, and its label map."""
    mask = np.zeros((96, 96), np.uint8)
    mask[10:40, 20:60] = 1
    mask[40:70, 36:44] = 2
    mask[70:80, 10:86] = 3
    colours = np.array([[255, 255, 255], [230, 160, 40], [90, 90, 90], [120, 70, 40]], np.uint8)
    return colours[mask], mask


def write_case(folder: Path, request: str = REQUEST, **changes: object) -> Path:
    """A case folder with the small picture; `changes` replaces entries of its `case.json`."""
    folder.mkdir(parents=True)
    image, mask = small_picture()
    Image.fromarray(image).save(folder / "image.png")
    Image.fromarray(mask).save(folder / "segmentation.png")
    case = {"id": folder.name, "request": request, "labels": {str(k): v for k, v in LABELS.items()}}
    case |= {"source": "drawn for tests", "license": "MIT", **changes}
    (folder / "case.json").write_text(json.dumps(case), encoding="utf-8")
    return folder


def fake_search(satisfied: bool = True):
    """A `search_edit` that moves the first segment 8 px right and reports one of each thing."""

    def search_edit(scene, program, config, advice=None):
        matrices = np.tile(np.eye(2, 3), (len(scene.segments), 1, 1))
        matrices[0, 0, 2] = 8
        first, second = scene.names[:2]
        texts = to_text(program)
        constraints = tuple(
            ConstraintReport(t, "primary", 0.0 if satisfied else 12.345, "px", satisfied) for t in texts
        )
        trace = (
            TraceEntry(0, "start <b>", {first: "T"}, (), math.inf, {"primary": math.inf}, False, "a constraint fails"),
            TraceEntry(
                1,
                "loosen",
                {first: "T"},
                ((first, second, "WK"),),
                2.5,
                {"slide": 2.0, "move": 0.5},
                True,
                "least",
            ),
        )
        return SearchOutcome(
            matrices=matrices,
            motion_states={s.id: "T" if i == 0 else "N" for i, s in enumerate(scene.segments)},
            relations=(RelationReport(first, second, "overlap", "intra-crucial", "WK"),),
            constraints=constraints,
            score=2.5 if satisfied else math.inf,
            trace=trace,
            timings={"compile": 0.5, "search": 0.25},
            notes=() if satisfied else ("no state satisfies everything",),
        )

    return search_edit


def use_fake_search(monkeypatch: pytest.MonkeyPatch, satisfied: bool = True) -> None:
    """Put the stand-in in place of the engine."""
    # By module, not by dotted name: `iconjax.edit` is the function.
    monkeypatch.setattr(import_module("iconjax.edit.attempt"), "search_edit", fake_search(satisfied))
