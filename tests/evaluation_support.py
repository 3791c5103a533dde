"""Small scenes with known geometry for the tests of the evaluation."""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from shapely.geometry import MultiPolygon, box

from iconjax.evaluation.cases import EvalCase
from iconjax.evaluation.editors import Edited
from iconjax.evaluation.run import run_benchmark
from iconjax.evaluation.stage import Stage

BENCHMARK = Path(__file__).parent.parent / "eval" / "benchmark"

ENVIRONMENT = {**os.environ, "PYTHONPATH": os.pathsep.join(p for p in (str(Path(__file__).parent), *sys.path) if p)}
"""For processes that tests start: they find what the tests find."""

BOXES = {1: (100, 100, 200, 140), 2: (200, 100, 260, 140), 3: (300, 300, 340, 440), 4: (120, 110, 140, 130)}
"""A bar, a block that touches its right end, a post far away, a window in the bar."""

LABELS = {1: "Thing:Bar", 2: "Thing:Block", 3: "Post", 4: "Pane:Window"}


def shift(dx: float, dy: float) -> np.ndarray:
    return np.array([[1.0, 0.0, dx], [0.0, 1.0, dy]])


def scale(sx: float, sy: float, about: tuple[float, float] = (0.0, 0.0)) -> np.ndarray:
    return np.array([[sx, 0.0, (1 - sx) * about[0]], [0.0, sy, (1 - sy) * about[1]]])


def turn(degrees: float, about: tuple[float, float] = (0.0, 0.0)) -> np.ndarray:
    """Clockwise on screen."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    linear = np.array([[c, -s], [s, c]])
    return np.column_stack([linear, np.array(about) - linear @ np.array(about)])


def stage(transforms: Mapping[int, np.ndarray] | None = None, unit: float = 1.0) -> Stage:
    """The scene of `BOXES` under an edit, in a picture of 512 times `unit`."""
    outlines = {key: MultiPolygon([box(*(unit * v for v in sides))]) for key, sides in BOXES.items()}
    side = round(512 * unit)
    scaled = {key: m * (1.0, 1.0, unit) for key, m in (transforms or {}).items()}
    return Stage((side, side), outlines, LABELS, scaled)


def write_case(folder: Path, *, goal: list[dict[str, Any]] | None = None, truth: dict[str, Any] | None = None) -> Path:
    """A case folder with a red square that is to move right by 20 px and a green one that is to stay."""
    folder.mkdir(parents=True)
    mask = np.zeros((64, 64), np.uint8)
    mask[10:20, 10:20], mask[40:50, 40:50] = 1, 2
    image = np.array([[255, 255, 255], [200, 0, 0], [0, 150, 0]], np.uint8)[mask]
    solution = np.array([[255, 255, 255], [0, 0, 0], [0, 150, 0]], np.uint8)[mask * (mask == 2)]
    solution[10:20, 30:40] = (200, 0, 0)
    Image.fromarray(mask).save(folder / "segmentation.png")
    Image.fromarray(image).save(folder / "image.png")
    Image.fromarray(solution).save(folder / "ground_truth.png")
    labels = {"1": "Red:Square", "2": "Green:Square"}
    case = {"id": folder.name, "request": "Move the red square right", "labels": labels}
    checks = {
        # Numbers are for a picture of 512, eight times this one.
        "goal": goal or [{"t": "moved", "of": "Red", "dx": [150, 170]}],
        "coherence": [{"t": "same", "of": "Green"}, {"t": "rigid", "of": "Red"}],
    }
    solved = {"transforms": truth or {"1": shift(20, 0).tolist()}}
    for name, data in (("case", case), ("checks", checks), ("ground_truth", solved)):
        (folder / f"{name}.json").write_text(json.dumps(data))
    return folder


class Slow:
    """Moves the red square as asked, but takes its time; says which case it works on, and in which process.

    Args:
        out: folder for a file with the process's number for each case begun; None writes none.
        seconds: how long it takes.
    """

    def __init__(self, out: Path | None = None, seconds: float = 0.1) -> None:
        self.out, self.seconds = out, seconds

    def __call__(self, case: EvalCase) -> Edited:
        if self.out is not None:
            (self.out / f"{case.id}.pid").write_text(str(os.getpid()))
            print(case.id)
        time.sleep(self.seconds)
        return Edited({1: shift(20, 0)}, case.truth_image, seconds=0.0)


def run_slowly(bench: str, out: str, jobs: int = 1) -> None:
    """Run the slow method; for a process that is to be killed."""
    run_benchmark(bench, out, [], editors={"slow": Slow(Path(out) / "slow")}, jobs=jobs)


def wait_until(done: Callable[[], bool], seconds: float = 60) -> None:
    """Wait for something that another process does, but not for ever."""
    deadline = time.monotonic() + seconds
    while not done() and time.monotonic() < deadline:
        time.sleep(0.01)
