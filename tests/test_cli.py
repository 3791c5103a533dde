"""The command line: what it prints where, what it writes, and how it exits."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from edit_support import LABELS, PROGRAM, use_fake_search, write_case
from PIL import Image

import iconjax
from iconjax import console
from iconjax.checks import default_output
from iconjax.cli import main


@pytest.fixture
def place(tmp_path, monkeypatch):
    """An empty current folder with a case `lamp` and a program, and the stand-in for the search."""
    write_case(tmp_path / "lamp")
    (tmp_path / "program.txt").write_text(PROGRAM)
    monkeypatch.chdir(tmp_path)
    use_fake_search(monkeypatch)
    return tmp_path


def run(*args: str, stdin: str | None = None):
    return CliRunner().invoke(main, args, input=stdin, prog_name="iconjax")


def test_edit_writes_the_picture_and_is_quiet_on_stdout(place):
    result = run("edit", "lamp", "--program", "program.txt")
    assert result.exit_code == 0, result.stderr
    assert result.stdout == ""
    assert result.stderr == "iconjax: lamp-edited.png: 2 of 2 constraints hold (program)\n"
    assert np.asarray(Image.open("lamp-edited.png")).shape == (96, 96, 3)
    assert sorted(os.listdir()) == ["lamp", "lamp-edited.png", "program.txt"]


def test_edit_of_an_image_writes_everything_asked_for(place):
    (place / "labels.json").write_text(json.dumps({str(k): v for k, v in LABELS.items()}))
    files = ["-o", "out.png", "--json", "out.json", "--trace", "out.html"]
    given = ["--seg", "lamp/segmentation.png", "--labels", "labels.json", "--program", "program.txt"]
    result = run("edit", "lamp/image.png", *given, *files)
    assert result.exit_code == 0, result.stderr
    assert json.loads((place / "out.json").read_text("utf-8"))["satisfied"]
    assert (place / "out.html").read_text("utf-8").startswith("<!doctype html>")


def test_json_can_go_to_stdout_and_program_come_from_stdin(place):
    result = run("edit", "lamp", "--program", "-", "--json", "-", stdin=PROGRAM)
    assert result.exit_code == 0, result.stderr
    assert json.loads(result.stdout)["program"] == PROGRAM.splitlines()


def test_a_missed_constraint_is_told_and_the_result_is_written(place, monkeypatch):
    use_fake_search(monkeypatch, satisfied=False)
    args = ("edit", "lamp", "--program", "program.txt", "-o", "out.png")
    result = run(*args)
    assert result.exit_code == 0
    assert 'iconjax: missed translate("Lamp:Shade") by 12.3 px\n' in result.stderr
    assert "0 of 2 constraints hold" in result.stderr
    assert (place / "out.png").exists()
    assert run(*args, "--strict").exit_code == 1


def test_strict_is_no_matter_when_everything_holds(place):
    assert run("edit", "lamp", "--program", "program.txt", "--strict").exit_code == 0


@pytest.mark.parametrize("ending", ["jpg", "webp", "bmp", "tiff", "PNG"])
def test_the_name_decides_the_format(place, ending):
    assert run("edit", "lamp", "--program", "program.txt", "-o", f"out.{ending}").exit_code == 0
    assert Image.open(f"out.{ending}").size == (96, 96)


def test_default_output_never_is_the_input(place):
    assert str(default_output("lamp")) == "lamp-edited.png"
    assert str(default_output("lamp/image.png")) == "image-edited.png"
    assert str(default_output("lamp/.")) == "lamp-edited.png"
    os.chdir("lamp")
    assert str(default_output(".")) == "lamp-edited.png"


def test_translate_prints_a_program_that_edit_takes(place):
    result = run("translate", "lamp", "Rotate the lamp by 20 degrees clockwise", "--translator", "offline")
    assert result.exit_code == 0, result.stderr
    assert "# translator: offline" in result.stdout
    assert 'rotate("Lamp")' in result.stdout
    again = run("edit", "lamp", "--program", "-", stdin=result.stdout)
    assert again.exit_code == 0, again.stderr


def test_relations_are_printed(place):
    result = run("relations", "lamp")
    assert result.exit_code == 0, result.stderr
    assert "Lamp:Shade  Lamp:Foot  overlap  intra-crucial" in result.stdout
    rows = json.loads(run("relations", "lamp", "--json").stdout)
    assert [(r["a"], r["b"]) for r in rows] == [("Lamp:Shade", "Lamp:Foot"), ("Lamp:Foot", "Table")]


def test_dsl_lists_and_describes():
    everything = run("dsl").stdout
    assert "coincide_on_point(" in everything
    assert '"canvas"' in everything
    assert run("dsl", "touch").stdout.startswith("touch(S: Segment, T: Segment) -> Violation")
    wrong = run("dsl", "tuch")
    assert wrong.exit_code == 2
    assert 'did you mean "touch"' in wrong.stderr


def test_eval_writes_a_report(place):
    result = run("eval", "lamp", "--out", "report", "--method", "no such method")
    assert result.exit_code == 2
    assert "unknown method" in result.stderr
    assert not (place / "report").exists()


def test_bare_command_and_version_say_what_there_is():
    assert "relations" in run().stdout
    assert run("--version").stdout.split() == ["iconjax", iconjax.__version__]


def test_progress_is_silent_off_a_terminal_and_vanishes_on_one(capsys, monkeypatch):
    with console.progress() as stage:
        stage("thinking")
    assert capsys.readouterr().err == ""
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True, raising=False)
    with console.progress() as stage:
        stage("thinking")
    assert capsys.readouterr().err.endswith("thinking ...\r\x1b[K")


def test_a_bug_is_one_line_too(place, monkeypatch):
    monkeypatch.setattr("iconjax.checks.image_format", lambda path: 1 / 0)
    result = run("edit", "lamp", "--program", "program.txt")
    assert result.exit_code == console.BUG
    assert result.stderr.startswith("iconjax: error: internal error")
    assert result.stderr.count("\n") == 1


def test_a_closed_pipe_is_no_error(place):
    root = Path(iconjax.__file__).parents[1]
    command = [sys.executable, "-m", "iconjax", "dsl"]
    with subprocess.Popen(command, cwd=root, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.close()
        assert process.stderr.read() == b""


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
def test_a_full_disk_behind_stdout_is_one_line():
    root = Path(iconjax.__file__).parents[1]
    with open("/dev/full", "wb") as full:
        done = subprocess.run([sys.executable, "-m", "iconjax", "dsl"], cwd=root, stdout=full, stderr=subprocess.PIPE)
    assert done.returncode == 2
    assert done.stderr == b"iconjax: error: no space left on device\n"


def test_a_request_beside_a_program_is_not_ignored(place):
    result = run("edit", "lamp", "Move the shade up", "--program", "program.txt")
    assert result.exit_code == 2
    assert "--program takes the place of a request: leave out one of them" in result.stderr


def test_a_folder_that_is_no_picture_names_both_kinds_that_are(place):
    (place / "stuff").mkdir()
    result = run("edit", "stuff", "Move the shade up")
    assert result.exit_code == 2
    assert "a case folder has case.json" in result.stderr and "iconjax segment" in result.stderr


def test_an_edited_svg_may_be_written_as_svg_which_the_error_says(place):
    (place / "icon.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg"/>')
    assert ".svg, .svgz, .png" in run("edit", "icon.svg", "Move it up", "-o", "x.txt").stderr
    assert ".svg" not in run("edit", "lamp", "Move it up", "-o", "x.txt").stderr
