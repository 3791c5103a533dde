"""Which elements make a segment, what it is called, and the scene that they make."""

from __future__ import annotations

import json

import numpy as np
import pytest
from svg_features import BALL, BOX, FEATURES, svg

from iconjax.errors import InputError
from iconjax.render.depth import depth_order
from iconjax.scene.colours import colour_word
from iconjax.scene.svg import open_svg
from iconjax.scene.svg.naming import tidy

LAMP = (
    '<g id="lamp"><path id="shade" d="M7 2h10l3 7H4z" fill="#d33"/>'
    '<path id="path12" d="M11 9h2v10h-2z" fill="#333"/></g>'
    '<g id="table"><path d="M2 19h20v2H2z" fill="#963"/><path d="M4 21h2v3H4z"/></g>'
)


def labels(data: bytes, **options) -> dict[int, str]:
    return dict(open_svg(data, size=96, **options).labels)


def test_a_labelled_group_is_one_segment_unless_something_in_it_is_labelled():
    vector = open_svg(svg(LAMP), size=96)
    assert vector.labels == {1: "Lamp:Shade", 2: "Lamp:Dark gray piece 2", 3: "Table"}
    assert vector.named == {1, 3}
    assert [item.node.tag for item in vector.members[2]] == ["path", "path"]
    opened = labels(svg(LAMP), open_groups=True)
    assert opened[3].startswith("Table:")
    assert len(opened) == 4


def test_a_group_around_everything_is_the_object_of_its_parts():
    assert labels(svg(f'<g id="robot">{BOX}{BALL}</g>')) == {1: "Robot:Crate", 2: "Robot:Ball"}
    inside = f'<g id="scene"><g id="robot">{BOX}{BALL}</g><path id="sun" d="M1 1h3v3z"/></g>'
    assert labels(svg(inside)) == {1: "Robot:Crate", 2: "Robot:Ball", 3: "Scene:Sun"}


@pytest.mark.parametrize(
    ("attributes", "name"),
    [
        ('inkscape:label="Left wheel" id="path88"', "Left wheel"),
        ('data-name="door_knob" id="SVGID_1_"', "Door knob"),
        ('id="frontWheel"', "Front Wheel"),
        ('id="Car_x3A_Wheel"', "Car:Wheel"),
        ('inkscape:label="Car:Wheel"', "Car:Wheel"),
        ('class="st0 wheel"', "Wheel"),
        ('id="Layer_1" class="cls-1"', ""),
        ('id="path1234-5"', ""),
        ('id="Rectangle 12 Copy 3"', ""),
        ('id="IconifyId17ecdb2904d178eab8626"', ""),
        ('id="b5d3c9e2-7f1a-4c1b-9b0e-0f5e2a1d3c4b"', ""),
        ('id="x"', ""),
    ],
)
def test_names_of_people_count_and_those_of_programs_do_not(attributes, name):
    space = 'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
    vector = open_svg(
        svg(f'<circle {space} {attributes} cx="16" cy="8" r="4" fill="red"/><path d="M1 1h5v3z"/>'), size=64
    )
    assert vector.labels[1] == (name or "Red circle 1")
    assert (1 in vector.named) == bool(name)


def test_a_title_names_its_element():
    assert labels(svg('<g><title>Moon\nand stars</title><path d="M3 3h9v9z"/></g>' + BOX))[1] == "Moon and stars"


def test_what_is_used_names_its_use():
    wheels = '<symbol id="wheel"><circle cx="3" cy="3" r="3"/></symbol><use href="#wheel"/><use href="#wheel" x="12"/>'
    vector = open_svg(svg(wheels), size=64)
    assert vector.scene.names == ("Wheel #1", "Wheel #2")


@pytest.mark.parametrize(
    ("colour", "word"),
    [((230, 30, 40), "Red"), ((250, 210, 60), "Yellow"), ((30, 90, 200), "Blue"), ((110, 70, 40), "Brown"),
     ((250, 250, 250), "White"), ((10, 10, 12), "Black"), ((60, 160, 70), "Green"), ((245, 150, 40), "Orange")],
)  # fmt: skip
def test_colours_have_plain_names(colour, word):
    assert colour_word(np.array(colour, float)) == word


def test_names_hold_nothing_that_breaks_a_program():
    assert tidy('a "big"\\ ball\x07') == "A big ball"
    assert tidy("a:b:c") == "" or tidy("one:two:three") == "One:Two three"


