"""Samples and moments of outlines and masks; proxy masks and distance fields."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import pdist

from iconjax.scene import sampling
from iconjax.scene.distance import signed_distance
from iconjax.scene.proxy import proxy_mask

RECT = np.array([[10.0, 20], [90, 20], [90, 40], [10, 40]])
ANGLES = np.linspace(0, 2 * np.pi, 200, endpoint=False)
DISC = 50 + 30 * np.stack([np.cos(ANGLES), np.sin(ANGLES)], 1)


def turned(loop: np.ndarray, degrees: float) -> np.ndarray:
    a = np.deg2rad(degrees)
    return np.asarray(loop @ np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]]))


@pytest.mark.parametrize("count", [4, 7, 16, 33])
def test_support_points_hold_the_axis_extremes(count: int) -> None:
    loops = [turned(RECT, 33), DISC]
    points = sampling.support_points(loops, count)
    every = np.concatenate(loops)
    assert points.shape == (count, 2)
    np.testing.assert_array_equal(points.min(0), every.min(0))
    np.testing.assert_array_equal(points.max(0), every.max(0))


def test_resample_keeps_corners_and_spacing() -> None:
    points, ends, weight = sampling.resample([RECT], 24)
    assert points.shape == ends.shape == (24, 2)
    assert {tuple(v) for v in RECT} <= {tuple(v) for v in points}
    assert weight.sum() == pytest.approx(1)
    assert np.linalg.norm(ends - points, axis=1).max() < 1.5 * 200 / 24
    assert shapely.Polygon(points).area == pytest.approx(1600)


def test_resample_shares_by_length_and_closes_each_loop() -> None:
    small = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4]])
    points, ends, weight = sampling.resample([RECT, small], 64)
    far = points[:, 0] >= 10
    assert weight[far].sum() == pytest.approx(200 / 216)
    assert 3 <= (~far).sum() <= 10
    for part in (far, ~far):
        np.testing.assert_allclose(ends[part], np.roll(points[part], -1, 0))


def test_resample_of_many_loops_and_of_nothing() -> None:
    loops = [turned(DISC * (k + 1) / 30, 0) for k in range(30)]
    points, ends, weight = sampling.resample(loops, 16)
    assert points.shape == (16, 2)
    assert weight.sum() == pytest.approx(1)
    assert np.linalg.norm(ends - points, axis=1).max() <= 60 * 1.8
    points, ends, weight = sampling.resample([np.array([[3.0, 4.0]] * 3)], 5)
    np.testing.assert_array_equal(points, ends)
    assert not weight.any() and (points == [3, 4]).all()


@settings(max_examples=60, deadline=None)
@given(st.integers(3, 200), st.integers(1, 12), st.integers(0, 2**32 - 1))
def test_resample_gives_exactly_count_points_on_the_outlines(count: int, pieces: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    loops = []
    for _ in range(pieces):
        angles = np.sort(rng.uniform(0, 2 * np.pi, rng.integers(3, 40)))
        loops.append(rng.uniform(0, 500, 2) + rng.uniform(1, 90) * np.stack([np.cos(angles), np.sin(angles)], 1))
    points, ends, weight = sampling.resample(loops, count)
    assert points.shape == ends.shape == (count, 2)
    assert weight.shape == (count,)
    assert weight.min() >= 0 and weight.sum() == pytest.approx(1)
    rings = shapely.multilinestrings([shapely.linearrings(loop) for loop in loops])
    assert shapely.distance(shapely.points(points), rings).max() < 1e-6
    np.testing.assert_allclose(ends[np.lexsort(ends.T)], points[np.lexsort(points.T)], atol=1e-9)


def test_moments_ignore_vertex_density_and_orientation() -> None:
    dense = np.concatenate([np.linspace([10, 20], [90, 20], 500, endpoint=False), RECT[1:]])
    for loops in ([RECT], [dense], [RECT[::-1]]):
        area, centre, cov = sampling.moments(loops)
        assert area == pytest.approx(1600)
        np.testing.assert_allclose(centre, [50, 30])
        np.testing.assert_allclose(cov, [[80**2 / 12, 0], [0, 20**2 / 12]], atol=1e-6)
        assert sampling.elongation(loops) == pytest.approx(4)


@settings(max_examples=50, deadline=None)
@given(st.floats(-90, 90))
def test_principal_axis_follows_the_shape(degrees: float) -> None:
    axis = sampling.principal_axis([turned(RECT, degrees)])
    assert np.linalg.norm(axis) == pytest.approx(1)
    a = np.deg2rad(degrees)
    assert abs(axis @ [-np.sin(a), np.cos(a)]) <= np.sin(np.deg2rad(sampling.AXIS_ALIGNED)) + 1e-9
    assert axis[0] > 0 or tuple(axis) == (0.0, 1.0)


@pytest.mark.parametrize("loop", [DISC, RECT[:, :1] * 0 + [[0, 0], [9, 0], [9, 9], [0, 9]], turned(DISC, 12)])
def test_shapes_without_direction_get_a_picture_axis(loop: np.ndarray) -> None:
    assert tuple(sampling.principal_axis([loop])) == (1.0, 0.0)
    assert sampling.elongation([loop]) == pytest.approx(1, abs=1e-6)


def test_moments_of_a_line_are_finite() -> None:
    line = np.array([[0.0, 0], [10, 0], [5, 0]])
    assert tuple(sampling.principal_axis([line])) == (1.0, 0.0)
    assert np.isfinite(sampling.elongation([line]))
    assert np.isfinite(sampling.elongation([np.zeros((3, 2))]))


def test_area_samples_are_spread_and_inside() -> None:
    mask = np.zeros((80, 120), bool)
    mask[10:70, 10:110] = True
    mask[30:50, 30:90] = False
    points = sampling.area_samples(mask, 50)
    rows, cols = (points[:, 1] - 0.5).astype(int), (points[:, 0] - 0.5).astype(int)
    assert points.shape == (50, 2)
    assert mask[rows, cols].all()
    assert pdist(points).min() > 0.4 * np.sqrt(mask.sum() / 50)
    np.testing.assert_allclose(points.mean(0), [60, 40], atol=2)
    assert sampling.area_samples(np.ones((1, 2), bool), 5).shape == (5, 2)


@pytest.mark.parametrize("side", ["top", "bot", "left", "right"])
def test_side_loops_are_the_outermost_quarter(side: str) -> None:
    (loop,) = sampling.side_loops([RECT], side, (10, 20, 90, 40))
    expected = {
        "top": (10, 20, 90, 25), "bot": (10, 35, 90, 40), "left": (10, 20, 30, 40), "right": (70, 20, 90, 40),
    }[side]  # fmt: skip
    assert (*loop.min(0), *loop.max(0)) == expected
    x, y = loop.T
    assert (x * np.roll(y, -1) - np.roll(x, -1) * y).sum() > 0


def test_side_loops_of_a_shape_with_two_feet() -> None:
    legs = np.array([[0.0, 0], [30, 0], [30, 40], [20, 40], [20, 10], [10, 10], [10, 40], [0, 40]])
    assert len(sampling.side_loops([legs], "bot", (0, 0, 30, 40))) == 2
    assert sampling.side_loops([legs], "top", (0, -400, 30, 40)) == ()
    assert sampling.side_loops([], "top", (0, 0, 30, 40)) == ()
    with pytest.raises(ValueError, match="side must be"):
        sampling.side_loops([legs], "middle", (0, 0, 30, 40))


def brute_proxy(mask: np.ndarray, rays: int, ratio: float) -> np.ndarray:
    h, w = mask.shape
    out = mask.copy()
    steps = np.arange(0, h + w, 0.25)
    for i, j in np.ndindex(h, w):
        hits = 0
        for a in np.arange(rays) * 2 * np.pi / rays:
            y, x = (
                np.floor(i + 0.5 + steps * np.sin(a)).astype(int),
                np.floor(j + 0.5 + steps * np.cos(a)).astype(int),
            )
            ok = (y >= 0) & (y < h) & (x >= 0) & (x < w)
            hits += mask[y[ok], x[ok]].any()
        out[i, j] |= hits >= ratio * rays
    return out


def test_proxy_fills_holes_and_bays_with_narrow_mouths_only() -> None:
    mask = np.zeros((41, 41), bool)
    mask[4:37, 4:37] = True
    mask[9:32, 9:32] = False
    closed = proxy_mask(mask)
    assert closed[4:37, 4:37].all() and closed.sum() == 33 * 33
    mask[9:32, 32:] = False  # now a bay open to the right
    open_ = proxy_mask(mask)
    assert open_[20, 9] == brute_proxy(mask, 16, 0.9)[20, 9]
    assert not open_[20, 30]
    assert (open_ == brute_proxy(mask, 16, 0.9)).mean() > 0.97
    assert not proxy_mask(np.zeros((5, 5), bool)).any()


def test_proxy_is_mirror_symmetric() -> None:
    mask = np.random.default_rng(3).random((40, 50)) < 0.12
    proxy = proxy_mask(mask)
    assert proxy[mask].all()
    assert (proxy_mask(mask[:, ::-1])[:, ::-1] == proxy).mean() > 0.9


def test_signed_distance() -> None:
    mask = np.zeros((9, 30), bool)
    mask[2:7, :5] = True
    field = signed_distance(mask)
    assert field[4, 2] == -2.5
    assert field[4, 0] == -0.5
    assert field[4, 10] == 5.5
    assert ((field < 0) == mask).all()
    assert (signed_distance(np.zeros((3, 4), bool)) == 7).all()
    assert signed_distance(np.ones((3, 5), bool))[1, 2] == -1.5
