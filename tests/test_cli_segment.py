"""`iconjax segment`: what it writes, what the other commands do with it, and what it refuses."""

from __future__ import annotations

import json
import os

import numpy as np
import pytest
from click.testing import CliRunner
from edit_support import use_fake_search, write_case
from PIL import Image
from segment_support import BALL, BOX, draw

from iconjax.cli import main
from iconjax.errors import InputError
from iconjax.scene.segment import choose
from iconjax.scene.segment.names import is_provisional

TWO = {"1": "Red circle 1", "2": "Blue rectangle 2"}


@pytest.fixture
def place(tmp_path, monkeypatch):
    """An empty current folder with a picture `icon.png`."""
    monkeypatch.chdir(tmp_path)
    draw(BALL, BOX).save("icon.png")
    return tmp_path


@pytest.fixture
def suggesters(monkeypatch):
    """An empty table of label suggesters."""
    table: dict = {}
    monkeypatch.setattr(choose, "_SUGGESTERS", table)
    return table


class Namer:
    """Names the first segment, or fails."""

    name = "namer"

    def __init__(self, fails: bool = False) -> None:
        self.fails = fails

    def suggest(self, image, segmentation):
        if self.fails:
            raise InputError("the model is asleep: try again")
        return {1: "Toy:Ball"}


def run(*args: str):
    return CliRunner().invoke(main, args, prog_name="iconjax")


def test_a_folder_with_everything_and_nothing_on_stdout(place):
    result = run("segment", "icon.png", "-o", "parts")
    assert result.exit_code == 0, result.stderr
    assert result.stdout == ""
    assert result.stderr.startswith("iconjax: parts: 2 segments; see sheet.png")
    assert sorted(os.listdir("parts")) == ["image.png", "labels.json", "segmentation.png", "sheet.png"]
    assert json.loads((place / "parts/labels.json").read_text("utf-8")) == TWO
    mask = np.asarray(Image.open("parts/segmentation.png"))
    assert mask.dtype == np.uint8
    assert sorted(np.unique(mask)) == [0, 1, 2]
    assert (np.asarray(Image.open("parts/image.png")) == np.asarray(Image.open("icon.png"))).all()


def test_the_folder_is_edited_under_the_names_in_its_labels_file(place, monkeypatch):
    assert run("segment", "icon.png", "-o", "parts").exit_code == 0
    first = run("translate", "parts", "Move the red circle 10 px to the left", "--translator", "offline")
    assert 'translate("Red circle 1")' in first.stdout, first.stderr
    (place / "parts/labels.json").write_text(json.dumps({"1": "Toy:Ball", "2": "Toy:Brick"}))
    second = run("translate", "parts", "Move the ball 10 px to the left", "--translator", "offline")
    assert 'translate("Toy:Ball")' in second.stdout, second.stderr
    use_fake_search(monkeypatch)
    (place / "p.txt").write_text('translate("Toy:Ball")')
    result = run("edit", "parts", "--program", "p.txt")
    assert result.exit_code == 0, result.stderr
    assert (place / "parts-edited.png").exists()
    assert run("relations", "parts").exit_code == 0


@pytest.mark.parametrize("name", ["image.png", "segmentation.png", "labels.json", "sheet.png"])
def test_an_edit_overwrites_no_file_of_the_folder(place, name):
    assert run("segment", "icon.png", "-o", "parts").exit_code == 0
    (place / "p.txt").write_text('translate("Red circle 1")')
    before = (place / "parts" / name).read_bytes()
    output = "--json" if name.endswith(".json") else "-o"
    result = run("edit", "parts", "--program", "p.txt", output, f"parts/{name}")
    assert (result.exit_code, "is an input" in result.stderr) == (2, True)
    assert (place / "parts" / name).read_bytes() == before


def test_options_win_over_the_files_of_the_folder(place):
    assert run("segment", "icon.png", "-o", "parts").exit_code == 0
    (place / "mine.json").write_text(json.dumps({"1": "Toy:Ball", "2": "Toy:Brick"}))
    request = "Move the ball 10 px to the left"
    result = run("translate", "parts", request, "--labels", "mine.json", "--translator", "offline")
    assert 'translate("Toy:Ball")' in result.stdout, result.stderr


@pytest.mark.parametrize(
    "word", ["circle", "ring", "oval", "square", "rectangle", "bar", "triangle", "piece", "ellipse", "line"]
)
def test_provisional_names_are_understood_in_requests(place, word):
    mask = np.zeros((60, 90), np.uint8)
    for k in range(3):
        mask[20:40, 5 + 30 * k : 25 + 30 * k] = k + 1
    (place / "parts").mkdir()
    Image.fromarray(mask).save("parts/segmentation.png")
    Image.fromarray(np.repeat(255 - 80 * mask[..., None], 3, 2)).save("parts/image.png")
    names = {"1": f"Red {word} 1", "2": f"Light gray {word} 2", "3": f"Red {word} 3"}
    (place / "parts/labels.json").write_text(json.dumps(names))
    for words, name in (
        (f"the light gray {word}", names["2"]),
        (f"the right red {word}", names["3"]),
        (f"red {word} 1", names["1"]),
        (f"{word} 3", names["3"]),
    ):
        result = run("translate", "parts", f"Move {words} 10 px up", "--translator", "offline")
        assert f'translate("{name}")' in result.stdout, result.stderr


