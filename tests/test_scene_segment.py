"""Segmenting without a model: what becomes one segment, what stays apart, and what is refused."""

from __future__ import annotations

import io
import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from segment_support import BALL, BOX, agreement, array, draw

from iconjax.errors import ConfigError, InputError
from iconjax.evaluation.segmentation import missing_length, score_segmentation
from iconjax.scene.load import load_segmentation
from iconjax.scene.segment import choose
from iconjax.scene.segment.choose import choose_segmenter
from iconjax.scene.segment.edits import merge_segments, read_merges
from iconjax.scene.segment.matte import open_picture
from iconjax.scene.segment.names import shape_word
from iconjax.scene.types import Segmentation

BENCHMARK = Path(__file__).parents[1] / "eval" / "benchmark"


def segment(picture, method: str = "auto") -> Segmentation:
    return choose_segmenter(method).segment(array(picture))


def disc(x: float, y: float, radius: float, size: int = 128) -> np.ndarray:
    rows, cols = np.mgrid[:size, :size] + 0.5
    return (cols - x) ** 2 + (rows - y) ** 2 < radius**2


def test_flat_shapes_are_segments_with_names_one_can_say():
    found = segment(draw(BALL, BOX))
    assert set(found.labels.values()) == {"Red circle 1", "Blue rectangle 2"}
    assert agreement(found.mask, disc(40, 40, 20)) > 0.97
    assert found.mask.shape == (128, 128)


def test_numbers_follow_reading_order_and_repeated_names_the_contract():
    dots = [("ellipse", (x, 50, x + 20, 70), "#e02020") for x in (10, 50, 90)]
    found = segment(draw(*dots))
    assert dict(found.labels) == {1: "Circle 1", 2: "Circle 2", 3: "Circle 3"}


def test_edge_pixels_go_to_one_of_the_two_sides():
    found = segment(draw(("rectangle", (20, 20, 64.5, 100), "#d02020"), ("rectangle", (64.5, 20, 100, 100), "#20a040")))
    assert len(found.labels) == 2
    assert set(np.unique(found.mask[30:90, 30:95])) == {1, 2}


def test_a_gradient_is_one_segment():
    ramp = np.full((128, 128, 3), 255, np.uint8)
    ramp[20:108, 20:108, 0] = np.linspace(30, 230, 88).astype(np.uint8)
    ramp[20:108, 20:108, 1] = 90
    ramp[20:108, 20:108, 2] = np.linspace(200, 60, 88).astype(np.uint8)[:, None]
    assert len(segment(Image.fromarray(ramp)).labels) == 1


def test_a_stroke_two_pixels_wide_is_kept():
    found = segment(draw(("rectangle", (10, 80, 118, 120), "#208040"), ("line2", (64, 10, 64, 80), "#e08020")))
    assert len(found.labels) == 2


def test_holes_are_background_unless_asked_for():
    ring = draw(("ellipse", (20, 20, 108, 108), "#e02020"), ("ellipse", (44, 44, 84, 84), "white"), BOX)
    assert segment(ring).mask[64, 50] == 0
    asked = choose.choose_segmenter("auto")
    assert type(asked)(holes=True).segment(array(ring)).mask[64, 50] > 0


def test_a_highlight_joins_its_host_and_an_eye_does_not():
    head = ("ellipse", (14, 14, 114, 114), "#e0a020")
    shine = ("ellipse", (35, 30, 55, 42), "#eeb440")
    eye = ("ellipse", (70, 40, 84, 54), "#202020")
    found = segment(draw(head, shine, eye))
    assert len(found.labels) == 2
    assert found.mask[36, 45] == found.mask[64, 30]


def test_many_equal_details_of_one_host_are_one_segment():
    board = ("rectangle", (10, 30, 118, 100), "#c0c0c0")
    keys = [("rectangle", (x, y, x + 8, y + 8), "#404040") for x in range(20, 110, 16) for y in (40, 60, 80)]
    assert len(segment(draw(board, *keys)).labels) == 2


