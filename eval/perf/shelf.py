"""An icon of 40 segments: a shelf of three boards with things on it, drawn from a list of plain shapes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import UInt8, UInt16
from PIL import Image, ImageDraw

SIZE, FINE = 512, 4


@dataclass(frozen=True)
class Shape:
    """One segment. `points`: corners of a polygon, or, when there are two, of the box of an ellipse."""

    name: str
    colour: str
    points: tuple[tuple[float, float], ...]


def box(name: str, colour: str, x: float, y: float, width: float, height: float) -> Shape:
    """A rectangle."""
    return Shape(name, colour, ((x, y), (x + width, y), (x + width, y + height), (x, y + height)))


def disc(name: str, colour: str, x: float, y: float, rx: float, ry: float | None = None) -> Shape:
    """An ellipse about (x, y)."""
    ry = rx if ry is None else ry
    return Shape(name, colour, ((x - rx, y - ry), (x + rx, y + ry)))


def shelf() -> list[Shape]:
    """All segments, back to front."""
    wood, dark = "#B9814A", "#8D5A2B"
    shapes = [
        box("Shelf:Left Post", dark, 56, 60, 20, 412),
        box("Shelf:Right Post", dark, 436, 60, 20, 412),
        *(
            box(f"Shelf:{n} Board", wood, 76, y, 360, 14)
            for n, y in zip(("Upper", "Middle", "Lower"), (170, 300, 430), strict=True)
        ),
        Shape("Shelf:Crown", wood, ((48, 60), (72, 40), (440, 40), (464, 60))),
        box("Shelf:Left Foot", "#5B3A1C", 52, 472, 28, 14),
        box("Shelf:Right Foot", "#5B3A1C", 432, 472, 28, 14),
    ]
    x = 90.0
    colours = ("#D64545", "#3B7DD8", "#3FA66B", "#E8A838", "#7D5BBE", "#D86C9B")
    for k, (width, height) in enumerate(((18, 84), (16, 74), (22, 90), (16, 70), (20, 82), (18, 78))):
        shapes.append(box(f"Books:Book {k + 1}", colours[k], x, 170 - height, width, height))
        x += width
    shapes += [
        box("Plant:Pot", "#C8643C", 238, 138, 48, 32),
        box("Plant:Rim", "#A94F2C", 234, 128, 56, 10),
        box("Plant:Stem", "#4C8C3F", 259, 98, 6, 30),
        disc("Plant:Left Leaf", "#57B04A", 246, 94, 15, 8),
        disc("Plant:Right Leaf", "#57B04A", 278, 94, 15, 8),
        disc("Plant:Flower", "#F2C230", 262, 86, 10),
        box("Radio:Body", "#4A5A6A", 318, 112, 104, 58),
        disc("Radio:Speaker", "#22303C", 346, 141, 20),
        disc("Radio:Knob", "#E6E9EC", 394, 152, 9),
        box("Radio:Display", "#9AD7E8", 376, 120, 36, 18),
        box("Radio:Antenna", "#8895A1", 408, 74, 4, 38),
        box("Clock:Foot", "#6B4A8A", 96, 288, 64, 12),
        disc("Clock:Case", "#8A63B0", 128, 246, 42),
        disc("Clock:Dial", "#FBF7EC", 128, 246, 32),
        box("Clock:Minute Hand", "#333333", 126, 220, 4, 28),
        box("Clock:Hour Hand", "#333333", 128, 244, 20, 4),
        box("Vase:Body", "#2FA5A0", 206, 244, 44, 56),
        box("Vase:Neck", "#23827E", 218, 224, 20, 20),
        disc("Globe:Ball", "#4C9BE0", 388, 244, 36),
        disc("Globe:Land", "#6FBF5A", 378, 236, 16, 12),
        box("Globe:Pole", "#8D8D8D", 385, 280, 6, 10),
        box("Globe:Base", "#6E6E6E", 364, 290, 48, 10),
        box("Chest:Box", "#A9713B", 96, 374, 120, 56),
        box("Chest:Lid", "#8A5728", 92, 358, 128, 16),
        disc("Chest:Lock", "#F0C24B", 156, 392, 8),
        disc("Ball", "#E2533F", 300, 404, 26),
    ]  # fmt: skip
    return shapes


def draw(shapes: list[Shape]) -> tuple[UInt8[np.ndarray, "H W 3"], UInt16[np.ndarray, "H W"]]:
    """The picture (smoothed) and the label map: shape k is segment k + 1."""
    picture = Image.new("RGB", (SIZE * FINE, SIZE * FINE), "white")
    labels = Image.new("I", (SIZE, SIZE), 0)
    for k, shape in enumerate(shapes):
        for canvas, scale, fill in ((picture, FINE, shape.colour), (labels, 1, k + 1)):
            # Pillow's right and bottom corners are inclusive pixels.
            points = [(x * scale, y * scale) for x, y in shape.points]
            if len(points) == 4 and points[0][1] == points[1][1] and points[0][0] == points[3][0]:
                (x0, y0), (x1, y1) = points[0], points[2]
                ImageDraw.Draw(canvas).rectangle((x0, y0, x1 - 1, y1 - 1), fill=fill)
            elif len(points) == 2:
                (x0, y0), (x1, y1) = points
                ImageDraw.Draw(canvas).ellipse((x0, y0, x1 - 1, y1 - 1), fill=fill)
            else:
                ImageDraw.Draw(canvas).polygon(points, fill=fill)
    smooth = picture.resize((SIZE, SIZE), Image.Resampling.BOX)
    return np.asarray(smooth), np.asarray(labels).astype(np.uint16)
