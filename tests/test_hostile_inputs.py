"""Bad files, arrays and labels: each ends in one line that says what is wrong and what to do."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from iconjax.errors import InputError
from iconjax.scene.build import build_scene
from iconjax.scene.labels import check_labels, read_labels
from iconjax.scene.load import load_case, load_image, load_segmentation
from iconjax.scene.types import Segmentation

MASK = np.array([[0, 1], [2, 2]])
LABELS = {1: "Lamp:Shade", 2: "Lamp:Foot"}
Maker = Callable[[Path], Any]


def _write(path: Path, data: bytes | str) -> Path:
    path.write_bytes(data if isinstance(data, bytes) else data.encode())
    return path


def _png(folder: Path, keep: float = 1.0, width: int | None = None) -> Path:
    path = folder / "a.png"
    Image.fromarray(np.random.default_rng(0).integers(0, 256, (64, 64, 3), dtype=np.uint8)).save(path)
    data = path.read_bytes()
    if width is not None:  # claim another size in the header
        head = struct.pack(">II", width, width) + data[24:29]
        data = data[:16] + head + struct.pack(">I", zlib.crc32(b"IHDR" + head)) + data[33:]
    return _write(path, data[: int(len(data) * keep)])


def _image(source: Any) -> None:
    load_image(source)


def _labels(labels: Any) -> None:
    load_segmentation(MASK, labels)


def _mask(array: Any) -> None:
    load_segmentation(array, LABELS)


FILES: list[tuple[str, Maker, str]] = [
    ("missing file", lambda d: _image(d / "no.png"), "does not exist"),
    ("folder as image", lambda d: _image(d), "is a folder"),
    ("empty file", lambda d: _image(_write(d / "a.png", b"")), "is empty"),
    ("text as image", lambda d: _image(_write(d / "a.png", "hello")), "is not an image"),
    ("vector as image", lambda d: _image(_write(d / "a.svg", "<svg/>")), "is not an image"),
    ("truncated image", lambda d: _image(_png(d, keep=0.5)), "is damaged"),
    ("bomb by header", lambda d: _image(_png(d, width=9000)), "too many pixels"),
    ("bigger bomb by header", lambda d: _image(_png(d, width=60000)), "too many pixels"),
    ("name too long", lambda d: _image("x" * 5000 + ".png"), "cannot be opened"),
    ("line break in name", lambda d: _image("no\nsuch.png"), "no\\nsuch.png does not exist"),
    ("null byte in name", lambda d: _image("a\0b.png"), "a\\x00b.png"),
    ("missing mask", lambda d: _mask(d / "no.png"), "segmentation file"),
    ("colour mask", lambda d: _mask(_png(d)), "colour picture"),
    ("mask without labels", lambda d: load_segmentation(_png(d)), "colour picture"),
    ("truncated mask", lambda d: _mask(_png(d, keep=0.6)), "is damaged"),
    ("missing labels", lambda d: _labels(d / "no.json"), "does not exist"),
    ("label folder", lambda d: _labels(d), "is a folder"),
    ("broken JSON", lambda d: _labels(_write(d / "l.json", '{"1": ')), "not valid JSON"),
    ("repeated JSON key", lambda d: _labels(_write(d / "l.json", '{"1": "A", "1": "B"}')), "occurs twice"),
    ("JSON list", lambda d: _labels(_write(d / "l.json", "[1]")), "must be an object"),
    ("deep JSON", lambda d: _labels(_write(d / "l.json", "[" * 200_000)), "nested too deeply"),
    ("binary labels", lambda d: _labels(_write(d / "l.json", b"\xff\xfe\x00")), "not UTF-8"),
    ("huge labels", lambda d: _labels(_write(d / "l.json", b" " * 5_000_000)), "too large"),
    ("one CSV column", lambda d: _labels(_write(d / "l.csv", "1\n2\n")), "two columns"),
    ("repeated CSV id", lambda d: _labels(_write(d / "l.csv", "1,A\n1,B\n")), "two labels"),
    ("no case", lambda d: load_case(d / "no"), "does not exist"),
    ("file as case", lambda d: load_case(_png(d)), "is not a folder"),
    ("nothing as case", lambda d: load_case(None), "given by its path"),  # type: ignore[arg-type]
]

ARRAYS: list[tuple[str, Callable[[], Any], str]] = [
    ("no image", lambda: _image(None), "cannot use NoneType"),
    ("bytes", lambda: _image(b"abc"), "cannot use bytes"),
    ("number", lambda: _image(3), "cannot use int"),
    ("ragged list", lambda: _image([[1], [1, 2]]), "cannot use list"),
    ("objects", lambda: _image(np.array([["a"]])), "values of type"),
    ("complex", lambda: _image(np.ones((2, 2), complex)), "values of type"),
    ("one row", lambda: _image(np.zeros(5, np.uint8)), "shape (5,)"),
    ("four axes", lambda: _image(np.zeros((1, 2, 2, 3), np.uint8)), "shape (1, 2, 2, 3)"),
    ("channels first", lambda: _image(np.zeros((3, 8, 8), np.uint8)), "channel axis last"),
    ("two channels", lambda: _image(np.zeros((8, 8, 2), np.uint8)), "(height, width)"),
    ("no pixels", lambda: _image(np.zeros((0, 5, 3), np.uint8)), "no pixels"),
    ("too many pixels", lambda: _image(np.broadcast_to(np.uint8(0), (9000, 9000))), "too many pixels"),
    ("NaN", lambda: _image(np.full((2, 2), np.nan)), "NaN"),
    ("infinite", lambda: _image(np.full((2, 2), np.inf)), "NaN or infinite"),
    ("floats to 255", lambda: _image(np.full((2, 2), 200.0)), "floats from 200"),
    ("negative", lambda: _image(np.full((2, 2), -1)), "values from -1"),
    ("large ints", lambda: _image(np.full((2, 2), 70000)), "values from 70000"),
    ("float mask", lambda: _mask(MASK.astype(float)), "ids are integers"),
    ("negative mask", lambda: _mask(MASK - 1), "negative ids"),
    ("huge ids", lambda: _mask(MASK * 10**6), "ids up to"),
    ("mask of rank 3", lambda: _mask(np.zeros((2, 2, 9), int)), "one segment id per pixel"),
    ("empty mask", lambda: _mask(np.zeros((0, 0), int)), "no pixels"),
    ("only background", lambda: _mask(MASK * 0), "no segments"),
    ("unnamed segments", lambda: _mask(MASK * 5), "without a label: 5, 10"),
    ("half transparent mask", lambda: _mask(np.dstack([MASK, [[9, 9], [9, 8]]])), "partly transparent"),
    ("noise", lambda: _mask(np.arange(900).reshape(30, 30)), "899 segments"),
    ("no mask", lambda: _mask(None), "cannot use NoneType as segmentation"),
    ("sizes differ", lambda: build_scene(np.zeros((4, 3, 3), np.uint8), MASK, LABELS), "3x4 pixels"),
    ("bad Segmentation", lambda: build_scene(MASK, Segmentation(MASK, {1: "A"})), "without a label: 2"),
    ("no labels", lambda: load_segmentation(MASK), "has no labels"),
    ("labels as list", lambda: _labels(["A", "B"]), "must be a mapping"),
    ("no entries", lambda: _labels({}), "no labels"),
    ("label without pixels", lambda: _labels({**LABELS, 9: "Cat:Tail"}), "9 ('Cat:Tail')"),
    ("blank label", lambda: _labels({**LABELS, 1: "  "}), "is blank"),
    ("label of another type", lambda: _labels({**LABELS, 1: 5}), "is int, not text"),
    ("three levels", lambda: _labels({**LABELS, 1: "A:B:C"}), "2 colons"),
    ("no object", lambda: _labels({**LABELS, 1: ":B"}), "beside its colon"),
    ("no part", lambda: _labels({**LABELS, 1: "A: "}), "beside its colon"),
    ("control characters", lambda: _labels({**LABELS, 1: "A\x1b[2J"}), "control characters"),
    ("line break in label", lambda: _labels({**LABELS, 1: "A\nB"}), "control characters"),
    ("lone surrogate", lambda: _labels({**LABELS, 1: "A\ud800"}), "control characters"),
    ("word as id", lambda: check_labels({"one": "A"}), "no segment id"),
    ("fraction as id", lambda: check_labels({1.5: "A"}), "no segment id"),
    ("background as id", lambda: check_labels({0: "A"}), "0 is background"),
    ("id twice", lambda: check_labels({1: "A", "1": "B"}), "two labels"),
    ("long number as id", lambda: check_labels({"9" * 5000: "A"}), "no segment id"),
    ("null byte in label path", lambda: read_labels("a\0.csv"), "not a file name"),
]  # fmt: skip


def assert_one_line(error: InputError, fragment: str) -> None:
    message = str(error)
    assert type(error) is InputError
    assert fragment in message
    assert message.isprintable()
    assert 10 < len(message) < 6000


@pytest.mark.parametrize(("name", "act", "fragment"), FILES, ids=[row[0] for row in FILES])
def test_files(name: str, act: Maker, fragment: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        act(tmp_path)
    assert_one_line(caught.value, fragment)


@pytest.mark.parametrize(("name", "act", "fragment"), ARRAYS, ids=[row[0] for row in ARRAYS])
def test_arrays_and_labels(name: str, act: Callable[[], Any], fragment: str) -> None:
    with pytest.raises(InputError) as caught:
        act()
    assert_one_line(caught.value, fragment)


def test_unreadable_pil_image(tmp_path: Path) -> None:
    with Image.open(_png(tmp_path, keep=0.5)) as image:
        for load in (load_image, _mask):
            with pytest.raises(InputError) as caught:
                load(image)
            assert_one_line(caught.value, "save it")
