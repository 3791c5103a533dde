"""Bad uses of the command and of `edit`: each is one clear line, exit status 2, and leaves no file behind."""

from __future__ import annotations

import json
import os
import shlex

import numpy as np
import pytest
from click.testing import CliRunner
from edit_support import LABELS, PROGRAM, small_picture, use_fake_search, write_case
from PIL import Image

from iconjax import IconjaxError, Segmentation, edit
from iconjax.cli import main

IMAGE = "edit lamp/image.png --seg lamp/segmentation.png --labels labels.json"

BAD_COMMANDS = {
    "missing file": ("edit nothing.png --program p.txt", "nothing.png"),
    "folder without case.json": ("edit empty", "case.json"),
    "case whose request is empty": ("edit silent", "request"),
    "broken case.json": ("edit broken", "not valid JSON"),
    "image without segmentation": ("edit lamp/image.png 'turn the lamp'", "--seg"),
    "segmentation for a case folder": (
        "edit lamp --seg lamp/segmentation.png --program p.txt",
        "leave out --seg",
    ),
    "label file that is missing": (
        IMAGE.replace("labels.json", "none.json") + " --program p.txt",
        "none.json",
    ),
    "label file that is no table": (
        IMAGE.replace("labels.json", "list.json") + " --program p.txt",
        "list.json",
    ),
    "label file that is a picture": (
        IMAGE.replace("labels.json", "lamp/image.png") + " --program p.txt",
        "UTF-8",
    ),
    "label file that names too few": (
        IMAGE.replace("labels.json", "few.json") + " --program p.txt",
        "without a label",
    ),
    "picture that is no picture": ("edit p.txt --seg p.txt --labels labels.json --program p.txt", "p.txt"),
    "segmentation of another size": (IMAGE.replace("lamp/seg", "wide/seg") + " --program p.txt", "same size"),
    "empty request": ("edit lamp '  '", "request is empty"),
    "no request and no program": (IMAGE, "request is empty"),
    "request of nonsense": ("edit lamp 'colourless green ideas' --translator offline", ""),
    "unknown translator": ("edit lamp 'turn it' --translator ofline", "did you mean 'offline'"),
    "anthropic without credentials": ("edit lamp 'turn it' --translator anthropic", "anthropic"),
    "unknown strategy": ("edit lamp --program p.txt --strategy fast", "'coherent' or 'paper'"),
    "program and translator": ("edit lamp --program p.txt --translator offline", "leave out --translator"),
    "missing program": ("edit lamp --program none.txt", "none.txt"),
    "program that is a folder": ("edit lamp --program empty", "cannot read program"),
    "binary program": ("edit lamp --program garbage.bin", "not a text file"),
    "empty program": ("edit lamp --program comments.txt", "program is empty"),
    "program with an unknown segment": ("edit lamp --program names.txt", 'did you mean "Lamp:Shade"'),
    "program with an unknown operator": ("edit lamp --program verbs.txt", 'did you mean "translate"'),
    "program of Python": ("edit lamp --program python.txt", "line 1"),
    "output in a missing folder": ("edit lamp --program p.txt -o none/out.png", "cannot write none/out.png"),
    "output below a file": ("edit lamp --program p.txt -o p.txt/out.png", "cannot write p.txt/out.png"),
    "output that is a folder": ("edit lamp --program p.txt -o folder.png", "it is a folder"),
    "output over the input": ("edit lamp --program p.txt -o lamp/image.png", "is an input"),
    "output over the input by a link": ("edit lamp --program p.txt -o link.png", "is an input"),
    "JSON over the program": ("edit lamp --program p.txt --json p.txt", "is an input"),
    "output of an unknown kind": ("edit lamp --program p.txt -o out.svg", ".png"),
    "two outputs in one file": ("edit lamp --program p.txt -o a.png --json ./a.png", "named twice"),
    "trace in a missing folder": (
        "edit lamp --program p.txt --trace none/t.html",
        "cannot write none/t.html",
    ),
    "interpretations 0": ("edit lamp --program p.txt --interpretations 0", "at least 1"),
    "interpretations 2": ("edit lamp --program p.txt --interpretations 2", "one interpretation"),
    "interpretations many": ("edit lamp --program p.txt --interpretations many", "not a valid integer"),
    "unknown option": ("edit lamp --fast", "--fast"),
    "no picture": ("edit", "CASE_OR_IMAGE"),
    "unknown command": ("paint lamp", "paint"),
    "translate nothing": ("translate lamp ''", "request is empty"),
    "relations of nothing": ("relations nothing", "nothing"),
    "unknown operator": ("dsl xyzzy", "xyzzy"),
    "eval of nothing": ("eval nothing --out report", "nothing"),
    "eval without cases": ("eval empty --out report", "empty"),
}


