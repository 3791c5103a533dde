"""Measure how well icons are segmented without a model, against the true segmentations of a benchmark.

python eval/segmentation.py eval/benchmark --sheet found.png
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import click
import numpy as np
from PIL import Image

from iconjax.errors import IconjaxError
from iconjax.evaluation.segmentation import SegmentationScore, score_segmentation
from iconjax.render.sheet import palette
from iconjax.scene.load import load_image, load_segmentation
from iconjax.scene.segment.builtin import background
from iconjax.scene.segment.choose import choose_segmenter

TILE = 200
COLUMNS = ("true", "found", "missing", "missing5", "unnamed", "mislabelled", "matched", "split")


@click.command(help=__doc__)
@click.argument("folder")
@click.option("--method", "methods", multiple=True, default=("auto",), show_default=True, help="Segmenter.")
@click.option("--size", type=click.IntRange(16, 4096), help="Larger side to which pictures are scaled first.")
@click.option("--cases", is_flag=True, help="Print a row for each case, too.")
@click.option("--only", metavar="FILE", help="File with ids of cases, one a line.")
@click.option("--sheet", metavar="PNG", help="Draw picture, truth and what was found.")
def main(
    folder: str, methods: tuple[str, ...], size: int | None, cases: bool, only: str | None, sheet: str | None
) -> None:
    wanted = set(Path(only).read_text("utf-8").split()) if only else None
    paths = [p.parent for p in sorted(Path(folder).glob("*/case.json")) if wanted is None or p.parent.name in wanted]
    print("| method | true | found | missing, r=20 | r=5 | labels to give | with a perfect namer | IoU > 0.7 | split |")
    print("| --- " + 8 * "| ---: " + "|")
    tiles = []
    for method in ("nothing", "ink", *methods):
        rows = []
        for path in paths:
            try:
                image, true = _case(path, size)
                found = _found(method, image)
            except IconjaxError as error:
                print(f"{path.name}: {error}", file=sys.stderr)
                continue
            rows.append((score_segmentation(found, true), score_segmentation(found, true, 5.0).missing))
            if cases and method in methods:
                print(_row(f"{method} {path.name}", rows[-1:]))
            if method == methods[0]:
                tiles.append((image, true, found))
        print(_row(f"**{method}**", rows))
    if sheet:
        _contact_sheet(tiles).save(sheet)


def _case(path: Path, size: int | None) -> tuple[np.ndarray, np.ndarray]:
    image, true = load_image(path / "image.png"), np.asarray(load_segmentation(path).mask)
    if size is None:
        return image, true
    factor = size / max(true.shape)
    shape = round(true.shape[1] * factor), round(true.shape[0] * factor)
    small = Image.fromarray(image).resize(shape, Image.Resampling.BOX if factor < 1 else Image.Resampling.BICUBIC)
    return np.asarray(small), np.asarray(Image.fromarray(true).resize(shape, Image.Resampling.NEAREST))


def _found(method: str, image: np.ndarray) -> np.ndarray:
    if method == "nothing":
        return np.zeros(image.shape[:2], np.int32)
    if method == "ink":  # what the picture itself shows: drawn or not
        away = np.abs(image.astype(float) - background(image.astype(np.float32))).max(2)
        return (away > 64).astype(np.int32)
    return np.asarray(choose_segmenter(method).segment(image).mask)


def _row(name: str, rows: Sequence[tuple[SegmentationScore, float]]) -> str:
    n = max(1, len(rows))
    scores = [score for score, _ in rows]
    total = {key: sum(getattr(s, key) for s in scores) for key in COLUMNS if key != "missing5"}
    share = total["matched"] / max(1, total["true"])
    cells = [
        f"{total['true'] / n:.1f}", f"{total['found'] / n:.1f}", f"{total['missing'] / n:.0f}",
        f"{sum(near for _, near in rows) / n:.0f}", f"{total['unnamed'] / n:.1f}", f"{total['mislabelled'] / n:.1f}",
        f"{share:.3f}", f"{total['split'] / n:.1f}",
    ]  # fmt: skip
    return "| " + " | ".join([name, *cells]) + " |"


def _contact_sheet(tiles: Sequence[tuple[np.ndarray, np.ndarray, np.ndarray]]) -> Image.Image:
    across = 3
    down = -(-len(tiles) // across)
    board = Image.new("RGB", (across * (3 * TILE + 10), down * (TILE + 8)), "grey")
    for k, (image, *masks) in enumerate(tiles):
        x, y = k % across * (3 * TILE + 10), k // across * (TILE + 8)
        board.paste(Image.fromarray(image).resize((TILE, TILE)), (x, y))
        for j, mask in enumerate(masks, 1):
            tints = np.vstack([np.full((1, 3), 255, np.uint8), palette(int(mask.max()))])
            board.paste(Image.fromarray(tints[mask]).resize((TILE, TILE), Image.Resampling.NEAREST), (x + j * TILE, y))
    return board


if __name__ == "__main__":
    main()
