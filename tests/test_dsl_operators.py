"""Every operator on shapes whose geometry is known, in moved, turned and stretched poses."""

from __future__ import annotations

import dsl_helpers as shapes
import numpy as np
import pytest
from dsl_helpers import affine, disc, joined, rectangle, region, residual, value

BAR = region(rectangle(100, 100, 180, 120))
SQUARE = region(rectangle(200, 200, 300, 300))
near = pytest.approx


def at(shape, **pose):
    """A shape moved by `affine`."""
    return shapes.moved(shape, affine(**pose))


def square(x, y, side=100):
    return region(rectangle(x, y, x + side, y + side))


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("min_x", 100), ("max_x", 180), ("min_y", 100), ("max_y", 120), ("hori_len", 80), ("vert_len", 20),
        ("center_x", 140), ("center_y", 110), ("long_dir_x", 1), ("long_dir_y", 0), ("short_dir_x", 0),
        ("short_dir_y", 1), ("long_len", 80), ("short_len", 20), ("rotation", 0), ("scale_x", 1),
        ("scale_y", 1),
    ],
)  # fmt: skip
def test_attributes_of_a_bar(name, expected):
    assert value(name, BAR) == near(expected, abs=1e-4)


TURN = np.radians(30)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("hori_len", 40 * np.cos(TURN) + 60 * np.sin(TURN)),
        ("vert_len", 40 * np.sin(TURN) + 60 * np.cos(TURN)),
        ("center_x", 147), ("center_y", 105), ("long_dir_x", np.cos(TURN)), ("long_dir_y", np.sin(TURN)),
        ("short_dir_x", -np.sin(TURN)), ("short_dir_y", np.cos(TURN)), ("long_len", 40), ("short_len", 60),
        ("rotation", 30), ("scale_x", 0.5), ("scale_y", 3),
    ],
)  # fmt: skip
def test_attributes_after_scaling_turning_and_moving(name, expected):
    """The bar halved in length, thrice as thick, turned by 30 degrees in place, moved by (7, -5)."""
    edited = at(BAR, turn=30, scale=(0.5, 3), shift=(7, -5), about=(140, 110))
    assert value(name, edited) == near(expected, rel=1e-4)


@pytest.mark.parametrize("turn", [-170, -90, -1, 0, 45, 179])
def test_rotation_is_signed_and_sees_through_scaling(turn):
    assert value("rotation", at(BAR, turn=turn, scale=(2, 0.5))) == near(turn, abs=1e-3)


def test_scale_factors_are_taken_along_the_own_axes():
    slanted = region(rectangle(0, 0, 80, 20), frame=(np.cos(TURN), np.sin(TURN)))
    frame = affine(turn=30)[:, :2]
    matrix = np.column_stack([affine(turn=50)[:, :2] @ frame @ np.diag([2, 3]) @ frame.T, [0, 0]])
    edited = shapes.moved(slanted, matrix)
    assert value("scale_x", edited) == near(2, rel=1e-5)
    assert value("scale_y", edited) == near(3, rel=1e-5)


def test_arithmetic():
    assert value("plus", 2.0, 3.0) == 5
    assert value("minus", 2.0, 3.0) == -1
    assert value("mul", 2.0, 3.0) == 6
    assert value("div", 3.0, 2.0) == 1.5
    assert value("div", 3.0, -2.0) == -1.5
    assert np.isfinite(value("div", 3.0, 0.0))
    assert value("min", 2.0, 3.0) == 2
    assert value("max", 2.0, 3.0) == 3


@pytest.mark.parametrize(("a", "b"), [(5.0, 3.0), (3.0, 5.0), (4.0, 4.0)])
def test_value_specifiers(a, b):
    assert value("equal", a, b) == abs(a - b)
    assert residual("equal", a, b) == a - b
    assert value("smaller", a, b) == residual("smaller", a, b) == max(0, a - b)
    assert value("larger", a, b) == residual("larger", a, b) == max(0, b - a)


def test_angles_are_compared_the_shorter_way_round():
    assert value("equal", -179.0, 180.0, unit="angle") == 1
    assert residual("equal", -170.0, 190.0, unit="angle") == 0
    assert residual("equal", 170.0, 190.0, unit="angle") == -20


# Where two squares of side 100 lie to each other: dx, dy, gap (negative: deepest penetration).
LAYOUTS = [(150, 0, 50), (100, 0, 0), (90, 0, -10), (130, 140, 50), (0, -103, 3), (92, 95, -5)]


