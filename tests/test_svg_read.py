"""Reading SVG text: every byte accounted for, numbers as the standard has them."""

from __future__ import annotations

import gzip
import re
from pathlib import Path

import numpy as np
import pytest
from svg_features import BALL, BOX, FEATURES, svg

from iconjax.errors import InputError
from iconjax.render.svg import write_svg
from iconjax.scene.svg import open_svg
from iconjax.scene.svg.numbers import Viewport, transform, write_matrix
from iconjax.scene.svg.pathdata import pieces, subpaths
from iconjax.scene.svg.source import read_source
from iconjax.scene.svg.styles import Styles
from iconjax.scene.svg.tags import prepend_value, set_attribute
from iconjax.scene.svg.tree import parse_tree

ICONS = sorted((Path(__file__).parent.parent / "eval" / "benchmark").glob("*/icon.svg"))
TEXT = svg(BOX + "<!-- é -->" + BALL).decode()
HEAD = '<?xml version="1.0" encoding="{}"?>\n<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "svg11.dtd">\n'
VARIANTS = {
    "byte order mark": b"\xef\xbb\xbf" + TEXT.encode(),
    "windows line ends": TEXT.replace("\n", "\r\n").encode(),
    "old line ends": TEXT.replace("\n", "\r").encode(),
    "declaration, doctype and comment": (HEAD.format("utf-8") + "<!-- > -->" + TEXT + "<!-- end -->\n\n").encode(),
    "latin-1": (HEAD.format("ISO-8859-1") + TEXT).encode("latin-1"),
    "windows-1252": (HEAD.format("windows-1252") + TEXT).encode("cp1252"),
    "UTF-16": TEXT.encode("utf-16"),
    "UTF-16, big end first": b"\xfe\xff" + (HEAD.format("UTF-16") + TEXT).encode("utf-16-be"),
    "tabs in tags": TEXT.replace(' id="', '\t\n id = "').encode(),
    "cdata": TEXT.replace(BOX, f"<style><![CDATA[ .a > .b{{}} ]]></style>{BOX}").encode(),
}


def still(vector) -> np.ndarray:
    return np.tile(np.eye(2, 3), (len(vector.members), 1, 1))


@pytest.mark.parametrize("name", VARIANTS)
def test_bytes_come_back_and_only_the_edit_differs(name):
    data = VARIANTS[name]
    vector = open_svg(data, size=64)
    assert write_svg(vector, still(vector)) == data
    matrices = still(vector)
    matrices[1, :, 2] = (5.0, 0.0)
    out = write_svg(vector, matrices)
    source = read_source(data)
    mark = re.escape(' transform="translate(1.875 0)"').encode()
    assert re.sub(mark, b"", read_source(out).text) == source.text
    assert len(re.findall(mark, read_source(out).text)) == 1
    assert open_svg(out, size=64).labels == vector.labels


@pytest.mark.parametrize("path", ICONS[::6], ids=lambda path: path.parent.name)
def test_real_icons_come_back(path):
    vector = open_svg(path, size=96)
    assert write_svg(vector, still(vector)) == path.read_bytes()


def test_a_compressed_file_is_read(tmp_path):
    path = tmp_path / "icon.svgz"
    path.write_bytes(gzip.compress(svg(BOX)))
    assert open_svg(path, size=64).labels == {1: "Crate"}


def test_places_of_elements_are_exact():
    source = read_source("\ufeff".encode() + svg(f"<!-- <g> --><g title='a > b'>{BOX}<g/></g>\u00e9"))
    root = parse_tree(source)
    texts = {node.tag: source.text[node.start : node.end] for node in root.walk()}
    assert texts["rect"] == BOX.encode()
    assert texts["svg"] == source.text.strip()
    outer = next(node for node in root.walk() if node.get("title"))
    assert source.text[outer.start : outer.inner] == b"<g title='a > b'>"
    assert source.text[outer.close : outer.end] == b"</g>"


def test_transform_lists_follow_the_grammar():
    turned = transform("translate(3,4)rotate( 90 ) , scale(2)")
    assert np.allclose(turned, [[0, -2, 3], [2, 0, 4]])
    assert np.allclose(transform("rotate(90 1 2)"), [[0, -1, 3], [1, 0, 1]])
    assert np.allclose(transform("matrix(1-2.5.5 4,5 6)"), [[1, 0.5, 5], [-2.5, 4, 6]])
    assert np.allclose(transform("skewX(45)"), [[1, 1, 0], [0, 1, 0]])
    for bad in (
        "rotate(1turn)",
        "rotate(1 2)",
        "scale()",
        "translate(1 2 3)",
        "spin(3)",
        "rotate(1) x",
        "matrix(1 2 3)",
    ):
        assert transform(bad) is None