def test_a_glyph_is_cut_at_a_neck_and_only_there():
    two = draw(("ellipse", (8, 40, 64, 96), "#222"), ("ellipse", (62, 40, 118, 96), "#222"))
    assert len(segment(two).labels) == 2
    assert agreement(segment(two).mask, disc(36, 68, 28)) > 0.9
    bar = draw(("rectangle", (8, 50, 118, 78), "#222"))
    assert len(segment(bar).labels) == 1
    # A long pole between two bodies is a part, not a neck.
    pole = ("rectangle", (60, 40, 68, 100), "#222")
    lamp = draw(("rectangle", (30, 10, 98, 40), "#222"), pole, ("rectangle", (34, 100, 94, 120), "#222"))
    assert len(segment(lamp).labels) == 1


def test_a_thin_gap_parts_a_glyph():
    found = segment(draw(("rectangle", (10, 20, 118, 62), "#222"), ("rectangle", (10, 64, 118, 110), "#222")))
    assert len(found.labels) == 2


def test_glyph_method_takes_all_colours_for_ink():
    touching = draw(("rectangle", (10, 20, 118, 62), "#a02020"), ("rectangle", (10, 60, 118, 110), "#2020a0"))
    assert len(segment(touching, "colour").labels) == 2
    assert len(segment(touching, "glyph").labels) == 1


@pytest.mark.parametrize("size", [32, 96, 600, 1200])
def test_small_and_large_pictures_give_the_same_segments(size):
    unit = size / 128
    shapes = [(kind, tuple(unit * v for v in at), colour) for kind, at, colour in (BALL, BOX)]
    found = segment(draw(*shapes, size=size))
    assert len(found.labels) == 2
    assert found.mask.shape == (size, size)
    assert agreement(found.mask, disc(40 * unit, 40 * unit, 20 * unit, size)) > (0.85 if size < 50 else 0.95)


def test_jpeg_damage_does_not_add_segments():
    stream = io.BytesIO()
    draw(BALL, BOX, size=256).save(stream, "JPEG", quality=75)
    assert len(segment(Image.open(stream)).labels) == 2


def test_what_is_no_icon_is_refused_in_one_line():
    random = np.random.default_rng(0)
    noise = random.integers(0, 256, (200, 200, 3)).astype(np.uint8)
    with pytest.raises(InputError, match="looks like a photograph or noise"):
        segment(Image.fromarray(noise))
    with pytest.raises(InputError, match="nothing to segment"):
        segment(Image.new("RGB", (64, 64), "#123456"))
    specks = draw(
        *(("rectangle", (x, y, x + 4, y + 4), "#222") for x in range(8, 246, 16) for y in range(8, 246, 16)), size=256
    )
    with pytest.raises(InputError, match="loose pieces"):
        segment(specks)
    with pytest.raises(InputError, match="too large to segment"):
        choose_segmenter().segment(np.zeros((4200, 4200, 3), np.uint8))


def test_most_similar_neighbours_are_united_beyond_the_most():
    stripes = [("rectangle", (10, 10 + 12 * k, 118, 22 + 12 * k), f"hsl({k * 40}, 80%, 50%)") for k in range(9)]
    kind = type(choose_segmenter("colour"))
    picture = array(draw(*stripes))
    assert len(kind().segment(picture).labels) == 9
    assert len(kind(most=4).segment(picture).labels) == 4


@pytest.mark.parametrize("steps", [1.5, 3.0, 4.0])
def test_a_steep_gradient_that_leaves_its_host_stays_whole(tmp_path, steps):
    picture = np.asarray(draw(("rectangle", (40, 40, 216, 150), "#f0f4fc"), back=None, size=256)).copy()
    drop = np.zeros((256, 256), bool)
    drop[120:190, 110:126] = True
    shade = np.arange(70)[:, None, None] * steps * np.array([-0.6, -0.8, -0.6])
    picture[120:190, 110:126] = 255
    picture[120:190, 110:126, :3] = np.clip(np.array([220, 240, 250]) + shade, 0, 255)
    Image.fromarray(picture).save(tmp_path / "rain.png")
    found = open_picture(tmp_path / "rain.png").segment(choose_segmenter())
    assert max(agreement(found.mask == k, drop) for k in found.labels) > 0.8