def test_separate_outlines_are_segments_and_holes_stay():
    vector = open_svg(FEATURES["holes"], size=96)
    assert len(vector.members) == 4
    assert [members[0].outlines for members in vector.members] == [(0, 1), (2, 3), (0, 1), (2,)]
    assert len(labels(FEATURES["holes"], split_paths=False)) == 2
    assert labels(svg('<path id="eyes" d="M2 2h4v4H2zM12 2h4v4h-4z"/>' + BALL)) == {1: "Eyes", 2: "Ball"}


def test_small_unlabelled_things_join_what_they_lie_on():
    face = '<circle cx="12" cy="12" r="10" fill="#fc3"/>'
    spot = '<circle cx="9" cy="9" r="0.8" fill="#fff"/>'
    shade = '<path d="M12 2a10 10 0 010 20z" fill="#f4b52c"/>'
    ring = '<circle cx="12" cy="12" r="10" fill="none" stroke="#222"/>'
    hat = '<path d="M4 1h16v6H4z" fill="#28c"/>'
    assert labels(svg(face + spot + shade + ring + hat)) == {1: "Yellow circle 1", 2: "Blue piece 2"}
    assert len(labels(svg(face + spot + shade + ring + hat), join_details=False)) == 5
    named = labels(svg(face + spot.replace("<circle", '<circle id="dimple"') + hat))
    assert named == {1: "Yellow circle 1", 2: "Dimple", 3: "Blue piece 3"}


def test_small_things_stay_apart_where_nothing_else_would_be_left():
    face = '<circle cx="12" cy="12" r="10" fill="#fc3"/><circle cx="9" cy="9" r="0.8"/><circle cx="15" cy="9" r="0.8"/>'
    assert len(labels(svg(face))) == 3


def test_what_covers_the_picture_is_background():
    vector = open_svg(FEATURES["background"], size=96)
    assert vector.scene.names == ("Crate", "Ball")
    assert [item.node.tag for item in vector.still] == ["rect"]
    assert tuple(vector.scene.background) == (255, 238, 136)
    assert vector.scene.layers[0].segment is None


def test_geometry_is_that_of_whole_elements():
    data = svg('<rect id="card" x="2" y="2" width="20" height="10" fill="#fff" stroke="#000" stroke-width="2"/>'
               '<rect id="cover" x="10" y="0" width="14" height="24" fill="#36c"/>')  # fmt: skip
    vector = open_svg(data, size=240)
    card, cover = vector.scene.segments
    assert np.allclose(card.box, (10, 10, 230, 130), atol=0.6)
    assert abs(card.area - 220 * 120) < 200
    assert not (card.mask & cover.mask).any()
    assert card.mask[:, 101:].sum() == 0


def test_geometry_reaches_beyond_the_picture():
    sun = open_svg(FEATURES["beyond the picture"], size=240).scene.segments[0]
    assert np.allclose(sun.box, (-60, -60, 100, 100), atol=1.0)
    assert sun.mask.any()


def test_paint_order_is_the_depth():
    scene = open_svg(svg(BALL + BOX + '<path id="band" d="M0 13h24v3H0z"/>'), size=96).scene
    assert scene.names == ("Ball", "Crate", "Band")
    assert depth_order(scene).order == (0, 1, 2)


def test_labels_come_from_outside_by_number(tmp_path):
    path = tmp_path / "labels.json"
    path.write_text(json.dumps({"labels": {"1": "Box:Lid", "2": ""}}), "utf-8")
    vector = open_svg(svg(BOX + BALL), path, size=64)
    assert vector.scene.names == ("Box:Lid", "Ball")
    assert vector.named == {1, 2}
    assert open_svg(svg(BOX + BALL), {2: "Sun", 1: None}, size=64).scene.names == ("Crate", "Sun")
    with pytest.raises(InputError, match="segments 1 to 2 only"):
        open_svg(svg(BOX + BALL), {3: "Moon"}, size=64)


def test_numbers_depend_on_the_file_alone():
    first, second = (open_svg(svg(LAMP), names, size=96) for names in (None, {1: "A", 2: "B", 3: "C"}))
    assert [s.id for s in first.scene.segments] == [s.id for s in second.scene.segments]
    assert all(np.array_equal(a.mask, b.mask) for a, b in zip(first.scene.segments, second.scene.segments, strict=True))


