"""The offline translator on the requests of the benchmark: read, or refused in words."""

from __future__ import annotations

from pathlib import Path

import pytest

from iconjax.dsl.parse import parse
from iconjax.errors import TranslationError
from iconjax.language.offline import OfflineTranslator
from iconjax.scene.build import build_scene
from iconjax.scene.load import load_case

FOLDERS = sorted(p.parent for p in (Path(__file__).parents[1] / "eval" / "benchmark").glob("*/case.json"))
REFUSED_AT_MOST = 12


@pytest.mark.skipif(not FOLDERS, reason="the benchmark is not part of this checkout")
def test_reads_the_benchmark() -> None:
    refused = []
    for folder in FOLDERS:
        case = load_case(folder)
        scene = build_scene(case.image, case.segmentation)
        try:
            program = OfflineTranslator().translate(case.request, scene).program
        except TranslationError:
            refused.append(case.id)
            continue
        parse(program, scene.names, scene.objects)
    assert len(refused) <= REFUSED_AT_MOST, refused
