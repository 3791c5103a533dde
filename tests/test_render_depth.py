"""The paper's depth rule, its ties and its contradictions."""

from __future__ import annotations

import numpy as np
import pytest

from iconjax.render.depth import _arrange, depth_order
from iconjax.scene.types import Scene, Segment


def scene_of(label: np.ndarray) -> Scene:
    segments = []
    for k in (k for k in np.unique(label) if k):
        mask = label == k
        rows, cols = np.nonzero(mask)
        box = (float(cols.min()), float(rows.min()), float(cols.max() + 1), float(rows.max() + 1))
        segments.append(Segment(int(k), f"S:{k}", "S", str(k), mask, (), float(mask.sum()), box))
    image = np.full((*label.shape, 3), 255, np.uint8)
    image[label > 0] = (90, 90, 90)
    return Scene(image, tuple(segments), np.array([255, 255, 255], np.uint8))


def disk(centre: tuple[float, float], radius: float, size: int = 256) -> np.ndarray:
    y, x = np.mgrid[:size, :size] + 0.5
    return np.hypot(x - centre[0], y - centre[1]) < radius


@pytest.mark.parametrize("front", [1, 2])
def test_of_two_overlapping_disks_the_whole_one_is_in_front(front: int) -> None:
    label = np.zeros((256, 256), np.uint8)
    label[disk((100, 128), 60)] = 3 - front
    label[disk((160, 128), 55)] = front
    assert depth_order(scene_of(label)).order == ((0, 1) if front == 2 else (1, 0))


@pytest.mark.parametrize("eye", [1, 2])
def test_an_eye_lies_on_the_face(eye: int) -> None:
    label = np.zeros((256, 256), np.uint8)
    label[disk((128, 128), 90)] = 3 - eye
    label[disk((110, 100), 20)] = eye
    result = depth_order(scene_of(label))
    assert result.order[-1] == eye - 1
    assert not result.undetermined


def test_abutting_squares_are_undetermined_and_keep_their_order() -> None:
    label = np.zeros((256, 256), np.uint8)
    label[60:160, 40:120], label[60:160, 120:200] = 2, 1
    result = depth_order(scene_of(label))
    assert result.order == (0, 1)
    assert result.undetermined == ((0, 1),)


def test_a_small_part_within_the_others_box_is_in_front_on_a_tie() -> None:
    label = np.zeros((256, 256), np.uint8)
    label[40:200, 40:200] = 2
    label[100:140, 40:200] = 0
    label[104:120, 90:140] = 1
    label[98:104, 90:140] = 2
    label[100:104, 90:140] = 2
    result = depth_order(scene_of(label))
    assert result.order == (1, 0)


def test_segments_apart_keep_the_order_of_their_ids() -> None:
    label = np.zeros((256, 256), np.uint8)
    for k in range(4):
        label[20:60, 10 + 60 * k : 50 + 60 * k] = 4 - k
    result = depth_order(scene_of(label))
    assert result.order == (0, 1, 2, 3)
    assert not result.undetermined and not result.cycles


def test_a_cycle_is_broken_at_its_weakest_link_and_reported() -> None:
    result = _arrange(3, {(0, 1): 0.9, (1, 2): 0.8, (2, 0): 0.2}, [])
    assert result.order == (0, 1, 2)
    assert result.cycles == ((0, 1, 2),)


def test_a_default_never_overrules_a_decision() -> None:
    result = _arrange(3, {(2, 1): 0.5, (1, 0): 0.5}, [(0, 2)])
    assert result.order == (2, 1, 0)
    assert result.undetermined == ((2, 0),)


def test_an_empty_scene() -> None:
    assert depth_order(Scene(np.zeros((5, 5, 3), np.uint8), (), np.zeros(3, np.uint8))).order == ()
