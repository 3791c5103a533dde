"""Rebuild the cases of `specs/`, or of another folder of specs, from the icon packages, and check them.

    npm install @iconify-json/fluent-emoji-flat @iconify-json/maki @iconify-json/temaki
    python eval/authoring/build.py node_modules/@iconify-json OUT [ID ...] [--specs FOLDER] [--sheet FOLDER]

A spec names the icon, the pieces of each part (see `vector.py`), the request, the reference program, the
checks, one solution as explicit motions in pixels, and wrong edits that the checks have to reject.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image, ImageDraw
from vector import SIZE, Icon, load_icon

from iconjax.dsl.parse import parse
from iconjax.evaluation.cases import load_eval_case
from iconjax.evaluation.checks import judge
from iconjax.scene.build import build_scene
from iconjax.scene.load import load_case

HERE = Path(__file__).parent
LICENSES = {
    "flat-color-icons": "MIT",
    "fluent-emoji-flat": "MIT",
    "fxemoji": "Apache-2.0",
    "healthicons": "MIT",
    "maki": "CC0-1.0",
    "material-symbols": "Apache-2.0",
    "mdi": "Apache-2.0",
    "noto": "Apache-2.0",
    "temaki": "CC0-1.0",
}
IDENTITY = np.eye(3)


def matrix_of(steps: Sequence[Sequence[Any]]) -> np.ndarray:
    """Product of motions, first one first: translate dx dy, scale sx sy cx cy, rotate degrees cx cy."""
    total = IDENTITY
    for name, *v in steps:
        if name == "translate":
            m = np.array([[1, 0, v[0]], [0, 1, v[1]], [0, 0, 1.0]])
        elif name == "scale":
            m = np.array([[v[0], 0, v[2] * (1 - v[0])], [0, v[1], v[3] * (1 - v[1])], [0, 0, 1.0]])
        elif name == "rotate":
            c, s = math.cos(math.radians(v[0])), math.sin(math.radians(v[0]))
            centre = np.array(v[1:])
            turn = np.array([[c, -s], [s, c]])
            m = np.eye(3)
            m[:2, :2], m[:2, 2] = turn, centre - turn @ centre
        else:
            raise ValueError(f"unknown motion {name!r}")
        total = m @ total
    return total


def transforms_of(spec: Mapping[str, Any], motions: Mapping[str, Any]) -> dict[int, np.ndarray]:
    """Segment id -> 2x3 matrix, of motions that are given by label or by object."""
    labels = [label for label, _ in spec["parts"]]
    unused = set(motions)
    out: dict[int, np.ndarray] = {}
    for key, label in enumerate(labels, 1):
        name = next((n for n in (label, label.split(":")[0]) if n in motions), None)
        if name is not None:
            unused.discard(name)
            out[key] = matrix_of(motions[name])[:2]
    if unused:
        raise ValueError(f"{spec['id']}: motions for unknown {unused}")
    return out


def pieces_of(icon: Icon, spec: Mapping[str, Any]) -> list[tuple[int, str]]:
    """(segment id, markup) in paint order; every piece of the icon belongs to exactly one segment."""
    owner: dict[tuple[int, int | None], int] = {}
    for key, (_, names) in enumerate(spec["parts"], 1):
        for name in names.split():
            element, _, sub = name.partition(".")
            subs = range(int(sub.split("-")[0]), int(sub.split("-")[-1]) + 1) if sub else [None]
            for k in subs:
                if (int(element), k) in owner:
                    raise ValueError(f"{spec['id']}: piece {name} is used twice")
                owner[int(element), k] = key
    out = []
    for number, element in enumerate(icon.elements):
        if (number, None) in owner:
            out.append((owner.pop((number, None)), element.svg()))
            continue
        chosen: dict[int, list[int]] = {}
        for k in range(len(element.subpaths)):
            chosen.setdefault(owner.pop((number, k)), []).append(k)
        out += [(key, element.svg(subs)) for key, subs in chosen.items()]
    if owner:
        raise ValueError(f"{spec['id']}: no such pieces: {sorted(owner)}")
    return out


def on_white(image: Image.Image) -> Image.Image:
    """RGB on white paper."""
    paper = Image.new("RGBA", image.size, (255, 255, 255, 255))
    return Image.alpha_composite(paper, image).convert("RGB")


def build(packages: Path, spec: Mapping[str, Any], folder: Path) -> None:
    """Write a case folder."""
    icon = load_icon(packages, spec["icon"])
    pieces = pieces_of(icon, spec)
    mask = np.zeros((SIZE, SIZE), np.uint8)
    for key, markup in pieces:
        mask[np.asarray(icon.draw([markup]))[..., 3] >= 128] = key
    motions = transforms_of(spec, spec["truth"])
    moved = [icon.moved(m, motions[k]) if k in motions else m for k, m in pieces]
    folder.mkdir(parents=True, exist_ok=True)
    on_white(icon.draw([e.svg() for e in icon.elements])).save(folder / "image.png")
    on_white(icon.draw(moved)).save(folder / "ground_truth.png")
    Image.fromarray(mask).save(folder / "segmentation.png")
    (folder / "icon.svg").write_text(icon.text, encoding="utf-8")
    (folder / "program.txt").write_text("\n".join(spec["program"]) + "\n", encoding="utf-8")
    case = {
        "id": spec["id"],
        "request": spec["request"],
        "labels": {str(k): label for k, (label, _) in enumerate(spec["parts"], 1)},
        "source": spec["icon"],
        "license": LICENSES[spec["icon"].split(":")[0]],
    }
    truth = {"transforms": {str(k): np.round(m, 6).tolist() for k, m in sorted(motions.items())}}
    checks = {"goal": spec["goal"], "coherence": spec["coherence"]}
    for name, data in (("case", case), ("ground_truth", truth), ("checks", checks)):
        (folder / f"{name}.json").write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")


def verify(spec: Mapping[str, Any], folder: Path) -> list[str]:
    """What is wrong with a case (nothing, if all is well)."""
    wrong: list[str] = []
    case = load_eval_case(folder)
    present = set(np.unique(case.mask)) - {0}
    if present != set(case.labels):
        wrong.append(f"segments in the picture {sorted(present)}, labels {sorted(case.labels)}")
    record = load_case(folder)
    scene = build_scene(record.image, record.segmentation)
    try:
        parse(case.program or "", [s.name for s in scene.segments], list(scene.objects))
    except Exception as error:
        wrong.append(f"program: {error}")
    verdict = judge(case, case.truth)
    wrong += [f"truth: {check}" for check in verdict.failed]
    if judge(case, {}).goal_met:
        wrong.append("the unedited picture meets the goal")
    for name, motions in spec["wrong"].items():
        if judge(case, transforms_of(spec, motions)).right:
            wrong.append(f"wrong edit {name!r} passes")
    for name, motions in spec.get("also_right", {}).items():
        wrong += [f"right edit {name!r}: {c}" for c in judge(case, transforms_of(spec, motions)).failed]
    return wrong


def sheet(folder: Path, out: Path) -> None:
    """Original, segments, solution side by side."""
    mask = np.asarray(Image.open(folder / "segmentation.png"))
    colours = np.random.default_rng(4).integers(40, 230, (256, 3)).astype(np.uint8)
    colours[0] = 255
    page = Image.new("RGB", (3 * 520, 530), "grey")
    panels = [Image.open(folder / "image.png"), Image.fromarray(colours[mask])]
    for k, panel in enumerate([*panels, Image.open(folder / "ground_truth.png")]):
        page.paste(panel, (k * 520, 0))
    request = json.loads((folder / "case.json").read_text())["request"]
    ImageDraw.Draw(page).text((4, 515), request, fill="white")
    out.mkdir(parents=True, exist_ok=True)
    page.save(out / f"{folder.name}.png")


def main() -> int:
    """Build, verify, report."""
    parser = argparse.ArgumentParser()
    parser.add_argument("packages", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("ids", nargs="*")
    parser.add_argument("--specs", type=Path, default=HERE / "specs", help="folder of specs (default: %(default)s)")
    parser.add_argument("--sheet", type=Path)
    args = parser.parse_args()
    paths = sorted(args.specs.glob("*.json"))
    if not paths:
        parser.error(f"there are no specs in {args.specs}")
    bad = 0
    for path in paths:
        if args.ids and path.stem not in args.ids:
            continue
        spec = json.loads(path.read_text(encoding="utf-8"))
        folder = args.out / spec["id"]
        build(args.packages, spec, folder)
        wrong = verify(spec, folder)
        bad += bool(wrong)
        print(spec["id"], "ok" if not wrong else "\n  " + "\n  ".join(wrong))
        if args.sheet:
            sheet(folder, args.sheet)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