@pytest.fixture
def place(tmp_path, monkeypatch):
    """A folder with one good case, and many bad files."""
    write_case(tmp_path / "lamp")
    write_case(tmp_path / "silent", request="")
    (write_case(tmp_path / "broken") / "case.json").write_text("{")
    wide = np.pad(small_picture()[1], ((0, 0), (0, 1)))
    Image.fromarray(wide).save(write_case(tmp_path / "wide") / "segmentation.png")
    (tmp_path / "empty").mkdir()
    (tmp_path / "folder.png").mkdir()
    (tmp_path / "link.png").symlink_to("lamp/image.png")
    texts = {
        "labels.json": json.dumps({str(k): v for k, v in LABELS.items()}),
        "list.json": "[1, 2]",
        "few.json": '{"1": "Lamp:Shade"}',
        "p.txt": PROGRAM,
        "comments.txt": "# nothing\n\n",
        "names.txt": 'translate("Lamp:Shad")',
        "verbs.txt": 'transalte("Lamp:Shade")',
        "python.txt": "__import__('os').system('true')",
    }
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    (tmp_path / "garbage.bin").write_bytes(bytes(range(256)) * 8)
    monkeypatch.chdir(tmp_path)
    for name in ("ANTHROPIC_API_KEY", "ANTHROPIC_AUTH_TOKEN"):
        monkeypatch.delenv(name, raising=False)
    use_fake_search(monkeypatch)
    return tmp_path


def everything(folder) -> dict[str, bytes]:
    files = [os.path.join(top, name) for top, _, names in os.walk(folder) for name in names]
    folders = [os.path.join(top, name) for top, names, _ in os.walk(folder) for name in names]
    return {f: open(f, "rb").read() for f in files} | dict.fromkeys(folders, b"")


@pytest.mark.parametrize("name", BAD_COMMANDS)
def test_bad_command(place, name):
    command, expected = BAD_COMMANDS[name]
    before = everything(place)
    result = CliRunner().invoke(main, shlex.split(command))
    assert result.exit_code == 2, (result.exit_code, result.stderr, result.exception)
    assert result.stdout == ""
    assert result.stderr.startswith("iconjax: error: ")
    assert result.stderr.count("\n") == 1
    assert expected in result.stderr
    assert everything(place) == before


def bad_calls():
    image, mask = small_picture()
    good = {"labels": LABELS, "program": PROGRAM}
    return {
        "nothing": ((None,), good),
        "no segmentation": ((image,), {"program": PROGRAM}),
        "no labels": ((image, mask), {"program": PROGRAM}),
        "labels that are a number": ((image, mask), good | {"labels": 3}),
        "labels with a bad key": ((image, mask), good | {"labels": {"one": "Lamp"}}),
        "labels for too few": ((image, mask), good | {"labels": {1: "Lamp"}}),
        "segmentation without labels": ((image, Segmentation(mask, {})), {"program": PROGRAM}),
        "one-dimensional picture": ((image[0, 0], mask), good),
        "empty picture": ((image[:0], mask[:0]), good),
        "picture of text": ((np.array([["a", "b"]]), mask), good),
        "segmentation of halves": ((image, mask + 0.5), good),
        "negative segmentation": ((image, mask.astype(int) - 1), good),
        "sizes that differ": ((image[:50], mask), good),
        "request that is a number": ((image, mask, 3), {"labels": LABELS}),
        "no request": ((image, mask), {"labels": LABELS}),
        "program that is a number": ((image, mask), good | {"program": 3}),
        "program of numbers": ((image, mask), good | {"program": [1, 2]}),
        "program of nothing": ((image, mask), good | {"program": []}),
        "config that is a table": ((image, mask), good | {"config": {"strategy": "paper"}}),
        "translator that cannot": ((image, mask, "turn it"), {"labels": LABELS, "translator": object()}),
    }


@pytest.mark.parametrize("name", bad_calls())
def test_bad_call(place, name):
    args, extra = bad_calls()[name]
    with pytest.raises(IconjaxError) as caught:
        edit(*args, **extra)
    assert str(caught.value)
    assert "\n" not in str(caught.value)


class Babbler:
    """A translator that writes what does not parse."""

    name = "babbler"

    def translate(self, request, scene):
        from iconjax.language.base import Translation

        return Translation(('move("Lamp")', "jump()"), "babbler")


def test_a_translator_that_writes_nonsense_is_named(place):
    with pytest.raises(
        IconjaxError, match=r"translator 'babbler' wrote constraints that are not valid.*entry 1|line 1"
    ):
        edit("lamp", translator=Babbler())


def test_results_cannot_be_saved_to_impossible_places(place):
    result = edit("lamp", program=PROGRAM)
    before = everything(place)
    for save in (result.save, result.to_json, result.to_html):
        for path in ("none/out.png", "p.txt/out.png", "folder.png"):
            with pytest.raises(IconjaxError, match="cannot write"):
                save(path)
    with pytest.raises(IconjaxError, match=r"\.png"):
        result.save("out")
    assert everything(place) == before
