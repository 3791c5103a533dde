"""Random edits of real icons: the written SVG, drawn by resvg, against our own drawing of the edit.

python eval/svg/parity.py node_modules --per-set 30 --out parity.json --worst DIR
"""

from __future__ import annotations

import argparse
import io
import json
import random
from collections import defaultdict
from pathlib import Path

import numpy as np
import resvg_py
from icons import sample
from PIL import Image

from iconjax.errors import IconjaxError
from iconjax.render.raster import render
from iconjax.render.svg import write_svg
from iconjax.scene.svg import open_svg


def drawn(data: bytes, width: int, height: int) -> np.ndarray:
    """An SVG on white, by resvg alone."""
    png = resvg_py.svg_to_bytes(
        svg_string=data.decode("utf-8-sig"),
        background="#ffffff",
        skip_system_fonts=True,
        dpi=96,
        width=width,
        height=height,
    )
    return np.asarray(Image.open(io.BytesIO(png)).convert("RGB"))


def motion(box: tuple[float, ...], size: int, rng: np.random.Generator) -> np.ndarray:
    """A turn, two factors and a shift about the middle of a box; each of the three is left out at times."""
    centre = np.array([(box[0] + box[2]) / 2, (box[1] + box[3]) / 2])
    angle = np.radians(rng.uniform(-90, 90)) * (rng.random() < 0.7)
    factors = np.exp(rng.uniform(-0.6, 0.6, 2)) if rng.random() < 0.7 else np.ones(2)
    linear = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]) @ np.diag(factors)
    return np.column_stack([linear, centre - linear @ centre + rng.uniform(-0.2, 0.2, 2) * size])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("modules", type=Path)
    parser.add_argument("--per-set", type=int, default=30)
    parser.add_argument("--seed", type=int, default=2)
    parser.add_argument("--out", type=Path, default=Path(__file__).parent / "parity.json")
    parser.add_argument("--worst", type=Path, help="folder for pictures of the worst ones")
    args = parser.parse_args()
    rows, worst = defaultdict(list), []
    for name, icon, data in sample(args.modules, args.per_set, args.seed):
        rng = np.random.default_rng(random.Random(f"{name}/{icon}").randrange(2**32))
        try:
            vector = open_svg(data)
        except IconjaxError as error:
            print(name, icon, error)
            continue
        scene = vector.scene
        matrices = np.tile(np.eye(2, 3), (len(scene.segments), 1, 1))
        for k in rng.permutation(len(matrices))[: max(1, len(matrices) // 3)]:
            matrices[k] = motion(scene.segments[k].box, scene.size, rng)
        ours = render(scene, matrices, range(len(matrices)))
        theirs = drawn(write_svg(vector, matrices), scene.width, scene.height)
        gap = np.abs(ours.astype(float) - theirs)
        still = np.abs(drawn(data, scene.width, scene.height).astype(float) - scene.image).mean()
        rows[name].append((gap.mean(), (gap.max(axis=-1) > 64).mean(), still))
        worst.append((float(gap.mean()), name, icon, list(vector.notes)))
        if args.worst is not None and (gap.mean() > 0.5 or (gap.max(axis=-1) > 64).mean() > 0.003):
            args.worst.mkdir(parents=True, exist_ok=True)
            sheet = np.hstack([scene.image, ours, theirs, 255 - gap.astype(np.uint8)])
            Image.fromarray(sheet).save(
                args.worst / f"{gap.mean():06.3f}-{name.strip('@')}-{icon}.png".replace("/", "_")
            )
    print("| set | icons | mean absolute error | worst | pixels off by > 64 | error before any edit |")
    print("| --- | --- | --- | --- | --- | --- |")
    rows["all"] = [row for found in list(rows.values()) for row in found]
    for name, measured in rows.items():
        errors, far, still = (np.array(column) for column in zip(*measured, strict=True))
        print(f"| {name} | {len(measured)} | {errors.mean():.3f} | {errors.max():.2f} "
              f"| {100 * far.mean():.3f} % | {still.mean():.4f} |")  # fmt: skip
    worst.sort(reverse=True)
    for row in worst[:12]:
        print(f"{row[0]:.3f}", *row[1:])
    args.out.write_text(json.dumps({"errors": {f"{n}/{i}": round(e, 4) for e, n, i, _ in worst}}, indent=1) + "\n")


if __name__ == "__main__":
    main()