@pytest.mark.parametrize(("dx", "dy", "gap"), LAYOUTS)
def test_touch_overlap_and_detach(dx, dy, gap):
    s, t = square(200 + dx, 200 + dy), SQUARE
    for a, b in ((s, t), (t, s)):
        assert residual("touch", a, b) == near(gap, abs=1e-3)
        assert value("touch", a, b) == near(abs(gap), abs=1e-3)
        assert value("overlap", a, b) == near(max(0, gap + 1), abs=1e-3)
        assert value("detach", a, b) == near(max(0, 1.5 - gap), abs=1e-3)


def test_touch_of_what_lies_deep_inside():
    assert value("touch", square(240, 240, 20), SQUARE) == near(40, abs=1e-3)
    assert value("overlap", square(240, 240, 20), SQUARE) == 0
    assert value("detach", square(240, 240, 20), SQUARE) == near(41.5, abs=1e-3)


def test_thin_bars_that_cross_without_a_vertex_in_each_other_overlap():
    across, down = region(rectangle(100, 200, 500, 203)), region(rectangle(301, 20, 304, 420))
    assert value("overlap", across, down) == near(0, abs=0.6)
    assert value("min_dist", across, down) == 0
    assert value("detach", across, down) > 0.5


@pytest.mark.parametrize("mirror", [1, -1])
def test_touch_in_stretched_turned_and_mirrored_poses(mirror):
    """A disc stretched to an ellipse of half-axes 80 and 20, turned by 90 degrees, above a bar."""
    ellipse = at(region(disc(0, 0, 40)), scale=(2 * mirror, 0.5), turn=90, shift=(140, 0))
    assert value("min_dist", ellipse, BAR) == near(20, abs=0.01)
    assert residual("touch", ellipse, BAR) == near(20, abs=0.01)
    lower = at(region(disc(0, 0, 40)), scale=(2 * mirror, 0.5), turn=90, shift=(140, 25))
    assert residual("touch", lower, BAR) == near(-5, abs=0.2)


def test_inside_and_contain():
    assert value("inside", square(220, 210, 60), SQUARE) == 0
    assert value("contain", SQUARE, square(220, 210, 60)) == 0
    assert value("inside", SQUARE, SQUARE) == near(0, abs=1e-3)
    out = square(250, 210, 60)
    assert 10 - 1e-3 <= value("inside", out, SQUARE) <= 20
    assert value("contain", SQUARE, out) == value("inside", out, SQUARE)
    far = value("inside", square(600, 210, 60), SQUARE)
    assert 360 - 1e-3 <= far <= 720


def test_inside_one_of_several_loops():
    both = region(rectangle(0, 0, 50, 50, 24), rectangle(100, 0, 150, 50, 24))
    assert value("inside", square(110, 10, 20), both) == 0
    assert value("inside", square(60, 10, 20), both) > 9


def test_overlapping_loops_count_as_filled():
    both = joined(SQUARE, square(250, 250))
    assert value("inside", square(260, 260, 30), both) == 0


@pytest.mark.parametrize(
    ("name", "dx", "dy"), [("on_top", 0, -1), ("on_bottom", 0, 1), ("on_left", -1, 0), ("on_right", 1, 0)]
)
def test_sides(name, dx, dy):
    def of(step):
        return value(name, square(200 + step * dx, 200 + step * dy), SQUARE)

    assert of(100) == of(180) == 0
    assert of(70) == near(30, abs=1e-3)
    assert of(-100) == near(200, abs=1e-3)


def test_alignment_and_distance_of_centres():
    s = square(230, 110)
    assert (value("align_x", s, SQUARE), value("align_y", s, SQUARE)) == (near(30), near(90))
    assert (residual("align_x", s, SQUARE), residual("align_y", s, SQUARE)) == (near(30), near(-90))
    assert (value("dist_x", SQUARE, s), value("dist_y", SQUARE, s)) == (near(30), near(90))


@pytest.mark.parametrize("turn", [0, 20, 80, 100, 179, -60])
def test_angle_parallel_and_perpendicular(turn):
    turned = at(BAR, turn=turn)
    assert value("angle", turned, BAR) == near(abs(turn), abs=1e-2)
    assert value("parallel", turned, BAR) == near(min(abs(turn), 180 - abs(turn)), abs=1e-2)
    assert value("perpendicular", turned, BAR) == near(abs(90 - abs(turn)), abs=1e-2)


