"""The renderer: exactness, seams, holes, hidden places."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageDraw

from iconjax.errors import InputError
from iconjax.render.raster import outlines_after, render
from iconjax.render.sheet import segment_sheet
from iconjax.scene.types import Scene, Segment

CASES = Path(__file__).parent.parent / "eval" / "benchmark"
WHITE = np.array([255, 255, 255], np.uint8)


def scene_of(image: np.ndarray, label: np.ndarray) -> Scene:
    segments = []
    for k in (k for k in np.unique(label) if k):
        mask = label == k
        rows, cols = np.nonzero(mask)
        box = (float(cols.min()), float(rows.min()), float(cols.max() + 1), float(rows.max() + 1))
        loop = np.array([[box[0], box[1]], [box[2], box[1]], [box[2], box[3]], [box[0], box[3]]])
        segments.append(Segment(int(k), f"S:{k}", "S", str(k), mask, (loop,), float(mask.sum()), box))
    return Scene(image, tuple(segments), WHITE)


def case_scene(name: str) -> Scene:
    image = np.asarray(Image.open(CASES / name / "image.png").convert("RGB"))
    return scene_of(image, np.asarray(Image.open(CASES / name / "segmentation.png")))


def drawn(shapes: list[tuple[str, list[float], tuple[int, int, int]]], size: int = 128) -> Scene:
    """Anti-aliased shapes, drawn 8 times as large; a pixel is labelled where a shape covers half of it."""
    picture = Image.new("RGB", (size * 8, size * 8), (255, 255, 255))
    ids = Image.new("L", picture.size, 0)
    for k, (kind, box, colour) in enumerate(shapes, start=1):
        scaled = [v * 8 for v in box]
        getattr(ImageDraw.Draw(picture), kind)(scaled, fill=colour)
        getattr(ImageDraw.Draw(ids), kind)(scaled, fill=k)
    blocks = np.asarray(picture, float).reshape(size, 8, size, 8, 3).mean(axis=(1, 3))
    owner = np.asarray(ids).reshape(size, 8, size, 8)
    shares = np.stack([(owner == k).mean(axis=(1, 3)) for k in range(len(shapes) + 1)])
    return scene_of(np.rint(blocks).astype(np.uint8), shares.argmax(axis=0))


def still(scene: Scene) -> np.ndarray:
    return np.tile(np.eye(2, 3), (len(scene.segments), 1, 1))


def shifted(scene: Scene, **by: tuple[float, float]) -> np.ndarray:
    matrices = still(scene)
    for name, shift in by.items():
        matrices[int(name[1:]) - 1, :, 2] = shift
    return matrices


def turn(degrees: float, centre: tuple[float, float]) -> np.ndarray:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    linear = np.array([[c, -s], [s, c]])
    return np.column_stack([linear, np.array(centre) - linear @ centre])


def ids(scene: Scene) -> range:
    return range(len(scene.segments))


@pytest.mark.parametrize("name", ["basket-handles-apart", "leg-swing-shin", "ferris-wheel-turn"])
def test_identity_is_exact_on_icons(name: str) -> None:
    scene = case_scene(name)
    assert np.array_equal(render(scene, still(scene), ids(scene)), scene.image)


@pytest.mark.parametrize("name", ["crane-hook-back", "umbrella-45", "fish-body-shorter", "museum-columns"])
def test_far_from_a_moved_segment_nothing_changes(name: str) -> None:
    scene = case_scene(name)
    matrices = still(scene)
    matrices[0, :, 2] = (2000.0, 0.0)
    out = render(scene, matrices, ids(scene))
    rows, cols = np.nonzero(scene.segments[0].mask)
    far = np.ones(out.shape[:2], bool)
    far[max(rows.min() - 8, 0) : rows.max() + 9, max(cols.min() - 8, 0) : cols.max() + 9] = False
    assert np.array_equal(out[far], scene.image[far])


def test_whole_pixel_translation_of_everything_is_exact() -> None:
    scene = case_scene("truck-cargo-shorter")
    matrices = still(scene)
    matrices[:, :, 2] = (-7.0, 11.0)
    out = render(scene, matrices, ids(scene))
    assert np.array_equal(out[11:, :-7], scene.image[:-11, 7:])


def test_whole_pixel_translation_of_one_is_exact() -> None:
    scene = drawn([("ellipse", [20.3, 20.2, 60.6, 55.1], (40, 90, 200)), ("ellipse", [90, 90, 120, 115], (9, 9, 9))])
    out = render(scene, shifted(scene, s1=(13, 31)), (0, 1))
    rows, cols = np.nonzero(scene.segments[0].mask)
    assert np.array_equal(out[rows + 31, cols + 13], scene.image[rows, cols])


def test_hard_edges_of_touching_neighbours_move_exactly() -> None:
    image = np.full((80, 80, 3), 255, np.uint8)
    label = np.zeros((80, 80), np.uint8)
    label[20:50, 10:30], label[20:50, 30:50] = 1, 2
    image[label == 1], image[label == 2] = (200, 30, 30), (30, 30, 200)
    scene = scene_of(image, label)
    out = render(scene, shifted(scene, s2=(9, 3)), (0, 1))
    expected = np.full_like(image, 255)
    expected[label == 1] = (200, 30, 30)
    expected[23:53, 39:59] = (30, 30, 200)
    assert np.array_equal(out, expected)


def test_no_ghost_stays_where_a_segment_left() -> None:
    scene = drawn([("ellipse", [30.4, 30.7, 80.2, 82.9], (20, 20, 20))])
    out = render(scene, shifted(scene, s1=(500, 0)), (0,))
    assert (out == 255).all()


def test_neither_neighbour_keeps_the_others_rim() -> None:
    scene = drawn([
        ("ellipse", [20.3, 30.2, 80.4, 90.7], (30, 60, 220)),
        ("ellipse", [60.6, 40.1, 110.2, 88.3], (230, 40, 20)),
    ])  # fmt: skip
    out = render(scene, shifted(scene, s2=(500, 0)), (0, 1)).astype(int)
    # Every pixel left is a mixture of blue and white: red over blue would be low in blue.
    assert (out[..., 2] >= 215).all()
    out = render(scene, shifted(scene, s1=(500, 0)), (0, 1)).astype(int)
    assert (out[..., 0] >= 225).all()


def test_a_moved_rim_is_blended_with_what_is_there_now() -> None:
    scene = drawn([
        ("rectangle", [70, 4, 124, 124], (0, 0, 120)),
        ("ellipse", [10.3, 40.6, 50.2, 80.9], (160, 0, 0)),
    ])  # fmt: skip
    out = render(scene, shifted(scene, s2=(66.5, 0.25)), (0, 1))[6:122, 74:120].astype(int)
    assert out[..., 1].max() <= 2  # no white fringe between dark red and dark blue


@pytest.mark.parametrize("degrees", [0.0, 17.0, 90.0])
def test_neighbours_that_move_as_one_show_no_seam(degrees: float) -> None:
    colour = (60, 120, 60)
    scene = drawn([
        ("rectangle", [30, 30, 62.5, 90], colour),
        ("rectangle", [62.5, 30, 95, 90], colour),
    ])  # fmt: skip
    matrices = np.tile(turn(degrees, (62.0, 60.0)), (2, 1, 1))
    matrices[:, :, 2] += (3.4, 0.7)
    for order in ((0, 1), (1, 0)):
        out = render(scene, matrices, order)[45:76, 48:80].astype(int)
        assert np.abs(out - colour).max() <= 2


def test_true_holes_stay_holes() -> None:
    scene = drawn([("ellipse", [30, 30, 90, 90], (0, 0, 0)), ("ellipse", [45, 45, 75, 75], (255, 255, 255))])
    label = np.where(scene.segments[0].mask, 1, 0)
    scene = scene_of(scene.image, label)
    out = render(scene, shifted(scene, s1=(10.5, 0)), (0,))
    assert (out[55:65, 65:75] == 255).all()
    assert out[60, 40:50].max() == 0 or out[60, 44:52].max() == 0


def test_a_face_is_whole_under_the_eye_that_left() -> None:
    scene = drawn([
        ("ellipse", [20, 20, 100, 100], (250, 200, 60)),
        ("ellipse", [40.3, 40.2, 60.6, 60.9], (20, 20, 20)),
    ])  # fmt: skip
    out = render(scene, shifted(scene, s2=(500, 0)), (0, 1)).astype(int)
    assert np.abs(out[36:66, 36:66] - (250, 200, 60)).max() <= 4


def test_a_bar_goes_on_behind_the_post_that_left() -> None:
    scene = drawn([
        ("rectangle", [10, 50, 118, 70.5], (200, 120, 40)),
        ("rectangle", [55, 20, 75, 110], (60, 60, 60)),
    ])  # fmt: skip
    out = render(scene, shifted(scene, s2=(500, 0)), (0, 1)).astype(int)
    change = np.abs(out[40:80] - out[40:80, 30:31])[:, 20:110]
    assert np.delete(change, 30, axis=0).max() <= 2  # the same all along its length
    assert change.max() <= 30  # but for the half covered row, where post, bar and background meet
    behind = render(scene, shifted(scene, s2=(500, 0)), (1, 0))
    assert (behind[55:65, 58:72] == 255).all()  # nothing hidden in what lies in front


def test_a_u_is_not_closed() -> None:
    image = np.full((100, 100, 3), 255, np.uint8)
    label = np.zeros((100, 100), np.uint8)
    label[20:80, 10:20] = label[20:80, 80:90] = label[70:80, 10:90] = 1
    label[30:70, 20:80] = 2
    image[label == 1], image[label == 2] = (50, 50, 50), (250, 90, 90)
    scene = scene_of(image, label)
    out = render(scene, shifted(scene, s2=(500, 0)), (0, 1))
    assert (out[30:70, 20:80] == 255).all()


def test_what_several_neighbours_enclose_is_healed() -> None:
    scene = drawn([
        ("rectangle", [10, 10, 64, 118], (250, 200, 60)),
        ("rectangle", [64, 10, 118, 118], (250, 180, 60)),
        ("ellipse", [44.2, 44.1, 84.3, 84.8], (20, 20, 20)),
    ])  # fmt: skip
    out = render(scene, shifted(scene, s3=(500, 0)), (0, 1, 2)).astype(int)
    assert out[20:110, 20:110, 2].max() <= 64 and out[20:110, 20:110, 0].min() >= 244


def test_a_hole_that_moves_onto_its_segments_old_place_stays_a_hole() -> None:
    image = np.full((90, 90, 3), 255, np.uint8)
    label = np.zeros((90, 90), np.uint8)
    label[10:80, 10:60] = 1
    label[30:36, 20:26] = 0
    image[label == 1] = (90, 20, 20)
    scene = scene_of(image, label)
    out = render(scene, shifted(scene, s1=(20, 0)), (0,))
    assert np.array_equal(out[:, 20:], image[:, :-20])


def test_order_decides_what_is_seen() -> None:
    scene = drawn([("rectangle", [10, 10, 50, 50], (200, 0, 0)), ("rectangle", [70, 10, 110, 50], (0, 0, 200))])
    matrices = shifted(scene, s1=(30, 0), s2=(-30, 0))
    assert tuple(render(scene, matrices, (0, 1))[30, 60]) == (0, 0, 200)
    assert tuple(render(scene, matrices, (1, 0))[30, 60]) == (200, 0, 0)


def test_edges_of_the_canvas_and_degenerate_transforms() -> None:
    scene = drawn([("rectangle", [0, 0, 60, 60], (10, 10, 10))])
    half = render(scene, shifted(scene, s1=(-30.5, -400)), (0,))
    assert (half == 255).all()
    flat = still(scene)
    flat[0, 0, 0] = 0.0
    assert (render(scene, flat, (0,)) == 255).all()
    assert render(scene, shifted(scene, s1=(-20, 0)), (0,))[30, 0].max() == 10
    with pytest.raises(InputError):
        render(scene, still(scene) * np.nan, (0,))
    with pytest.raises(InputError):
        render(scene, still(scene), (1,))


def test_a_scene_without_segments() -> None:
    image = np.zeros((9, 7, 3), np.uint8)
    scene = Scene(image, (), WHITE)
    assert np.array_equal(render(scene, np.zeros((0, 2, 3)), ()), image)
    assert segment_sheet(scene).shape == (9, 7, 3)


def test_a_mirror_and_a_half_scale_land_where_they_should() -> None:
    scene = drawn([("rectangle", [20, 20, 60, 60], (0, 0, 0))])
    matrices = np.array([[[-0.5, 0.0, 100.0], [0.0, 0.5, 10.0]]])
    out = render(scene, matrices, (0,))
    rows, cols = np.nonzero(out[..., 0] < 128)
    assert (rows.min(), rows.max() + 1, cols.min(), cols.max() + 1) == (20, 40, 70, 90)


@pytest.mark.parametrize("name", ["cake-sponge-half", "excavator-boom", "bubbles-straw", "telescope-level"])
def test_close_to_the_vector_ground_truth(name: str) -> None:
    scene = case_scene(name)
    moved = json.loads((CASES / name / "ground_truth.json").read_text())["transforms"]
    matrices = np.array([moved.get(str(s.id), np.eye(2, 3)) for s in scene.segments], float)
    truth = np.asarray(Image.open(CASES / name / "ground_truth.png").convert("RGB"), float)
    assert ((render(scene, matrices, ids(scene)) - truth) ** 2).mean() < 6.0


def test_outlines_and_sheet() -> None:
    scene = drawn([("rectangle", [20, 20, 60, 60], (0, 0, 0))])
    moved = outlines_after(scene, shifted(scene, s1=(3, 4)))
    assert np.allclose(moved[0][0], scene.segments[0].loops[0] + (3, 4))
    assert segment_sheet(scene).dtype == np.uint8
