"""`iconjax.edit`: what it accepts, and what it gives back."""

from __future__ import annotations

import json
import math
import shutil

import numpy as np
import pytest
from edit_support import LABELS, PROGRAM, REQUEST, small_picture, use_fake_search, write_case
from PIL import Image

from iconjax import EditConfig, Segmentation, edit
from iconjax.errors import InputError
from iconjax.language.base import Translation


@pytest.fixture(autouse=True)
def fake(monkeypatch):
    use_fake_search(monkeypatch)


def ways_in(folder):
    """Every way to hand over one picture."""
    case = write_case(folder / "lamp")
    image, mask = small_picture()
    paths = case / "image.png", case / "segmentation.png"
    (folder / "labels.json").write_text(json.dumps({str(k): v for k, v in LABELS.items()}))
    parts = folder / "parts"
    parts.mkdir()
    for path in (*paths, folder / "labels.json"):
        shutil.copy(path, parts)
    return {
        "arrays": ((image, mask), {"labels": LABELS}),
        "pil": ((Image.fromarray(image), Image.fromarray(mask)), {"labels": LABELS}),
        "paths": (paths, {"labels": LABELS}),
        "strings": (tuple(map(str, paths)), {"labels": folder / "labels.json"}),
        "segmentation": ((image, Segmentation(mask, LABELS)), {}),
        "mixed": ((str(paths[0]), mask.astype(np.int64)), {"labels": LABELS}),
        "case": ((case,), {}),
        "case as text": ((str(case),), {}),
        "parts": ((parts,), {}),
        "parts as text": ((str(parts),), {}),
        "parts with other labels": ((parts,), {"labels": LABELS}),
    }


def test_every_way_in_gives_the_same_result(tmp_path):
    ways = ways_in(tmp_path)
    results = {name: edit(*args, program=PROGRAM, **extra) for name, (args, extra) in ways.items()}
    first = results["arrays"]
    for name, result in results.items():
        assert np.array_equal(result.image, first.image), name
        assert result.program == first.program, name


def test_result_holds_what_the_contract_says():
    image, mask = small_picture()
    result = edit(image, mask, labels=LABELS, program=PROGRAM)
    assert result.image.shape == (96, 96, 3)
    assert result.image.dtype == np.uint8
    assert set(result.transforms) == {1, 2, 3}
    assert all(m.shape == (2, 3) and m.dtype == np.float64 for m in result.transforms.values())
    assert np.array_equal(result.transforms[2], np.eye(2, 3))
    assert result.translator == "program"
    assert result.satisfied
    assert sorted(result.depth_order) == [1, 2, 3]
    assert set(result.timings) == {"translate", "compile", "search", "render"}
    assert len(result.program) == 2


def test_json_has_exactly_the_keys_of_the_contract(tmp_path):
    result = edit(write_case(tmp_path / "lamp"), program=PROGRAM)
    data = json.loads(result.to_json(tmp_path / "r.json"))
    assert json.loads((tmp_path / "r.json").read_text("utf-8")) == data
    keys = "request program translator satisfied score transforms motion_states relations constraints"
    assert list(data) == [*keys.split(), "depth_order", "timings", "version"]
    assert list(data["relations"][0]) == ["a", "b", "kind", "scope", "state"]
    assert list(data["constraints"][0]) == ["text", "role", "violation", "satisfied"]
    assert list(data["timings"]) == ["translate", "compile", "search", "render"]
    assert data["request"] == REQUEST
    assert data["motion_states"] == {"1": "T", "2": "N", "3": "N"}
    assert data["transforms"]["1"] == [[1, 0, 8], [0, 1, 0]]


def test_a_missed_constraint_is_told_and_json_stays_valid(monkeypatch):
    use_fake_search(monkeypatch, satisfied=False)
    image, mask = small_picture()
    result = edit(image, mask, labels=LABELS, program=PROGRAM)
    assert not result.satisfied
    assert math.isinf(result.score)
    assert json.loads(result.to_json())["score"] is None
    assert "MISSED" in result.explain()
    assert "12.3 px" in result.explain()


class Echo:
    """A translator that always says the same."""

    name = "echo"

    def translate(self, request, scene):
        return Translation(tuple(PROGRAM.splitlines()), "echo", (f"heard {len(scene.segments)} segments",))


def test_own_translator_is_used_and_named(tmp_path):
    result = edit(write_case(tmp_path / "lamp"), translator=Echo())
    assert result.translator == "echo"
    assert result.understood == ("heard 3 segments",)
    assert result.request == REQUEST
    assert "heard 3 segments" in result.explain()


def test_a_folder_made_by_segment_has_no_request_of_its_own(tmp_path):
    (parts,), _ = ways_in(tmp_path)["parts"]
    assert edit(parts, request=REQUEST, translator=Echo()).request == REQUEST
    with pytest.raises(InputError, match="the request is empty"):
        edit(parts)


def test_request_given_wins_over_the_case(tmp_path):
    assert edit(write_case(tmp_path / "lamp"), request="other", translator=Echo()).request == "other"


def test_automatic_translator_is_offline_without_credentials(tmp_path, monkeypatch):
    monkeypatch.delenv("ANTHROPIC_API_KEY", raising=False)
    monkeypatch.delenv("ANTHROPIC_AUTH_TOKEN", raising=False)
    result = edit(write_case(tmp_path / "lamp", request="Rotate the lamp by 20 degrees"))
    assert result.translator == "offline"


def test_program_as_text_list_and_file_are_the_same(tmp_path):
    case = write_case(tmp_path / "lamp")
    (tmp_path / "p.txt").write_text("# a comment\n\n" + PROGRAM)
    results = [edit(case, program=p) for p in (PROGRAM, PROGRAM.splitlines(), tmp_path / "p.txt")]
    assert len({r.program for r in results}) == 1


def test_inputs_are_not_changed():
    image, mask = small_picture()
    before = image.copy(), mask.copy()
    result = edit(image, mask, labels=LABELS, program=PROGRAM, config=EditConfig(strategy="paper"))
    result.image[:] = 0
    assert np.array_equal(image, before[0])
    assert np.array_equal(mask, before[1])
