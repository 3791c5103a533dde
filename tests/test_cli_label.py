"""`iconjax label`: the numbered sheet and the labels file, for everything that has segments."""

from __future__ import annotations

import json

import numpy as np
import pytest
from click.testing import CliRunner
from edit_support import LABELS, write_case
from PIL import Image

from iconjax.cli import main
from iconjax.render.numbered import numbered_sheet
from iconjax.scene.build import build_scene
from iconjax.scene.segment import choose

SVG = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">
<rect id="table" x="10" y="70" width="80" height="20" fill="#803020"/>
<circle cx="50" cy="40" r="20" fill="#2060e0"/></svg>"""


@pytest.fixture
def place(tmp_path, monkeypatch):
    """A current folder with a case `lamp` and an SVG."""
    write_case(tmp_path / "lamp")
    (tmp_path / "icon.svg").write_text(SVG)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(choose, "_SUGGESTERS", {})
    return tmp_path


def run(*args: str):
    return CliRunner().invoke(main, args, prog_name="iconjax")


def read(path) -> dict[str, str]:
    return json.loads(path.read_text("utf-8"))


def test_a_case_folder_gives_a_sheet_and_its_labels(place):
    result = run("label", "lamp")
    assert result.exit_code == 0, result.stderr
    assert "lamp-sheet.png: 3 segments; name them in lamp-labels.json" in result.stderr
    assert read(place / "lamp-labels.json") == {str(k): v for k, v in LABELS.items()}
    assert min(Image.open("lamp-sheet.png").size) > 800


def test_an_svg_gives_a_labels_file_that_labels_takes(place):
    result = run("label", "icon.svg", "-o", "out.png", "--template", "names.json")
    assert result.exit_code == 0, result.stderr
    names = read(place / "names.json")
    assert names["1"] == "Table"
    (place / "names.json").write_text(json.dumps({**names, "2": "Ball"}))
    request = "Move the ball 10 px to the left"
    result = run("translate", "icon.svg", request, "--labels", "names.json", "--translator", "offline")
    assert 'translate("Ball")' in result.stdout, result.stderr


def test_drawing_the_sheet_again_keeps_names_that_are_filled_in(place):
    assert run("label", "icon.svg").exit_code == 0
    made_up = read(place / "icon-labels.json")
    assert made_up == {"1": "Table", "2": "Blue circle 2"}
    (place / "icon-labels.json").write_text(json.dumps({"1": "Bench", "2": "Blue circle 2", "7": "Cloud"}))
    before = (place / "icon-sheet.png").read_bytes()
    again = run("label", "icon.svg", "--force")
    assert again.exit_code == 0, again.stderr
    assert read(place / "icon-labels.json") == {**made_up, "1": "Bench"}
    assert "named segments that there are not, which were left out: Cloud" in again.stderr
    assert (place / "icon-sheet.png").read_bytes() != before
    (place / "told.json").write_text('{"1": "Desk"}')
    assert run("label", "icon.svg", "--force", "--labels", "told.json").exit_code == 0
    assert read(place / "icon-labels.json")["1"] == "Desk"


def test_a_drawing_of_one_segment_is_told_of(place):
    (place / "dot.svg").write_text(SVG.replace(SVG.splitlines()[1], ""))
    result = run("label", "dot.svg")
    assert "dot.svg has one segment, so that nothing in it can be moved apart: split its path" in result.stderr
    assert "dot-sheet.png: 1 segment;" in result.stderr


def test_an_image_with_a_label_map_needs_no_labels(place):
    Image.open("lamp/segmentation.png").save("mask.png")
    Image.open("lamp/image.png").save("icon.png")
    result = run("label", "icon.png", "--seg", "mask.png")
    assert result.exit_code == 0, result.stderr
    names = read(place / "icon-labels.json")
    assert names["1"] == "Orange rectangle 1"
    (place / "some.json").write_text('{"1": "Lamp:Shade"}')
    assert run("label", "icon.png", "--seg", "mask.png", "--labels", "some.json", "--force").exit_code == 0
    assert read(place / "icon-labels.json") == {**names, "1": "Lamp:Shade"}


def test_nothing_is_overwritten_without_force(place):
    (place / "lamp-labels.json").write_text("mine")
    result = run("label", "lamp")
    assert result.exit_code == 2
    assert "lamp-labels.json exists: --force replaces it" in result.stderr
    assert (place / "lamp-labels.json").read_text() == "mine"
    assert not (place / "lamp-sheet.png").exists()


@pytest.mark.parametrize(
    ("args", "why"),
    [
        (("no.png",), "there is no file or folder no.png"),
        (("lamp/image.png",), "run iconjax segment lamp/image.png"),
        (("icon.svg", "--seg", "lamp/segmentation.png"), "leave out --seg"),
        (("lamp", "-o", "sheet.txt"), "ends in .png"),
        (("lamp", "-o", "a.png", "--template", "a.png"), "named twice"),
        (("lamp", "-o", "no/a.png"), "cannot write no/a.png"),
        (("lamp/image.png", "--seg", "wide.png"), "same size"),
        (("lamp/image.png", "--seg", "empty.png"), "has 0 segments"),
        (("lamp", "--suggester", "nobody"), "it can be 'anthropic'"),
    ],
)
def test_bad_input_is_one_line(place, args, why):
    Image.fromarray(np.ones((4, 8), np.uint8)).save("wide.png")
    Image.fromarray(np.zeros((96, 96), np.uint8)).save("empty.png")
    result = run("label", *args)
    assert result.exit_code == 2, result.stderr
    assert why in result.stderr
    assert result.stderr.count("\n") == 1


def test_numbers_of_small_segments_are_led_out_of_the_picture():
    mask = np.zeros((100, 100), np.uint8)
    mask[20:80, 20:80] = 1
    mask[48:51, 70:73] = 2
    picture = np.full((100, 100, 3), 200, np.uint8)
    large = numbered_sheet(build_scene(picture, mask, {1: "A", 2: "B"}))
    mask[mask == 2] = 1
    without = numbered_sheet(build_scene(picture, mask, {1: "A"}))
    right = np.s_[400:650, 84 + 880 + 4 : 84 + 880 + 70]
    assert (without[right] == 255).all()
    assert (large[right] < 60).all(axis=2).any(), "no number in the margin"


def test_a_sheet_of_many_segments_lists_them_all():
    mask = np.arange(1, 101).reshape(10, 10).repeat(4, 0).repeat(4, 1).astype(np.uint8)
    labels = {k: f"A part with quite a long name, number {k}" for k in range(1, 101)}
    sheet = numbered_sheet(build_scene(np.full((40, 40, 3), 90, np.uint8), mask, labels))
    column = sheet[:, -300:-250]
    assert (column != 255).any(), "the last column of the list is empty"
