"""Writing an edited SVG, and drawing it: our own picture against the rasteriser's of the written file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from svg_features import BALL, BOX, FEATURES, drawn, random_motions, svg

from iconjax.errors import InputError
from iconjax.render.raster import render
from iconjax.render.svg import write_svg
from iconjax.scene.svg import SvgScene, open_svg

ICONS = sorted((Path(__file__).parent.parent / "eval" / "benchmark").glob("*/icon.svg"))
APART = {"pattern", "shadow"}
"""resvg turns neither tiles nor shadows along with their element, though the standard and our own picture do."""


def shift(vector: SvgScene, **by: tuple[float, float]) -> np.ndarray:
    matrices = np.tile(np.eye(2, 3), (len(vector.members), 1, 1))
    for name, values in by.items():
        matrices[int(name[1:]) - 1, :, 2] = values
    return matrices


def written(data: bytes, size: int = 240, **by: tuple[float, float]) -> str:
    vector = open_svg(data, size=size)
    return write_svg(vector, shift(vector, **by)).decode()


def errors(vector: SvgScene, matrices: np.ndarray) -> np.ndarray:
    scene = vector.scene
    ours = render(scene, matrices, range(len(matrices)))
    return np.abs(ours.astype(float) - drawn(write_svg(vector, matrices), (scene.width, scene.height)))


@pytest.mark.parametrize("name", [name for name in FEATURES if name not in APART])
def test_our_picture_is_that_of_the_written_file(name):
    vector = open_svg(FEATURES[name], size=240)
    for seed in range(2):
        error = errors(vector, random_motions(vector, seed))
        assert error.mean() < 0.6
        assert (error.max(axis=-1) > 100).mean() < 0.002


@pytest.mark.parametrize("path", ICONS[::5], ids=lambda path: path.parent.name)
def test_our_picture_of_real_icons_is_that_of_the_written_file(path):
    vector = open_svg(path, size=240)
    error = errors(vector, random_motions(vector, 3))
    assert error.mean() < 0.9
    assert (error.max(axis=-1) > 100).mean() < 0.003


@pytest.mark.parametrize("name", FEATURES)
def test_without_an_edit_everything_is_as_it_was(name):
    vector = open_svg(FEATURES[name], size=120)
    still = shift(vector)
    assert write_svg(vector, still) == FEATURES[name]
    assert np.array_equal(render(vector.scene, still, range(len(still))), vector.scene.image)
    assert (
        np.abs(vector.scene.image.astype(int) - drawn(FEATURES[name], (vector.scene.width, vector.scene.height))).max()
        <= 3
    )


@pytest.mark.parametrize("name", ["clip on a group", "gradient on a group", "transparent group", "holes"])
def test_far_from_what_moved_no_pixel_changes(name):
    vector = open_svg(FEATURES[name], size=240)
    moved = render(vector.scene, shift(vector, s1=(1000.0, 0.0)), range(len(vector.members)))
    x0, y0, x1, y1 = vector.scene.segments[0].box
    far = np.ones(moved.shape[:2], bool)
    far[max(int(y0) - 2, 0) : int(y1) + 3, max(int(x0) - 2, 0) : int(x1) + 3] = False
    assert np.array_equal(moved[far], vector.scene.image[far])


def test_hidden_parts_come_to_light():
    data = svg('<rect id="card" x="2" y="2" width="12" height="12" fill="#c00"/>'
               '<rect id="cover" x="2" y="2" width="14" height="14" fill="#00c" opacity="0.999"/>'
               '<rect id="edge" x="1" y="5" width="1" height="9"/>')  # fmt: skip
    data = data.replace(b'x="2" y="2" width="14"', b'x="4" y="2" width="14"')
    vector = open_svg(data, size=240)
    out = render(vector.scene, shift(vector, s2=(0.0, 500.0)), range(3))
    assert (out[30:130, 30:130] == (204, 0, 0)).all()


def test_whole_pixel_shifts_are_exact():
    vector = open_svg(svg(BALL), size=240)
    out = render(vector.scene, shift(vector, s1=(-30.0, 20.0)), range(1))
    assert np.array_equal(out[20:, :-30], vector.scene.image[:-20, 30:])


def test_only_what_moved_gets_a_transform():
    data = svg(f"  {BOX}\n\t<!-- the ball -->\n{BALL}")
    text = written(data, s2=(10.0, -5.0))
    assert text == data.decode().replace("<circle", '<circle transform="translate(1 -0.5)"')


def test_an_old_transform_is_kept_behind_the_new_one():
    ball = BALL.replace("/>", " transform='rotate(30 16 8)'/>")
    text = written(svg(BOX + ball), s2=(20.0, 0.0))
    assert "transform='translate(2 0) rotate(30 16 8)'" in text


def test_motion_is_told_in_the_units_of_the_parent():
    data = svg(f'<g transform="rotate(90) scale(2)"><circle id="dot" cx="5" cy="-5" r="1"/></g>{BOX}')
    text = written(data, s1=(20.0, 0.0))
    assert '<circle transform="translate(0 -1)"' in text


def test_a_group_that_moves_as_one_gets_one_transform():
    cart = BOX.replace("crate", "path1") + BALL.replace("ball", "path2")
    data = svg(f'<g id="cart">{cart}</g><path id="road" d="M0 22h24v2H0z"/>')
    text = written(data, s1=(10.0, 0.0))
    assert text.count("transform=") == 1
    assert '<g transform="translate(1 0)" id="cart">' in text


def test_a_path_comes_apart_into_copies():
    data = svg('<path class="a" d="M2 2h4v4H2zM12 2h4v4h-4zm1 1v2h2v-2z" fill="#246" id="path1"/>')
    text = written(data, s2=(0.0, 30.0))
    assert text.count("<path") == 2
    assert text.count('id="path1"') == 1
    assert '<path class="a" d="M2 2h4v4H2z" fill="#246" id="path1"/>' in text
    assert '<path transform="translate(0 3)" class="a" d="M12 2h4v4h-4zM13 3v2h2v-2z" fill="#246"/>' in text
    both = written(data, s1=(0.0, 30.0), s2=(0.0, 30.0))
    assert both == data.decode().replace("<path", '<path transform="translate(0 3)"')


def test_what_is_used_elsewhere_is_moved_by_a_group_around_it():
    text = written(FEATURES["use of what is drawn"], s1=(10.0, 0.0))
    assert f'<g transform="translate(1 0)">{BALL}</g><use href="#ball" id="copy"' in text
    prefixed = FEATURES["prefix"].decode()
    moved = written(FEATURES["prefix"], s2=(10.0, 0.0))
    assert "<s:g transform" in moved
    assert len(moved) - len(prefixed) == len('<s:g transform="translate(1 0)"></s:g>')


def test_what_hardly_moves_does_not_move():
    assert written(svg(BOX + BALL), s1=(0.001, 0.0)) == svg(BOX + BALL).decode()


def test_transforms_that_make_no_sense_are_refused():
    vector = open_svg(svg(BOX + BALL), size=64)
    with pytest.raises(InputError, match="not finite"):
        write_svg(vector, shift(vector, s1=(np.nan, 0.0)))
    with pytest.raises(InputError, match="2 segments but 1 transforms"):
        write_svg(vector, shift(vector)[:1])
