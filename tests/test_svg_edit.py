"""SVG in, SVG out: the API and the command line."""

from __future__ import annotations

import gzip
import json

import numpy as np
import pytest
from click.testing import CliRunner
from edit_support import LABELS, small_picture
from PIL import Image
from svg_features import svg

from iconjax import edit
from iconjax.cli import main
from iconjax.errors import InputError
from iconjax.scene.svg import open_svg

ICON = svg(
    '<g id="lamp">\n <path id="shade" d="M8 3h8l3 7H5z" fill="#d33"/>\n <path id="pole" d="M11 10h2v9h-2z"/>\n</g>'
    '<rect id="table" x="2" y="19" width="20" height="3" fill="#963"/>'
)
PROGRAM = ['translate("Lamp:Shade")', 'equal(min_x("Lamp:Shade"), minus(min_x(old("Lamp:Shade")), 21.333))']


@pytest.fixture
def icon(tmp_path):
    path = tmp_path / "icon.svg"
    path.write_bytes(ICON)
    return path


def test_an_svg_is_edited_and_written_back(icon, tmp_path):
    result = edit(icon, program=PROGRAM)
    assert result.satisfied
    assert result.scene.names == ("Lamp:Shade", "Lamp:Pole", "Table")
    assert result.image.shape == (512, 512, 3)
    moved = [k for k, m in result.transforms.items() if not np.allclose(m, np.eye(2, 3))]
    assert moved
    result.save(tmp_path / "out.svg")
    text = (tmp_path / "out.svg").read_text("utf-8")
    assert text.count("transform=") >= 1
    again = open_svg(tmp_path / "out.svg")
    assert abs(again.scene.segments[0].box[0] - (result.scene.segments[0].box[0] - 21.333)) < 0.6
    result.save(tmp_path / "out.svgz")
    assert gzip.decompress((tmp_path / "out.svgz").read_bytes()) == (tmp_path / "out.svg").read_bytes()
    result.save(tmp_path / "out.png")
    assert np.array_equal(np.asarray(Image.open(tmp_path / "out.png")), result.image)


def test_a_sentence_moves_what_it_names(icon):
    result = edit(str(icon), request="Move the shade to the left by 10 pixels", translator="offline")
    assert result.satisfied
    assert result.transforms[1][0, 2] < -9


def test_an_opened_svg_can_be_edited(icon):
    vector = open_svg(icon, {3: "Desk"}, size=256)
    result = edit(vector, request="Move the desk down by 5 pixels", translator="offline")
    assert result.image.shape == (256, 256, 3)
    with pytest.raises(InputError, match="give labels to open_svg"):
        edit(vector, request="Move the desk", labels={1: "Sun"})


def test_notes_of_the_drawing_are_those_of_the_result(tmp_path):
    path = tmp_path / "note.svg"
    path.write_bytes(ICON.replace(b"</svg>", b"<text>hi</text></svg>"))
    result = edit(path, program=PROGRAM)
    assert any("text (not drawn)" in note for note in result.notes)
    assert "text (not drawn)" in result.to_html()


def test_what_was_no_svg_is_not_saved_as_one(tmp_path):
    image, mask = small_picture()
    result = edit(image, mask, labels=LABELS, program=[f'stay("{next(iter(LABELS.values()))}")'])
    with pytest.raises(InputError, match="only an edited SVG can be saved as SVG"):
        result.save(tmp_path / "out.svg")


def test_an_svg_takes_no_segmentation(icon):
    with pytest.raises(InputError, match="leave out seg"):
        edit(icon, np.zeros((4, 4), int), request="x")


def test_the_command_line(icon, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run = CliRunner().invoke
    request = ["Move the shade to the left by 10 pixels", "--translator", "offline"]
    done = run(main, ["edit", "icon.svg", *request])
    assert done.exit_code == 0, done.output
    assert "transform=" in (tmp_path / "icon-edited.svg").read_text("utf-8")
    done = run(main, ["edit", "icon.svg", *request, "-o", "out.png", "--json", "out.json"])
    assert done.exit_code == 0, done.output
    assert Image.open("out.png").size == (512, 512)
    assert set(json.loads((tmp_path / "out.json").read_text("utf-8"))["transforms"]) == {"1", "2", "3"}
    done = run(main, ["relations", "icon.svg"])
    assert "Lamp:Shade  Lamp:Pole" in done.output
    done = run(main, ["translate", "icon.svg", *request])
    assert 'translate("Lamp:Shade")' in done.output


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        (["edit", "icon.svg", "x", "--seg", "mask.png"], "leave out --seg"),
        (["edit", "icon.svg", "x", "-o", "icon.svg"], "it is not overwritten"),
        (["edit", "none.svg", "x"], "there is no file"),
        (["edit", "broken.svg", "x"], "not well-formed XML"),
        (["edit", "out.png", "x", "--seg", "out.png", "-o", "out.svg"], "only an edited SVG can be saved as SVG"),
    ],
)
def test_bad_commands_are_one_line(icon, tmp_path, monkeypatch, arguments, error):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "broken.svg").write_bytes(ICON[:-20])
    Image.new("L", (8, 8)).save("out.png")
    done = CliRunner().invoke(main, arguments)
    assert done.exit_code == 2
    assert error in done.output
    assert len(done.output.strip().splitlines()) == 1
