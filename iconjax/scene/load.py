"""Reading pictures, label maps and case folders, and telling bad input in one line."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Int32, UInt8

from iconjax.errors import InputError
from iconjax.scene.labels import check_labels, read_json, read_labels
from iconjax.scene.pixels import (
    as_array,
    is_pil,
    mask_of_array,
    mask_of_pil,
    open_image,
    rgb_of_array,
    rgb_of_pil,
)
from iconjax.scene.types import Case, Segmentation

MAX_SEGMENTS = 512
"""Most segments a label map may have."""
NEEDED = "a case folder has case.json, image.png and segmentation.png"


def load_image(source: Any) -> UInt8[np.ndarray, "H W 3"]:
    """The picture as (H, W, 3) 8-bit RGB, a fresh array.

    Args:
        source: a path, a PIL image, or an array (H, W), (H, W, 1), (H, W, 3) or (H, W, 4) of 8- or 16-bit
            integers, booleans or floats from 0 to 1. Transparent pictures are laid on white.

    Raises:
        InputError: it cannot be read as a picture; the message says why and what to do.
    """
    if isinstance(source, str | os.PathLike):
        return rgb_of_pil(open_image(source, "image"), f"the image {os.fspath(source)}")
    if is_pil(source):
        return rgb_of_pil(source, "the image")
    return rgb_of_array(as_array(source, "image"), "the image")


def load_segmentation(source: Any, labels: Any = None) -> Segmentation:
    """The label map and its names, checked against each other.

    Args:
        source: a path to an 8- or 16-bit grey or palette PNG (or to a case folder), a PIL image, an (H, W)
            integer array, or a `Segmentation`.
        labels: names by segment id: a mapping (keys int or str), or a path to a JSON or CSV file. None takes
            those of the `Segmentation`, or the JSON file beside the mask (same name, else `case.json`, else
            `labels.json`).

    Raises:
        InputError: unusable mask or labels, or the two do not belong together.
    """
    if isinstance(source, Segmentation):
        names = source.labels if labels is None else labels
        mask = mask_of_array(as_array(source.mask, "segmentation"), "the segmentation")
    elif isinstance(source, str | os.PathLike):
        path = Path(source)
        path = path / "segmentation.png" if os.path.isdir(path) else path
        mask = mask_of_pil(open_image(path, "segmentation"), f"the segmentation {path}")
        names = _labels_beside(path) if labels is None else labels
    else:
        names, what = labels, "the segmentation"
        mask = mask_of_pil(source, what) if is_pil(source) else mask_of_array(as_array(source, "segmentation"), what)
    if names is None:
        raise InputError('the segmentation has no labels: give a mapping like {1: "Lamp:Shade"} or a JSON or CSV file')
    table = check_labels(names) if isinstance(names, Mapping) else read_labels(names)
    _check_agreement(mask, table)
    return Segmentation(mask, table)


def check_sizes(image: UInt8[np.ndarray, "H W 3"], seg: Segmentation) -> None:
    """Raise `InputError` unless picture and label map have the same size."""
    if image.shape[:2] != seg.mask.shape:
        (h, w), (mh, mw) = image.shape[:2], seg.mask.shape
        raise InputError(f"the image is {w}x{h} pixels but the segmentation is {mw}x{mh}: they must have the same size")


def load_case(folder: str | os.PathLike[str]) -> Case:
    """One case folder: `case.json`, `image.png`, `segmentation.png` and, if there, `program.txt`.

    Raises:
        InputError: the folder or one of its files is missing or unusable; the message names the file.
    """
    if not isinstance(folder, str | os.PathLike):
        raise InputError(f"a case folder is given by its path, not by {type(folder).__name__}")
    path = Path(folder)
    if not os.path.isdir(path):
        what = "is not a folder" if os.path.exists(path) else "does not exist"
        raise InputError(f"case folder {path} {what}: {NEEDED}")
    for name in ("case.json", "image.png", "segmentation.png"):
        if not os.path.isfile(path / name):
            raise InputError(f"case folder {path} has no {name}: {NEEDED}")
    name, request, labels = _case_record(path / "case.json")
    try:
        seg = load_segmentation(path / "segmentation.png", labels)
        image = load_image(path / "image.png")
        check_sizes(image, seg)
    except InputError as error:
        raise InputError(f"case folder {path}: {error}") from error
    program = path / "program.txt"
    text = _read_text(program) if program.is_file() else None
    return Case(name, request, image, seg, text, path)


def _case_record(path: Path) -> tuple[str, str, dict[str, Any]]:
    data = read_json(path)
    if not isinstance(data, dict):
        raise InputError(f'{path} must be an object like {{"request": "...", "labels": {{...}}}}')
    request, labels = data.get("request"), data.get("labels")
    if not isinstance(request, str) or not request.strip():
        raise InputError(f'{path} has no "request": add the edit in words as a string')
    if not isinstance(labels, dict):
        raise InputError(f'{path} has no "labels": add an object like {{"1": "Lamp:Shade"}}')
    name = data.get("id", path.resolve().parent.name)
    if not isinstance(name, str):
        raise InputError(f'"id" in {path} must be a string, not {type(name).__name__}')
    return name, request, labels


def _read_text(path: Path) -> str:
    try:
        return path.read_text("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"cannot read {path}: it must be a UTF-8 text file") from error


def _labels_beside(path: Path) -> Path | None:
    found = (path.with_suffix(".json"), path.parent / "case.json", path.parent / "labels.json")
    return next((p for p in found if os.path.isfile(p)), None)


def _check_agreement(mask: Int32[np.ndarray, "H W"], labels: Mapping[int, str]) -> None:
    counts = np.bincount(mask.ravel())
    found = [int(i) for i in np.flatnonzero(counts) if i > 0]
    if not found:
        raise InputError("the segmentation has no segments: every pixel is 0, draw segment k with value k")
    if len(found) > MAX_SEGMENTS:
        raise InputError(
            f"the segmentation has {len(found)} segments: at most {MAX_SEGMENTS} are allowed (anti-aliased?)"
        )
    unnamed = [i for i in found if i not in labels]
    if unnamed:
        raise InputError(f"segments without a label: {_some(unnamed)}: add them to the labels or set their pixels to 0")
    unused = [i for i in labels if i >= len(counts) or counts[i] == 0]
    if unused:
        named = _some([f"{i} ({labels[i]!r})" for i in unused])
        raise InputError(f"labels without pixels in the segmentation: {named}: draw them or remove the labels")


def _some(items: list[Any]) -> str:
    shown = ", ".join(str(i) for i in items[:8])
    return shown + (f" and {len(items) - 8} more" if len(items) > 8 else "")
