"""Outlines of masks, checked on shapes whose outline is known."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.ndimage import label

from iconjax.scene.outline import drop_specks, fill, trace
from iconjax.scene.sampling import moments, perimeter

ROWS, COLS = np.mgrid[0:240, 0:240] + 0.5


def disc(radius: float, x: float = 120.0, y: float = 120.0) -> np.ndarray:
    return np.asarray((COLS - x) ** 2 + (ROWS - y) ** 2 <= radius**2)


def signed_area(loop: np.ndarray) -> float:
    x, y = loop.T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2)


@pytest.mark.parametrize(
    ("rows", "cols"), [((10, 20), (5, 15)), ((0, 1), (0, 1)), ((3, 4), (2, 30)), ((0, 40), (7, 9))]
)
def test_rectangles_are_exact(rows: tuple[int, int], cols: tuple[int, int]) -> None:
    mask = np.zeros((40, 40), bool)
    mask[slice(*rows), slice(*cols)] = True
    (loop,) = trace(mask)
    corners = {(float(x), float(y)) for x in cols for y in rows}
    assert len(loop) == 4
    assert {tuple(v) for v in loop.tolist()} == corners
    assert signed_area(loop) == (rows[1] - rows[0]) * (cols[1] - cols[0])


def test_a_stepped_shape_keeps_all_its_corners() -> None:
    mask = np.zeros((40, 40), bool)
    mask[5:30, 5:12] = mask[22:30, 5:35] = True
    (loop,) = trace(mask)
    assert {tuple(v) for v in loop.tolist()} == {(5, 5), (12, 5), (12, 22), (35, 22), (35, 30), (5, 30)}


@pytest.mark.parametrize("radius", [8, 20, 50, 100])
def test_discs(radius: int) -> None:
    (loop,) = trace(disc(radius))
    assert moments([loop])[0] == pytest.approx(disc(radius).sum(), rel=0.005)
    assert perimeter(loop) == pytest.approx(2 * np.pi * radius, rel=0.035 if radius < 20 else 0.02)
    assert np.abs(np.hypot(*(loop - 120).T) - radius).max() < 0.5
    assert [*loop.min(0), *loop.max(0)] == [120 - radius] * 2 + [120 + radius] * 2


@pytest.mark.parametrize("degrees", [5, 17, 30, 60])
def test_tilted_rectangles(degrees: int) -> None:
    turn = np.deg2rad(degrees)
    ahead = np.array([np.cos(turn), np.sin(turn)])
    aside = np.array([-ahead[1], ahead[0]])
    points = np.stack([COLS - 120, ROWS - 120], -1)
    (loop,) = trace((np.abs(points @ ahead) <= 80) & (np.abs(points @ aside) <= 20))
    out = np.maximum(np.abs((loop - 120) @ ahead) - 80, np.abs((loop - 120) @ aside) - 20)
    assert np.abs(out).max() < 0.55
    assert perimeter(loop) == pytest.approx(400, rel=0.015)
    assert moments([loop])[0] == pytest.approx(6400, rel=0.002)
    assert len(loop) < 120


def test_holes_are_ignored_and_components_kept() -> None:
    ring = disc(60) & ~disc(30) | disc(10)
    assert fill(ring).sum() == disc(60).sum()
    two = disc(20, 60) | disc(30, 170)
    assert len(trace(fill(two))) == 2


def test_a_hole_does_not_leak_out_between_diagonal_pixels() -> None:
    diamond = np.array([[0, 1, 0], [1, 0, 1], [0, 1, 0]], bool)
    assert fill(diamond).sum() == 5


def test_a_diagonal_line_is_one_outline() -> None:
    (loop,) = trace(np.eye(20, dtype=bool))
    assert shapely.Polygon(loop).is_valid
    assert [*loop.min(0), *loop.max(0)] == [0, 0, 20, 20]


def test_specks_go_but_small_components_stay() -> None:
    mask = disc(60)
    mask[0, 0] = True
    mask[200:204, 200:204] = True
    kept = drop_specks(mask)
    assert not kept[0, 0]
    assert kept[200, 200]
    dots = np.zeros((9, 9), bool)
    dots[::4, ::4] = True
    assert drop_specks(dots).sum() == 9


@settings(max_examples=150, deadline=None)
@given(arrays(bool, st.tuples(st.integers(1, 14), st.integers(1, 14))))
def test_any_mask(mask: np.ndarray) -> None:
    if not mask.any():
        return
    solid = fill(mask)
    loops = trace(solid)
    parts, count = label(solid, np.ones((3, 3)))
    assert len(loops) == count
    boxes = set()
    for loop in loops:
        assert signed_area(loop) > 0
        assert shapely.Polygon(loop).is_valid
        boxes.add((*loop.min(0).tolist(), *loop.max(0).tolist()))
    expected = set()
    for k in range(1, count + 1):
        rows, cols = np.nonzero(parts == k)
        expected.add((float(cols.min()), float(rows.min()), float(cols.max() + 1), float(rows.max() + 1)))
    assert boxes == expected
    area = sum(signed_area(loop) for loop in loops)
    assert abs(area - solid.sum()) <= 0.5 * sum(perimeter(loop) for loop in loops)