def test_distances_between_outlines():
    s = square(350, 200)
    assert value("min_dist", s, SQUARE) == near(50, abs=1e-3)
    assert value("max_dist", s, SQUARE) == near(150, abs=1e-3)
    inner, outer = region(disc(0, 0, 30)), region(disc(0, 0, 50))
    assert value("avg_dist", inner, outer) == near(20, abs=0.1)
    assert value("max_dist", inner, outer) == near(20, abs=0.1)
    assert value("min_dist", inner, outer) == near(20, abs=0.1)
    assert value("min_dist", square(250, 250), SQUARE) == 0


def test_material_points_that_meet():
    s, t = at(BAR, turn=90, shift=(500, 0)), at(SQUARE, scale=(2, 1))
    anchors = np.array([100.0, 120.0, 200.0, 250.0])  # to (380, 100) and to (400, 250)
    for name in ("coincide_on_point", "hinge"):
        assert residual(name, s, t, anchors) == near([-20, -150], abs=1e-3)
        assert value(name, s, t, anchors) == near(np.hypot(20, 150), rel=1e-5)


def test_together():
    pose = affine(turn=20, scale=(2, 0.7), shift=(3, 4))
    assert value("together", joined(shapes.moved(BAR, pose), shapes.moved(SQUARE, pose))) == near(0, abs=1e-3)
    assert value("together", joined(BAR, at(SQUARE, shift=(10, 0)))) == near(5, abs=1e-3)


def test_uniform():
    assert value("uniform", at(BAR, turn=70, scale=(3, 3))) == near(0, abs=1e-3)
    assert value("uniform", at(BAR, turn=70, scale=(2, 1))) == near(80 * np.log(2), rel=1e-4)
    assert value("uniform", at(BAR, scale=(1, 1.01))) == near(80 * np.log(1.01), rel=1e-3)
    grown = residual("uniform", at(BAR, turn=40, scale=(1.1, 1)))
    shrunk = residual("uniform", at(BAR, turn=40, scale=(1, 1.1)))
    assert grown == near(-shrunk, rel=1e-3)


def test_intersection():
    shared = shapes.jitted("inter")(SQUARE, square(250, 270))
    box = [value(n, shared) for n in ("min_x", "max_x", "min_y", "max_y")]
    assert box == near([250, 300, 270, 300], abs=1e-2)
    assert float(np.sum(shared.weight)) == near(1)
    across, down = region(rectangle(100, 200, 500, 220)), region(rectangle(300, 100, 330, 400))
    box = [value(n, shapes.jitted("inter")(across, down)) for n in ("min_x", "max_x", "min_y", "max_y")]
    assert box == near([300, 330, 200, 220], abs=1e-2)
    inner = shapes.jitted("inter")(SQUARE, square(220, 240, 30))
    assert value("hori_len", inner) == near(30, abs=1e-2)
    assert value("inside", square(252, 272, 20), shared) == 0


def test_empty_intersection_is_the_point_between():
    nothing = shapes.jitted("inter")(SQUARE, square(400, 200))
    assert value("hori_len", nothing) == value("vert_len", nothing) == 0
    assert value("center_x", nothing) == near(350)


def test_padding_counts_for_nothing():
    padded = region(rectangle(350, 200, 450, 300, shapes.VERTICES - 8), padding=3 + 8)
    for name in ("touch", "inside", "min_dist", "avg_dist", "max_dist", "on_right", "angle"):
        assert value(name, padded, SQUARE) == near(value(name, square(350, 200), SQUARE), rel=0.05)
        assert value(name, SQUARE, padded) == near(value(name, SQUARE, square(350, 200)), rel=0.05)


def test_violation_is_the_norm_of_the_residual():
    s, t = at(BAR, turn=25, scale=(1.5, 0.8), shift=(90, 100)), SQUARE
    for name in ("inside", "contain", "touch", "overlap", "detach", "on_top", "on_bottom", "on_left",
                 "on_right", "align_x", "align_y", "parallel", "perpendicular"):  # fmt: skip
        assert value(name, s, t) == near(np.linalg.norm(residual(name, s, t)), rel=1e-5), name
    for name in ("uniform", "together"):
        assert value(name, s) == near(np.linalg.norm(residual(name, s)), rel=1e-5, abs=1e-3), name