def test_white_on_transparent_is_told_from_the_background(tmp_path):
    card = draw(
        ("rectangle", (10, 20, 118, 110), "white"), ("rectangle", (30, 50, 98, 70), "#2060e0"), back=None
    )  # fmt: skip
    card.save(tmp_path / "card.png")
    found = open_picture(tmp_path / "card.png").segment(choose_segmenter())
    assert set(found.labels.values()) == {"Blue bar 1", "White rectangle 2"}
    assert found.mask.shape == (128, 128)
    draw((*BALL[:2], "white"), back=None).save(tmp_path / "white.png")
    opened = open_picture(tmp_path / "white.png")
    assert opened.shown[0, 0].max() < 128
    assert len(opened.segment(choose_segmenter()).labels) == 1


def test_shapes_are_called_what_they_are():
    def word(*shape):
        return shape_word(np.asarray(draw((*shape, "black")).convert("L")) < 128)

    assert word("ellipse", (20, 20, 90, 90)) == "circle"
    assert word("ellipse", (20, 30, 110, 80)) == "oval"
    assert word("rectangle", (20, 20, 90, 90)) == "square"
    assert word("rectangle", (20, 20, 110, 80)) == "rectangle"
    assert word("line8", (20, 20, 100, 90)) == "bar"
    assert word("polygon", (20, 100, 64, 20, 108, 100)) == "triangle"
    assert word("polygon", (20, 20, 50, 20, 50, 80, 110, 80, 110, 110, 20, 110)) == "piece"


def test_registered_segmenters_are_chosen_by_name():
    class Halves:
        name = "halves"

        def segment(self, image):
            mask = np.ones(image.shape[:2], np.int32)
            mask[:, image.shape[1] // 2 :] = 2
            return Segmentation(mask, {1: "Left", 2: "Right"})

    before = dict(choose._SEGMENTERS)
    try:
        choose.register_segmenter("halves", Halves)
        assert "halves" in choose.segmenter_names()
        assert dict(choose_segmenter("halves").segment(np.zeros((4, 4, 3), np.uint8)).labels) == {1: "Left", 2: "Right"}
    finally:
        choose._SEGMENTERS.clear()
        choose._SEGMENTERS.update(before)
    with pytest.raises(ConfigError, match="did you mean 'colour'"):
        choose_segmenter("color")
    with pytest.raises(ConfigError, match="no method segment"):
        choose_segmenter(object())


def test_segments_can_be_merged_by_number():
    found = segment(draw(BALL, BOX, ("ellipse", (80, 10, 110, 40), "#20a040")))
    merged = merge_segments(found, [read_merges("1,3")])
    assert sorted(merged.labels) == [1, 2]
    assert (merged.mask == 1).sum() == (found.mask == 1).sum() + (found.mask == 3).sum()
    for wrong, why in (("1", "write the numbers"), ("1,9", "the segments are 1 to 3"), ("1,1", "twice")):
        with pytest.raises(InputError, match=why):
            merge_segments(found, [read_merges(wrong)])


def test_measures_of_work_left():
    true = np.zeros((512, 512), np.int32)
    true[100:400, 100:250], true[100:400, 250:400] = 1, 2
    perfect = score_segmentation(true, true)
    assert (perfect.missing, perfect.mislabelled, perfect.matched, perfect.split) == (0, 0, 2, 0)
    whole = (true > 0).astype(np.int32)
    score = score_segmentation(whole, true)
    # The seam is 300 long; its ends are within 20 px of the outer boundary.
    assert score.missing == pytest.approx(300 - 2 * 20, abs=4)
    assert (score.mislabelled, score.matched, score.unnamed) == (1, 0, 2)
    assert missing_length(np.zeros_like(true), true) == pytest.approx(4 * 300 + 300, abs=4)
    quarters = np.where(true == 1, 1 + (np.arange(512)[:, None] >= 250), true * 2)
    quarters[true == 2] = 3
    assert score_segmentation(quarters, true).split == 1


@pytest.mark.parametrize("case", ["bed-narrower", "anvil-hammer", "telescope-level", "camera-equal-reels"])
def test_real_icons_fall_into_their_true_segments(case):
    true = np.asarray(load_segmentation(BENCHMARK / case).mask)
    found = segment(Image.open(BENCHMARK / case / "image.png"))
    score = score_segmentation(np.asarray(found.mask), true)
    names = json.loads((BENCHMARK / case / "case.json").read_text("utf-8"))["labels"]
    assert score.matched == score.found == len(names)
    assert score.missing < 20