@pytest.mark.parametrize(
    ("body", "note"),
    [
        ('<text x="3" y="9">hi</text>', "text (not drawn)"),
        ('<image href="a.png" width="3" height="3"/>', "embedded images (not drawn)"),
        ('<g style="transform:rotate(9deg)"><path d="M1 1h5v3z"/></g>', "css transforms"),
        ('<path transform="rotate(9)" transform-origin="3 3" d="M1 1h5v3z"/>', "transform-origin"),
        ('<g opacity=".5"><path d="M1 1h5v3z"/><path d="M1 9h5v3z"/></g>', "a group with opacity (kept as one)"),
        ('<filter id="f"><feGaussianBlur stdDeviation="1"/></filter><path filter="url(#f)" d="M1 1h5v3z"/>', "filters"),
        ('<g vector-effect="non-scaling-stroke"><path d="M1 1h5v3z"/></g>', "vector effects"),
        ('<path d="M0 0h24v24H0z" fill="#fa3"/><path style="mix-blend-mode:difference" d="M2 1h9v12z"/>', "blending"),
        ("<style>a:hover{fill:red}</style>", "css selector 'a:hover'"),
    ],
)
def test_what_is_not_handled_is_named(body, note):
    notes = open_svg(svg(body + BOX + BALL), size=96).notes
    assert len(notes) == 1
    assert note in notes[0]
    assert open_svg(svg(BOX + BALL), size=96).notes == ()


def test_what_cannot_be_moved_rightly_stays():
    vector = open_svg(svg(f'<g style="transform:rotate(9deg)">{BOX}</g>{BALL}'), size=96)
    assert vector.scene.names == ("Ball",)
    assert [item.node.get("id") for item in vector.still] == ["crate"]


def test_a_segment_painted_in_several_goes_has_the_depth_of_its_largest_layer():
    face = '<circle cx="12" cy="13" r="9" fill="#fc3"/><path id="hat" d="M4 1h16v6H4z" fill="#28c"/>'
    outline = '<circle cx="12" cy="13" r="9" fill="none" stroke="#222"/>'
    scene = open_svg(svg(face + outline), size=96).scene
    assert [layer.segment for layer in scene.layers] == [0, 1, 0]
    assert depth_order(scene).order == (0, 1)


def test_ids_in_which_a_program_counts_by_letters_are_no_names():
    def row(*ids: str) -> bytes:
        return svg("".join(f'<rect id="{k}" x="{6 * n}" y="2" width="4" height="5"/>' for n, k in enumerate(ids)))

    counted = labels(row("anvil-outline-a", "anvil-outline-b", "anvil-outline-Z", "anvil-outline-aa"))
    assert all(name == f"Black rectangle {k}" for k, name in counted.items())
    assert labels(row("leg-l", "leg-r")) == {1: "Leg l", 2: "Leg r"}
    mixed = labels(row("wheel-a", "wheel-b", "wheel-c", "cab", "boiler", "funnel"))
    assert mixed[1] == "Wheel a" and mixed[4] == "Cab"


def test_pieces_without_a_name_carry_their_own_number():
    dots = "".join(f'<circle cx="{4 + 7 * k}" cy="18" r="2" fill="#2060e0"/>' for k in range(3))
    found = labels(svg(f"{dots}{BOX}"))
    assert {found[k] for k in (1, 2, 3)} == {"Blue circle 1", "Blue circle 2", "Blue circle 3"}
    assert open_svg(svg(f"{dots}{BOX}"), size=96).scene.names[1] == "Blue circle 2"


@pytest.mark.parametrize(
    "moving",
    [
        '<style>@keyframes spin{to{transform:rotate(1turn)}}</style><rect width="9" height="9"/>',
        '<rect width="9" height="9"><animateTransform attributeName="transform" type="rotate" to="9"/></rect>',
    ],
)
def test_an_animated_transform_is_said_to_override_the_edit(moving):
    said = "animations of transform (in a browser they override the edit of what they move)"
    assert said in open_svg(svg(moving), size=48).notes[0]
    calm = moving.replace("transform:rotate(1turn)", "fill:red").replace("<animateTransform", '<set additive="sum"')
    assert not any(said in note for note in open_svg(svg(calm), size=48).notes)
