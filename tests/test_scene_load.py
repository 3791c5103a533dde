"""Reading pictures, label maps and case folders."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from iconjax.errors import InputError
from iconjax.scene.labels import check_labels, number_names, read_labels
from iconjax.scene.load import load_case, load_image, load_segmentation
from iconjax.scene.types import Segmentation

BENCHMARK = Path(__file__).parents[1] / "eval" / "benchmark"
RGB = np.random.default_rng(0).integers(0, 256, (5, 7, 3), dtype=np.uint8)
MASK = np.array([[0, 1, 1], [2, 2, 0]])
LABELS = {1: "Lamp:Shade", 2: "Lamp:Foot"}


def test_rgb_is_kept_bit_for_bit_and_copied(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    Image.fromarray(RGB).save(path)
    for source in (RGB, Image.fromarray(RGB), path, str(path)):
        image = load_image(source)
        assert image.dtype == np.uint8
        np.testing.assert_array_equal(image, RGB)
    assert not np.shares_memory(load_image(RGB), RGB)


@pytest.mark.parametrize(
    ("array", "expected"),
    [
        (np.array([[0, 128]], np.uint8), [0, 128]),
        (np.array([[[9], [8]]], np.uint8), [9, 8]),
        (np.array([[0, 257 * 77]], np.uint16), [0, 77]),
        (np.array([[0.0, 1.0]]), [0, 255]),
        (np.array([[False, True]]), [0, 255]),
        (np.array([[3, 200]], np.int64), [3, 200]),
    ],
)
def test_grey_arrays_of_any_depth(array: np.ndarray, expected: list[int]) -> None:
    np.testing.assert_array_equal(load_image(array), np.repeat(np.array([expected])[..., None], 3, 2))


def test_transparency_lies_on_white(tmp_path: Path) -> None:
    rgba = np.dstack([RGB, np.full((5, 7), 255, np.uint8)])
    rgba[0, 0] = (10, 20, 30, 0)
    rgba[0, 1] = (0, 0, 0, 51)
    image = load_image(rgba)
    assert image[0, 0].tolist() == [255] * 3
    assert image[0, 1].tolist() == [204] * 3
    np.testing.assert_array_equal(image[1:], RGB[1:])
    np.testing.assert_array_equal(load_image(Image.fromarray(rgba)), image)


@pytest.mark.parametrize("mode", ["1", "L", "LA", "P", "CMYK", "YCbCr", "I", "I;16", "LAB"])
def test_every_common_file_mode_becomes_rgb(mode: str) -> None:
    grey = Image.new("L", (4, 3), 255)
    source = Image.fromarray(np.full((3, 4), 65535, np.uint16)) if mode.startswith("I") else None
    if source is None:
        source = Image.new("LAB", (4, 3), (255, 128, 128)) if mode == "LAB" else grey.convert("RGB").convert(mode)
    image = load_image(source.convert("I") if mode == "I" else source)
    assert image.shape == (3, 4, 3)
    assert image.min() >= 254


def test_palette_mask_and_16_bit_mask(tmp_path: Path) -> None:
    palette = Image.fromarray(MASK.astype(np.uint8), "L")
    palette.putpalette([0, 0, 0, 255, 0, 0, 0, 0, 255])
    palette.save(tmp_path / "p.png")
    Image.fromarray((MASK * 300).astype(np.uint16)).save(tmp_path / "w.png")
    np.testing.assert_array_equal(load_segmentation(tmp_path / "p.png", LABELS).mask, MASK)
    wide = load_segmentation(tmp_path / "w.png", {"300": "A", "600": "B:c"})
    np.testing.assert_array_equal(wide.mask, MASK * 300)
    assert dict(wide.labels) == {300: "A", 600: "B:c"}


def test_mask_saved_as_equal_rgb_or_rgba_channels() -> None:
    rgb = np.repeat(MASK[..., None], 3, 2).astype(np.uint8)
    rgba = np.dstack([rgb, np.full(MASK.shape, 255, np.uint8)])
    for source in (rgb, rgba, Image.fromarray(rgb), Image.fromarray(rgba)):
        np.testing.assert_array_equal(load_segmentation(source, LABELS).mask, MASK)


def test_labels_from_files_and_beside_the_mask(tmp_path: Path) -> None:
    (tmp_path / "bare.json").write_text(json.dumps({"1": "A : b", "2": " C "}))
    (tmp_path / "case.json").write_text("\ufeff" + json.dumps({"labels": {"1": "A:b", "2": "C"}}), "utf-8")
    (tmp_path / "a.csv").write_text('id,label\n1,"A:b"\n\n2,C\n')
    (tmp_path / "b.csv").write_text("1;A:b\n2;C\n")
    expected = {1: "A:b", 2: "C"}
    for name in ("bare.json", "case.json", "a.csv", "b.csv"):
        assert read_labels(tmp_path / name) == expected
    Image.fromarray(MASK.astype(np.uint8)).save(tmp_path / "segmentation.png")
    assert dict(load_segmentation(tmp_path / "segmentation.png").labels) == expected
    assert dict(load_segmentation(tmp_path).labels) == expected


def test_labels_override_those_of_a_segmentation() -> None:
    seg = load_segmentation(Segmentation(MASK, LABELS), {2: "X", 1: "Y"})
    assert list(seg.labels.items()) == [(1, "Y"), (2, "X")]


def test_check_labels_takes_numpy_ids() -> None:
    assert check_labels({np.int32(3): "A", "2": "B"}) == {2: "B", 3: "A"}


def test_repeated_labels_are_numbered_left_to_right_then_top_to_bottom() -> None:
    labels = {1: "T:Leg", 2: "T:Leg", 3: "T:Top", 4: "T:Leg", 5: "T:Leg"}
    centres = {1: (90.0, 50.0), 2: (10.0, 80.0), 3: (50.0, 10.0), 4: (10.5, 20.0), 5: (50.0, 50.0)}
    assert number_names(labels, centres, 100) == {
        1: "T:Leg #4", 2: "T:Leg #2", 3: "T:Top", 4: "T:Leg #1", 5: "T:Leg #3",
    }  # fmt: skip


def test_numbers_do_not_collide_with_given_names() -> None:
    labels = {1: "X", 2: "X", 3: "X #1", 4: "X #1", 5: "X #3"}
    names = number_names(labels, {i: (10.0 * i, 0.0) for i in labels}, 100)
    assert len(set(names.values())) == 5
    assert [names[1], names[2], names[5]] == ["X #2", "X #4", "X #3"]


def test_case_folder() -> None:
    case = load_case(BENCHMARK / "umbrella-45")
    assert case.id == "umbrella-45"
    assert case.image.shape == (512, 512, 3)
    assert case.segmentation.mask.shape == (512, 512)
    assert case.program is not None and "(" in case.program
    assert case.request and len(case.segmentation.labels) == 10


def test_case_folder_errors_name_the_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        load_case(tmp_path / "nothing")
    with pytest.raises(InputError, match=r"no case\.json"):
        load_case(tmp_path)
    Image.fromarray(RGB).save(tmp_path / "image.png")
    Image.fromarray(MASK.astype(np.uint8)).save(tmp_path / "segmentation.png")
    for text, fragment in [
        ("{", "not valid JSON"),
        ("[]", "must be an object"),
        ('{"labels": {}}', '"request"'),
        ('{"request": "x"}', '"labels"'),
        ('{"request": "x", "labels": {"1": "A", "2": "B"}, "id": 3}', '"id"'),
        ('{"request": "x", "labels": {"1": "A", "2": "B"}}', "7x5 pixels but the segmentation is 3x2"),
    ]:
        (tmp_path / "case.json").write_text(text)
        with pytest.raises(InputError, match=fragment):
            load_case(tmp_path)
