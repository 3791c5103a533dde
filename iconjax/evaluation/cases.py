"""Cases of a benchmark: an icon, a request, one possible solution, and the checks of any right solution."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Integer, UInt8
from PIL import Image
from shapely.geometry import MultiPolygon

from iconjax.errors import InputError
from iconjax.evaluation.affine import Matrix, read_transforms
from iconjax.evaluation.outlines import outlines_of


@dataclass(frozen=True, eq=False)
class EvalCase:
    """One case folder (contract, section 2), as the evaluation needs it.

    Attributes:
        id: name of the case.
        request: the instruction in natural language.
        labels: segment id -> label as written, not yet numbered.
        mask: (H, W) label map.
        goal, coherence: the checks, as read from `checks.json`.
        truth: transforms of one possible solution, one for each segment id.
        program: text of the reference program, None where there is none.
        folder: where the case was read from.
    """

    id: str
    request: str
    labels: Mapping[int, str]
    mask: Integer[np.ndarray, "H W"]
    goal: tuple[Mapping[str, Any], ...]
    coherence: tuple[Mapping[str, Any], ...]
    truth: Mapping[int, Matrix]
    program: str | None
    folder: Path

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the picture in pixels."""
        return int(self.mask.shape[1]), int(self.mask.shape[0])

    @cached_property
    def outlines(self) -> dict[int, MultiPolygon]:
        """Outer outline of each segment in pixels.

        Raises:
            InputError: a label without pixels.
        """
        return outlines_of(self.mask, self.labels)

    @cached_property
    def image(self) -> UInt8[np.ndarray, "H W 3"]:
        """The unedited picture."""
        return read_image(self.folder / "image.png")

    @cached_property
    def truth_image(self) -> UInt8[np.ndarray, "H W 3"]:
        """The picture of the possible solution."""
        return read_image(self.folder / "ground_truth.png")


def read_image(path: Path) -> UInt8[np.ndarray, "H W 3"]:
    """Read an image file as RGB, transparent parts on white.

    Raises:
        InputError: there is no such file, or it is no image.
    """
    try:
        with Image.open(path) as image:
            rgba = image.convert("RGBA")
    except OSError as error:
        raise InputError(f"cannot read image {path}: {error}") from error
    paper = Image.new("RGBA", rgba.size, (255, 255, 255, 255))
    return np.asarray(Image.alpha_composite(paper, rgba).convert("RGB"))


def load_eval_case(folder: str | Path) -> EvalCase:
    """Read a case folder.

    Raises:
        InputError: a file is missing or does not fit the others; the message names the case.
    """
    folder = Path(folder)
    case, checks, truth = (_read_json(folder / f"{n}.json") for n in ("case", "checks", "ground_truth"))
    try:
        with Image.open(folder / "segmentation.png") as image:
            mask = np.asarray(image).astype(np.int32)
        labels = {int(k): str(v) for k, v in case["labels"].items()}
        program = folder / "program.txt"
        return EvalCase(
            id=str(case["id"]),
            request=str(case["request"]),
            labels=labels,
            mask=mask,
            goal=tuple(checks["goal"]),
            coherence=tuple(checks["coherence"]),
            truth=read_transforms(truth["transforms"], sorted(labels)),
            program=program.read_text(encoding="utf-8") if program.exists() else None,
            folder=folder,
        )
    except KeyError as error:
        raise InputError(f"case {folder.name}: {error.args[0]!r} is missing") from error
    except OSError as error:
        raise InputError(f"case {folder.name}: {error}") from error
    except InputError as error:
        raise InputError(f"case {folder.name}: {error}") from error


def list_cases(folder: str | Path) -> tuple[Path, ...]:
    """Case folders of a benchmark folder, by name; a case folder itself is a benchmark of one.

    Raises:
        InputError: there is none.
    """
    folder = Path(folder)
    if (folder / "case.json").is_file():
        return (folder,)
    found = tuple(sorted(path.parent for path in folder.glob("*/case.json")))
    if not found:
        raise InputError(f"no case folders in {folder}: expected FOLDER/*/case.json")
    return found


def _read_json(path: Path) -> dict[str, Any]:
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"case {path.parent.name}: cannot read {path.name}: {error.strerror}") from error
    except ValueError as error:
        raise InputError(f"case {path.parent.name}: {path.name} is not JSON: {error}") from error
    if not isinstance(data, dict):
        raise InputError(f"case {path.parent.name}: {path.name} does not hold a JSON object")
    return data
