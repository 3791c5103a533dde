"""The whole job with the real engine, on a picture small enough for it to be quick."""

from __future__ import annotations

import json

import numpy as np
from click.testing import CliRunner
from edit_support import LABELS, PROGRAM, small_picture, write_case

from iconjax import edit
from iconjax.cli import main


def test_a_program_is_met_and_the_rest_stays():
    image, mask = small_picture()
    result = edit(image, mask, labels=LABELS, program=PROGRAM)
    assert result.satisfied, result.explain()
    moved = result.transforms[1]
    centre = np.array([40.0, 25.0, 1.0])
    assert np.allclose(moved @ centre, [48.0, 25.0], atol=1.0)
    assert np.array_equal(result.transforms[3], np.eye(2, 3))
    assert np.array_equal(result.image[72:], image[72:])
    assert not np.array_equal(result.image, image)
    assert result.trace
    assert json.loads(result.to_json())["satisfied"]
    assert "Lamp:Shade" in result.to_html()


def test_a_sentence_is_understood_and_done(tmp_path, monkeypatch):
    write_case(tmp_path / "lamp")
    monkeypatch.chdir(tmp_path)
    request = "Rotate the lamp by 20 degrees clockwise"
    done = CliRunner().invoke(main, ["edit", "lamp", request, "--translator", "offline", "--json", "-"])
    assert done.exit_code == 0, done.stderr
    data = json.loads(done.stdout)
    assert data["translator"] == "offline"
    assert data["satisfied"], data["constraints"]
    for number in ("1", "2"):
        (a, _, _), (c, _, _) = data["transforms"][number]
        assert abs(np.degrees(np.arctan2(c, a)) - 20) < 2
    assert (tmp_path / "lamp-edited.png").exists()