def test_the_number_on_the_sheet_is_that_in_the_name_and_in_the_label_map(place):
    draw(BOX, BALL, ("rectangle", (4, 100, 24, 124), "#c03020")).save("icon.png")
    result = run("segment", "icon.png", "-o", "parts", "--merge", "1,2")
    assert "parts: 2 segments;" in result.stderr
    names = json.loads((place / "parts/labels.json").read_text("utf-8"))
    assert all(name.endswith(f" {k}") and is_provisional(name, int(k)) for k, name in names.items())
    assert not is_provisional("Ball 3", 3) and not is_provisional("Red circle 1", 2)


def test_one_segment_cannot_be_moved_apart(place):
    draw(BALL).save("icon.png")
    result = run("segment", "icon.png", "-o", "parts")
    assert "icon.png has one segment, so that nothing in it can be moved apart" in result.stderr
    assert "parts: 1 segment; see" in result.stderr


def test_nothing_is_overwritten_without_force(place):
    assert run("segment", "icon.png", "-o", "parts").exit_code == 0
    (place / "parts/labels.json").write_text('{"1": "Mine", "2": "Yours"}')
    again = run("segment", "icon.png", "-o", "parts")
    assert again.exit_code == 2
    assert "exists: --force replaces it" in again.stderr
    assert "Mine" in (place / "parts/labels.json").read_text()
    assert run("segment", "icon.png", "-o", "parts", "--force").exit_code == 0
    assert "Mine" not in (place / "parts/labels.json").read_text()


def test_segments_are_merged_and_holes_kept_on_demand(place):
    draw(BALL, BOX, ("ellipse", (30, 30, 50, 50), "white")).save("icon.png")
    assert run("segment", "icon.png", "-o", "a", "--holes").exit_code == 0
    names = json.loads((place / "a/labels.json").read_text("utf-8"))
    assert "White circle 1" in names.values()
    assert run("segment", "icon.png", "-o", "c", "--most", "1").exit_code == 0
    assert run("segment", "icon.png", "-o", "b", "--merge", "1,2").exit_code == 0
    assert list(json.loads((place / "b/labels.json").read_text("utf-8"))) == ["1"]
    assert np.asarray(Image.open("b/segmentation.png")).max() == 1


def test_a_suggester_names_what_it_knows(place, suggesters):
    choose.register_suggester("namer", Namer)
    assert run("segment", "icon.png", "-o", "a").exit_code == 0
    assert json.loads((place / "a/labels.json").read_text("utf-8")) == {**TWO, "1": "Toy:Ball"}
    assert run("segment", "icon.png", "-o", "b", "--suggester", "none").exit_code == 0
    assert json.loads((place / "b/labels.json").read_text("utf-8")) == TWO


def test_a_suggester_that_fails_costs_only_its_names_unless_asked_for(place, suggesters):
    choose.register_suggester("namer", lambda: Namer(fails=True))
    result = run("segment", "icon.png", "-o", "a")
    assert result.exit_code == 0
    assert "segments keep provisional names: the model is asleep" in result.stderr
    result = run("segment", "icon.png", "-o", "b", "--suggester", "namer")
    assert (result.exit_code, os.path.exists("b/labels.json")) == (2, False)


def test_a_suggester_that_is_not_available_is_chosen_by_name_only(place, suggesters):
    choose.register_suggester("namer", Namer, available=lambda: False)
    assert run("segment", "icon.png", "-o", "a").exit_code == 0
    assert json.loads((place / "a/labels.json").read_text("utf-8")) == TWO
    assert run("segment", "icon.png", "-o", "b", "--suggester", "namer").exit_code == 0
    assert json.loads((place / "b/labels.json").read_text("utf-8")) == {**TWO, "1": "Toy:Ball"}


@pytest.mark.parametrize(
    ("args", "why"),
    [
        (("no.png",), "there is no file no.png"),
        (("icon.svg",), "iconjax label icon.svg shows them"),
        (("folder",), "is a folder: give an image file"),
        (("text.png",), "is not an image Pillow can read"),
        (("blank.png",), "nothing to segment"),
        (("icon.png", "-o", "text.png"), "is a file: give -o a folder"),
        (("icon.png", "-o", "case"), "is a case folder"),
        (("icon.png", "-o", "text.png/parts"), "cannot make the folder text.png/parts"),
        (("icon.png", "--method", "colours"), "did you mean 'colour'"),
        (("icon.png", "--most", "0"), "1<=x<=80"),
        (("icon.png", "--merge", "1"), "write the numbers of two segments"),
        (("icon.png", "--merge", "1,7"), "cannot merge segment 7"),
    ],
)
def test_bad_input_is_one_line_and_leaves_nothing(place, args, why):
    write_case(place / "case")
    (place / "folder").mkdir()
    (place / "text.png").write_text("no picture")
    Image.new("RGB", (32, 32), "red").save("blank.png")
    before = sorted(os.listdir())
    result = run("segment", *args)
    assert result.exit_code == 2, result.stderr
    assert why in result.stderr
    assert result.stderr.count("\n") == 1
    assert sorted(os.listdir()) == before
