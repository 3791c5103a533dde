"""Pictures to segment, drawn with anti-aliased edges by shrinking a larger drawing."""

from __future__ import annotations

import numpy as np
from PIL import Image, ImageDraw

OVERSIZE = 4


def draw(*shapes: tuple[str, tuple[float, ...], str], size: int = 128, back: str | None = "white") -> Image.Image:
    """Shapes as (kind, coordinates in pixels, colour), kind one of ellipse, rectangle, polygon, line3 (width 3)."""
    mode = "RGB" if back else "RGBA"
    big = Image.new(mode, (size * OVERSIZE, size * OVERSIZE), back or (0, 0, 0, 0))
    pen = ImageDraw.Draw(big)
    for kind, at, colour in shapes:
        points = [OVERSIZE * v for v in at]
        if kind.startswith("line"):
            pen.line(points, fill=colour, width=OVERSIZE * int(kind[4:]))
        else:
            getattr(pen, kind)(points, fill=colour)
    return big.resize((size, size), Image.Resampling.BOX)


def array(picture: Image.Image) -> np.ndarray:
    return np.asarray(picture.convert("RGB"))


def agreement(found: np.ndarray, true: np.ndarray) -> float:
    """Best intersection over union of a found segment with the true mask."""
    return max(
        (
            np.count_nonzero((found == k) & true) / np.count_nonzero((found == k) | true)
            for k in range(1, found.max() + 1)
        ),
        default=0.0,
    )


BALL = ("ellipse", (20, 20, 60, 60), "#e02020")
BOX = ("rectangle", (60, 70, 110, 110), "#2060e0")
