"""Icons as ordered drawable pieces: the elements of an SVG, and the subpaths of its filled paths.

A piece is named "3" (element 3 in paint order) or "3.1" (subpath 1 of element 3).
"""

from __future__ import annotations

import io
import json
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import resvg_py
from fontTools.pens.recordingPen import RecordingPen
from fontTools.svgLib.path import parse_path
from PIL import Image

SIZE = 512
NS = "{http://www.w3.org/2000/svg}"
INK = "#222222"
SHAPES = ("path", "rect", "circle", "ellipse", "line", "polygon", "polyline")
Matrix = Sequence[Sequence[float]]


@dataclass(frozen=True)
class Element:
    """A drawable element: its own tag and attributes, and those of the groups around it (outermost first)."""

    tag: str
    attributes: Mapping[str, str]
    groups: tuple[Mapping[str, str], ...]
    subpaths: tuple[str, ...]

    def svg(self, chosen: Sequence[int] | None = None) -> str:
        """Markup of the element, or of some subpaths of it."""
        own = dict(self.attributes)
        if chosen is not None:
            own["d"] = " ".join(self.subpaths[k] for k in chosen)
        text = _tag(self.tag, own, close=True)
        for group in reversed(self.groups):
            text = f"{_tag('g', group)}{text}</g>"
        return text


@dataclass(frozen=True)
class Icon:
    """An icon: view box, definitions, elements in paint order."""

    source: str
    box: tuple[float, float, float, float]
    defs: str
    elements: tuple[Element, ...]
    text: str

    def draw(self, pieces: Sequence[str]) -> Image.Image:
        """Render markup on a transparent picture."""
        data = resvg_py.svg_to_bytes(svg_string=self._page("".join(pieces)), width=SIZE, height=SIZE)
        return Image.open(io.BytesIO(bytes(data))).convert("RGBA")

    def moved(self, markup: str, matrix: Matrix) -> str:
        """Markup under a transform given in pixels of the picture."""
        (a, b, c), (d, e, f) = matrix
        left, top, width, height = self.box
        sx, sy = SIZE / width, SIZE / height
        to_px = np.array([[sx, 0, -left * sx], [0, sy, -top * sy], [0, 0, 1]])
        m = np.linalg.inv(to_px) @ np.array([[a, b, c], [d, e, f], [0, 0, 1]]) @ to_px
        values = [m[0, 0], m[1, 0], m[0, 1], m[1, 1], m[0, 2], m[1, 2]]
        return f'<g transform="matrix({" ".join(f"{v:.9g}" for v in values)})">{markup}</g>'

    def _page(self, body: str) -> str:
        box = " ".join(f"{v:g}" for v in self.box)
        head = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
        return f'<svg {head} viewBox="{box}">{self.defs}{body}</svg>'


def load_icon(packages: Path, source: str) -> Icon:
    """Read an icon "set:name" from the installed packages; black ones are drawn in `INK`."""
    folder, name = source.split(":")
    data = json.loads((packages / folder / "icons.json").read_text(encoding="utf-8"))
    record = data["icons"][name]
    width = record.get("width", data.get("width", 16))
    height = record.get("height", data.get("height", 16))
    box = (record.get("left", 0), record.get("top", 0), width, height)
    body = record["body"].replace("currentColor", INK)
    shown = " ".join(f"{v:g}" for v in box)
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{shown}">{body}</svg>'
    root = ET.fromstring(text.replace("<svg ", '<svg xmlns:xlink="http://www.w3.org/1999/xlink" ', 1))
    ET.register_namespace("", NS[1:-1])
    defs: list[str] = []
    elements: list[Element] = []

    def walk(node: ET.Element, groups: tuple[Mapping[str, str], ...]) -> None:
        for child in node:
            tag = child.tag.removeprefix(NS)
            if tag == "g":
                walk(child, (*groups, dict(child.attrib)))
            elif tag in SHAPES:
                elements.append(Element(tag, dict(child.attrib), groups, _subpaths(child)))
            else:
                defs.append(ET.tostring(child, encoding="unicode"))

    walk(root, ())
    return Icon(source, box, "".join(defs), tuple(elements), text)


def _subpaths(node: ET.Element) -> tuple[str, ...]:
    if not node.tag.endswith("path"):
        return ()
    pen = RecordingPen()
    parse_path(node.attrib["d"], pen)
    out: list[str] = []
    letters = {"moveTo": "M", "lineTo": "L", "curveTo": "C", "qCurveTo": "Q", "closePath": "Z", "endPath": ""}
    for name, points in pen.value:
        if name == "moveTo":
            out.append("")
        out[-1] += letters[name] + " ".join(f"{x:.6g} {y:.6g}" for x, y in points)
    return tuple(p for p in out if len(p) > 0)


def _tag(name: str, attributes: Mapping[str, str], close: bool = False) -> str:
    text = "".join(f' {k.removeprefix(NS)}="{v}"' for k, v in attributes.items())
    return f"<{name}{text}{'/' if close else ''}>"
