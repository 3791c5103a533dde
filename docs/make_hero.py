"""Build docs/images/hero.png: edits of benchmark cases, before and after, as the engine makes them now.

Run in the root of the repository: python docs/make_hero.py [CASE ...]
"""

from __future__ import annotations

import sys
from pathlib import Path
from textwrap import wrap

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from iconjax import EditResult, edit

ROOT = Path(__file__).parents[1]
CASES = (
    "trophy-cup-base",
    "ferris-wheel-turn",
    "pot-halved",
    "excavator-boom",
    "cake-sponge-half",
    "bathtub-shower",
)
SCALE = 2  # drawn at twice the size it is shown at
COLUMNS, ICON, GAP, TEXT, MARGIN = 3, 200, 28, 62, 26
INK, SOFT, LINE = "#1d2330", "#98a2b3", "#e4e7ec"


def panel(result: EditResult) -> Image.Image:
    """One edit: before, an arrow, after, and the request below."""
    width, height = (2 * ICON + 3 * GAP), ICON + TEXT + 2 * GAP
    sheet = Image.new("RGB", (width * SCALE, height * SCALE), "white")
    draw = ImageDraw.Draw(sheet)
    box = (1, 1, width * SCALE - 2, height * SCALE - 2)
    draw.rounded_rectangle(box, 14 * SCALE, outline=LINE, width=SCALE)
    for k, image in enumerate((result.scene.image, result.image)):
        icon = fit(image, ICON * SCALE)
        left = (GAP + k * (ICON + GAP)) * SCALE + (ICON * SCALE - icon.width) // 2
        sheet.paste(icon, (left, GAP * SCALE + (ICON * SCALE - icon.height) // 2))
    arrow(draw, (1.5 * GAP + ICON) * SCALE, (GAP + ICON / 2) * SCALE)
    font = ImageFont.load_default(size=15 * SCALE)
    for i, line in enumerate(balanced(result.request, 56)[:3]):
        y = (GAP + ICON + 18 + 20 * i) * SCALE
        draw.text((width * SCALE / 2, y), line, fill=INK, font=font, anchor="ma")
    return sheet


def balanced(text: str, width: int) -> list[str]:
    """As few lines as `width` allows, of about the same length."""
    count = len(wrap(text, width))
    return next(lines for w in range(1, width + 1) if len(lines := wrap(text, w)) <= count)


def fit(image: np.ndarray, side: int) -> Image.Image:
    """The picture, its larger side `side`."""
    picture = Image.fromarray(image)
    factor = side / max(picture.size)
    return picture.resize([round(v * factor) for v in picture.size], Image.Resampling.LANCZOS)


def arrow(draw: ImageDraw.ImageDraw, x: float, y: float) -> None:
    """A small arrow to the right, centred at (x, y)."""
    r = 7 * SCALE
    draw.line([(x - r, y), (x + r, y)], fill=SOFT, width=2 * SCALE)
    draw.line(
        [(x + r / 3, y - r / 1.5), (x + r, y), (x + r / 3, y + r / 1.5)],
        fill=SOFT,
        width=2 * SCALE,
        joint="curve",
    )


def main(names: list[str]) -> None:
    """Edit the cases and lay the panels out in rows."""
    results = [edit(ROOT / "eval" / "benchmark" / name) for name in names]
    for name, result in zip(names, results, strict=True):
        print(f"{name}: {'all constraints hold' if result.satisfied else 'MISSED'}")
    panels = [panel(result) for result in results]
    width, height = panels[0].size
    gap = MARGIN * SCALE
    rows = -(-len(panels) // COLUMNS)
    columns = min(COLUMNS, len(panels))
    size = (columns * width + (columns + 1) * gap, rows * height + (rows + 1) * gap)
    sheet = Image.new("RGB", size, "white")
    for k, image in enumerate(panels):
        row, column = divmod(k, COLUMNS)
        sheet.paste(image, (gap + column * (width + gap), gap + row * (height + gap)))
    target = ROOT / "docs" / "images" / "hero.png"
    target.parent.mkdir(exist_ok=True)
    sheet.quantize(256, dither=Image.Dither.NONE).save(target, optimize=True)
    print(target)


if __name__ == "__main__":
    main(sys.argv[1:] or list(CASES))
