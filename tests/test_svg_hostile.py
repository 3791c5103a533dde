"""Hostile and broken SVGs: one clear error or a right result, and nothing outside the file is ever asked for."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest
from svg_hostile import CANARY, DOT, HOSTILE, svg

from iconjax.errors import InputError
from iconjax.render.svg import write_svg
from iconjax.scene.svg import open_svg, rasteriser
from iconjax.scene.svg.rasteriser import RasteriserError, rasterise

ASKED: list[str] = []
WATCHED = ("socket.", "urllib.", "subprocess.", "os.system", "os.exec", "os.posix_spawn")


def _watch(event: str, arguments: tuple[object, ...]) -> None:
    if event.startswith(WATCHED) or (event == "open" and CANARY in str(arguments[0])):
        ASKED.append(f"{event} {arguments[:2]}")


sys.addaudithook(_watch)


@pytest.fixture
def rasterised(monkeypatch) -> list[bytes]:
    """Every text that the rasteriser was given."""
    texts: list[bytes] = []

    def record(text: bytes) -> bytes:
        texts.append(text)
        return rasterise(text)

    monkeypatch.setattr("iconjax.scene.svg.draw.rasterise", record)
    return texts


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_files(name, rasterised):
    data, error = HOSTILE[name]
    open_svg(svg(DOT), size=32)  # starts the rasteriser, where an earlier file has brought it down
    ASKED.clear()
    rasterised.clear()
    if error is None:
        vector = open_svg(data, size=128)
        assert write_svg(vector, [[[1, 0, 0], [0, 1, 0]]] * len(vector.members)) == data
    else:
        with pytest.raises(InputError, match=error) as caught:
            open_svg(data, size=128)
        assert len(str(caught.value).splitlines()) == 1
        assert len(str(caught.value)) < 300
    assert ASKED == []
    # The rasteriser is not Python and cannot be watched, so what it is given must not name anything outside.
    for text in rasterised:
        assert not any(word in text for word in (CANARY.encode(), b"<image", b"<script", b"feImage"))


def test_a_picture_beside_the_file_is_not_drawn(tmp_path, monkeypatch):
    from PIL import Image

    monkeypatch.chdir(tmp_path)
    Image.new("RGB", (8, 8), "lime").save("near.png")
    places = ("near.png", os.path.abspath("near.png"), Path("near.png").resolve().as_uri())
    for place in places:
        for kind in ("href", "xlink:href"):
            vector = open_svg(svg(f'<image {kind}="{place}" width="24" height="24"/>{DOT}'), size=64)
            assert not (vector.scene.image == (0, 255, 0)).all(axis=-1).any()
            assert "embedded images" in vector.notes[0]


def test_the_watch_sees_what_it_should(tmp_path):
    ASKED.clear()
    (tmp_path / f"{CANARY}.txt").write_text("x", "utf-8")
    assert ASKED


def test_a_rasteriser_that_breaks_down_is_replaced(monkeypatch):
    text = b'<svg xmlns="http://www.w3.org/2000/svg" width="8" height="8"><path d="M0 0h4v4z"/></svg>'
    assert rasterise(text).startswith(b"\x89PNG")
    rasteriser._SHARED._process.kill()
    rasteriser._SHARED._process.wait()
    assert rasterise(text).startswith(b"\x89PNG")
    monkeypatch.setattr(rasteriser, "MAX_SECONDS", 0.2)
    endless = text.replace(b"M0 0h4v4z", b"M6 6A9 1e38 0 0 0 9 9z")
    with pytest.raises(RasteriserError, match="broke down or took too long"):
        rasterise(endless)
    monkeypatch.undo()
    assert rasterise(text).startswith(b"\x89PNG")
    with pytest.raises(RasteriserError, match="invalid size"):
        rasterise(text.replace(b'width="8"', b'width="0"'))