def test_written_matrices_are_read_as_they_were():
    rng = np.random.default_rng(0)
    for _ in range(50):
        matrix = rng.normal(size=(2, 3)) * np.array([1.0, 1.0, 100.0])
        assert np.abs(transform(write_matrix(matrix)) - matrix).max() < 1e-5
    assert write_matrix(np.array([[1.0, 0.0, 2.5], [0.0, 1.0, -1e-12]])) == "translate(2.5 0)"


@pytest.mark.parametrize(
    ("attributes", "raster", "point", "lands"),
    [
        ('viewBox="0 0 24 24"', (240, 240), (12, 6), (120, 60)),
        ('viewBox="-10 -10 20 20" width="2in" height="1in"', (240, 120), (0, 0), (120, 60)),
        ('viewBox="0 0 10 10" width="20" height="10" preserveAspectRatio="xMinYMid"', (240, 120), (10, 5), (120, 60)),
        ('viewBox="0 0 10 10" width="20" height="10" preserveAspectRatio="none"', (240, 120), (10, 5), (240, 60)),
        ('viewBox="0 0 10 10" width="2" height="1" preserveAspectRatio="xMidYMax slice"', (240, 120), (5, 5), (120, 0)),
        ('width="10cm" height="5cm"', (240, 120), (0, 0), (0, 0)),
        ('viewBox="0 0 30 10" width="100%"', (240, 80), (30, 10), (240, 80)),
    ],
)  # fmt: skip
def test_view_boxes(attributes, raster, point, lands):
    view = Viewport(parse_tree(read_source(svg("", attributes))), 240, "it")
    assert view.raster == raster
    assert np.allclose(view.matrix[:, :2] @ point + view.matrix[:, 2], lands)


def test_the_cascade():
    root = parse_tree(read_source(svg(
        "<style>g rect{opacity:.5} .a{opacity:.6} #x{opacity:.7!important} rect.a{fill-rule:evenodd} @media print{}"
        " p:hover{}</style>"
        '<g stroke="red" opacity=".1"><rect class="a" opacity=".2"/>'
        '<rect id="x" style="opacity:.9"/></g>')))  # fmt: skip
    styles = Styles(root)
    one, two = (node for node in root.walk() if node.tag == "rect")
    assert styles.value(one, "opacity") == ".6"
    assert styles.value(two, "opacity") == ".7"
    assert styles.value(one, "fill-rule") == "evenodd"
    assert styles.value(two, "stroke") == "red"
    assert styles.value(two, "fill") == ""
    assert styles.unread == ["css @media", "css selector 'p:hover'"]


def test_outlines_of_a_path_stand_alone():
    texts = [part.text for part in subpaths("m1 1 2 0 0 2zm10 0h2v2h-2z l 3 3M5-5a1 1 0 01.5.5")]
    assert texts == ["M1 1l 2 0 0 2z", "M11 1h2v2h-2z", "M11 1 l 3 3", "M5 -5a1 1 0 01.5.5"]
    assert subpaths("M0 0L1") == ()
    assert subpaths("L1 1") == ()


def test_holes_stay_with_what_they_are_cut_from():
    ring, hole, dot = "M0 0h10v10H0z", "M2 2h6v6H2z", "M4 4h2v2H4z"
    back = "M2 2v6h6V2z"
    far = "M20 0h5v5h-5z"
    assert pieces(ring + hole + dot + far, "evenodd") == [(0, 1), (2,), (3,)]
    assert pieces(ring + back + dot + far, "nonzero") == [(0, 1), (2,), (3,)]
    assert pieces(ring + hole + dot + far, "nonzero") == [(0, 1, 2), (3,)]
    assert pieces(far + "M22 2h9v9h-9z") == [(0, 1)]
    assert pieces("M0 0h9M0 3h9", filled=False, stroke=1) == [(0,), (1,)]
    assert pieces("M0 0h9M0 3h9", filled=False, stroke=4) == [(0, 1)]


def test_attributes_are_set_in_place():
    tag = b"<path  d='M0 0'\n fill=\"a&amp;b\"/>"
    assert set_attribute(tag, "d", "M1 1'") == b"<path  d='M1 1&apos;'\n fill=\"a&amp;b\"/>"
    assert set_attribute(tag, "id", 'x"') == b'<path id="x&quot;"  d=\'M0 0\'\n fill="a&amp;b"/>'
    assert prepend_value(b'<g transform="rotate(3)">', "transform", "scale(2)") == b'<g transform="scale(2) rotate(3)">'
    assert prepend_value(b"<g/>", "transform", "scale(2)") == b'<g transform="scale(2)"/>'


@pytest.mark.parametrize("size", [0, 8, 100_000])
def test_the_raster_is_of_a_sane_size(size):
    with pytest.raises(InputError, match="size is"):
        open_svg(FEATURES["plain"], size=size)


def test_a_missing_file_is_one_clear_line(tmp_path):
    with pytest.raises(InputError, match="does not exist"):
        open_svg(tmp_path / "none.svg")
    with pytest.raises(InputError, match="is a folder"):
        open_svg(tmp_path)
