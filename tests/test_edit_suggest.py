"""Names for segments from a vision LLM: what `iconjax segment` and `iconjax label` make of its reply."""

from __future__ import annotations

import base64
import io
import json
import os
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from edit_support import LABELS, small_picture, write_case
from llm_server import KEY, Scripted, message, serving, status
from PIL import Image
from segment_support import BALL, BOX, draw

from iconjax.cli import main
from iconjax.edit.suggest import VisionSuggester, offer_suggesters
from iconjax.scene.segment import choose
from iconjax.scene.types import Segmentation

TWO = {"1": "Red circle 1", "2": "Blue rectangle 2"}


@pytest.fixture(autouse=True)
def bare(tmp_path, monkeypatch):
    """An environment without credentials or settings, an empty table of suggesters, and an empty current folder."""
    for name in list(os.environ):
        if name.startswith(("ANTHROPIC_", "ICONJAX_")):
            monkeypatch.delenv(name)
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    monkeypatch.setattr(choose, "_SUGGESTERS", {})
    monkeypatch.chdir(tmp_path)
    draw(BALL, BOX).save("icon.png")


@pytest.fixture
def configured(monkeypatch):
    """Play a script to whoever has credentials; gives back the server."""

    def serve(*script):
        monkeypatch.setenv("ANTHROPIC_API_KEY", KEY)
        monkeypatch.setenv("ICONJAX_RETRIES", "0")
        running = serving(*script)
        server = running.__enter__()
        monkeypatch.setenv("ANTHROPIC_BASE_URL", server.url)
        opened.append(running)
        return server

    opened: list[Any] = []
    yield serve
    for running in opened:
        running.__exit__(None, None, None)


def told(**names: str) -> str:
    """A reply that names segments, `n1="Toy:Ball"`."""
    return json.dumps({"labels": [{"number": int(k[1:]), "name": name} for k, name in names.items()]})


def run(*args: str):
    result = CliRunner().invoke(main, args, prog_name="iconjax")
    assert KEY not in result.output
    return result


def read(path: str) -> dict[str, str]:
    with open(path, encoding="utf-8") as stream:
        return json.load(stream)


def test_segments_are_named_where_credentials_are_set(configured):
    server = configured(message(told(n1="Toy:Ball", n9="Nothing")))
    result = run("segment", "icon.png", "-o", "parts")
    assert result.exit_code == 0, result.stderr
    assert "1 of 2 segments named by anthropic" in result.stderr
    assert read("parts/labels.json") == {**TWO, "1": "Toy:Ball"}
    (asked,) = server.requests
    shown = [c for c in asked.body["messages"][0]["content"] if c["type"] == "image"]
    sheet = Image.open(io.BytesIO(base64.b64decode(shown[0]["source"]["data"])))
    assert min(sheet.size) > 800


def test_nobody_is_asked_without_credentials_or_when_told_not_to(configured, monkeypatch):
    server = configured(message(told(n1="Toy:Ball")))
    assert run("segment", "icon.png", "-o", "a", "--suggester", "none").exit_code == 0
    monkeypatch.delenv("ANTHROPIC_API_KEY")
    assert run("segment", "icon.png", "-o", "b").exit_code == 0
    assert read("a/labels.json") == read("b/labels.json") == TWO
    assert server.requests == []


def test_without_credentials_asking_for_it_says_what_to_set():
    result = run("segment", "icon.png", "-o", "parts", "--suggester", "anthropic")
    assert result.exit_code == 2
    assert "set ANTHROPIC_API_KEY or ANTHROPIC_AUTH_TOKEN" in result.stderr
    assert not os.path.exists("parts")


def test_a_server_that_fails_costs_only_the_names(configured):
    configured(status(500))
    result = run("segment", "icon.png", "-o", "parts")
    assert result.exit_code == 0, result.stderr
    assert "segments keep provisional names" in result.stderr
    assert read("parts/labels.json") == TWO


def test_names_are_recorded_and_come_back_without_the_server(configured, monkeypatch):
    monkeypatch.setenv("ICONJAX_RECORD", "record")
    server = configured(message(told(n1="Toy:Ball", n2="Toy:Brick")))
    assert run("segment", "icon.png", "-o", "a").exit_code == 0
    monkeypatch.delenv("ICONJAX_RECORD")
    monkeypatch.delenv("ANTHROPIC_API_KEY")
    monkeypatch.setenv("ICONJAX_REPLAY", "record")
    result = run("segment", "icon.png", "-o", "b", "--suggester", "llm-replay")
    assert result.exit_code == 0, result.stderr
    assert read("b/labels.json") == {"1": "Toy:Ball", "2": "Toy:Brick"}
    assert len(server.requests) == 1


def test_label_fills_in_what_has_no_name(configured, tmp_path):
    write_case(tmp_path / "lamp")
    server = configured(message(told(n1="Wrong", n2="Wrong", n3="Table")))
    assert run("label", "lamp").exit_code == 0
    assert read("lamp-labels.json") == {str(k): name for k, name in LABELS.items()}
    assert server.requests == []  # all have names
    (tmp_path / "some.json").write_text(json.dumps({"1": "Lamp:Shade", "2": "Lamp:Foot"}))
    args = ("lamp/image.png", "--seg", "lamp/segmentation.png", "--labels", "some.json", "-o", "sheet.png")
    result = run("label", *args)
    assert result.exit_code == 0, result.stderr
    assert read("image-labels.json") == {"1": "Lamp:Shade", "2": "Lamp:Foot", "3": "Table"}


def test_label_takes_provisional_names_of_a_folder_for_none(configured):
    assert run("segment", "icon.png", "-o", "parts").exit_code == 0
    with open("parts/labels.json", "w", encoding="utf-8") as stream:
        json.dump({**TWO, "2": "Brick"}, stream)
    configured(message(told(n1="Ball", n2="Wrong")))
    assert run("label", "parts").exit_code == 0
    assert read("parts-labels.json") == {"1": "Ball", "2": "Brick"}


def test_an_svg_keeps_the_names_in_it(configured, tmp_path):
    (tmp_path / "icon.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><rect id="table" x="10" y="70" width="80" '
        'height="20" fill="#803020"/><circle cx="50" cy="40" r="20" fill="#2060e0"/></svg>'
    )
    configured(message(told(n1="Wrong", n2="Ball")))
    result = run("label", "icon.svg")
    assert result.exit_code == 0, result.stderr
    assert read("icon-labels.json") == {"1": "Table", "2": "Ball"}


def test_ids_with_gaps_are_counted_through():
    image, mask = small_picture()
    ids = np.array([0, 4, 200, 9])
    names = {4: "A", 200: "B", 9: "C", 77: "nowhere"}
    client = Scripted([told(n1="Lamp:Shade", n3="Lamp:Foot")])
    found = VisionSuggester("scripted", client).suggest(image, Segmentation(ids[mask], names))
    assert found == {4: "Lamp:Shade", 200: "Lamp:Foot"}
    assert "3 numbered segments" in client.asked[0].turns[0].text


def test_ones_own_suggester_is_not_replaced():
    choose.register_suggester("anthropic", lambda: VisionSuggester("mine", Scripted([])))
    offer_suggesters()
    assert choose.choose_suggester().name == "mine"
