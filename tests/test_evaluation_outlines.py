"""Outlines, transforms and names that the evaluation judges by."""

from __future__ import annotations

import numpy as np
import pytest
from evaluation_support import scale, shift, turn
from shapely.geometry import MultiPolygon, box

from iconjax.errors import InputError
from iconjax.evaluation.affine import motion_of, read_transforms, turn_error
from iconjax.evaluation.outlines import outer_outline, outlines_of, principal_axis, sample
from iconjax.evaluation.stage import Stage


def square_mask() -> np.ndarray:
    mask = np.zeros((40, 50), bool)
    mask[5:15, 10:30] = True
    return mask


def test_the_box_lies_on_pixel_edges() -> None:
    assert outer_outline(square_mask()).bounds == (10, 5, 30, 15)


def test_a_segment_may_fill_the_picture() -> None:
    assert outer_outline(np.ones((4, 6), bool)).bounds == (0, 0, 6, 4)


def test_holes_are_filled_and_what_lies_in_them_is_swallowed() -> None:
    solid = square_mask()
    ring = solid.copy()
    ring[7:13, 14:26] = False
    ring[9:11, 18:20] = True
    assert outer_outline(ring).equals(outer_outline(solid))


def test_components_stay_apart_and_diagonal_neighbours_hold_together() -> None:
    mask = square_mask()
    mask[30:35, 3:9] = True
    assert len(outer_outline(mask).geoms) == 2
    corners = np.zeros((6, 6), bool)
    corners[1:3, 1:3] = corners[3:5, 3:5] = True
    assert len(outer_outline(corners).geoms) == 1
    assert outer_outline(corners).is_valid


def test_a_single_pixel_has_an_outline() -> None:
    mask = np.zeros((5, 5), bool)
    mask[2, 3] = True
    assert outer_outline(mask).bounds == (3, 2, 4, 3)


def test_a_label_without_pixels_is_an_error() -> None:
    with pytest.raises(InputError, match=r"segment 2 \('Ghost'\) has no pixels"):
        outlines_of(square_mask().astype(int), {1: "Thing", 2: "Ghost"})


def test_samples_are_spread_by_length_over_all_loops() -> None:
    outline = MultiPolygon([box(0, 0, 30, 10), box(100, 0, 110, 10)])
    points = sample(outline, 120)
    assert (points[:, 0] > 50).sum() == 40
    gaps = np.linalg.norm(np.diff(points[:80], axis=0), axis=1)
    assert np.median(gaps) == pytest.approx(1.0) and gaps.max() <= 1.0 + 1e-9


@pytest.mark.parametrize("degrees", [0, 25, 90, 135])
def test_the_principal_axis_turns_along(degrees: float) -> None:
    angle = np.radians(degrees)
    corners = np.array([(-20, -4), (20, -4), (20, 4), (-20, 4)])
    rotated = corners @ np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    axis = principal_axis(MultiPolygon([[[*map(tuple, rotated + 100)], []]]))
    assert abs(axis @ (np.cos(angle), np.sin(angle))) == pytest.approx(1.0)


@pytest.mark.parametrize("degrees", [-170, -20, 0, 45, 180])
def test_motion_of_turn_and_scale(degrees: float) -> None:
    motion = motion_of(turn(degrees) @ np.vstack([scale(2, 0.5), [0, 0, 1]]))
    assert turn_error(motion.degrees, degrees) == pytest.approx(0, abs=1e-9)
    assert motion.factors == pytest.approx((2, 0.5)) and not motion.mirrored


def test_a_stretch_along_a_slant_is_no_turn() -> None:
    stretched = turn(45) @ np.vstack([scale(0.6, 1), [0, 0, 1]]) @ np.vstack([turn(-45), [0, 0, 1]])
    assert motion_of(stretched).degrees == pytest.approx(0)
    assert motion_of(scale(-1, 1)).mirrored


@pytest.mark.parametrize(
    "table",
    [
        {3: shift(0, 0)},
        {1: [[1, 0], [0, 1]]},
        {1: [[1, 0, np.nan], [0, 1, 0]]},
        {"x": shift(0, 0)},
        {1: "no"},
    ],
)
def test_transforms_that_do_not_fit_are_errors(table: dict) -> None:
    with pytest.raises(InputError, match="transform of segment"):
        read_transforms(table, [1, 2])


def test_repeated_labels_are_numbered_and_stand_for_all() -> None:
    outlines = {k: MultiPolygon([box(x, 0, x + 10, 10)]) for k, x in ((1, 200), (2, 100), (3, 300))}
    labels = {1: "Cart:Wheel", 2: "Cart:Wheel", 3: "Cart:Box"}
    stage = Stage((512, 512), outlines, labels, {})
    assert [p.name for p in stage.parts] == ["Cart:Wheel #2", "Cart:Wheel #1", "Cart:Box"]
    assert stage.shape("Cart:Wheel #1").attribute("minx") == 100
    assert stage.shape("Cart:Wheel").attribute("width") == 110
    assert len(stage.shape("Cart").parts) == 3
    assert len(stage.shape(["Cart", "Cart:Box"]).parts) == 3
