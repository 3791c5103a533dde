"""The folder that a segmentation is kept in: `image.png`, `segmentation.png`, `labels.json`, `sheet.png`."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Integer, UInt8

from iconjax.errors import InputError
from iconjax.files import describe, encode_image, write_bytes, write_text

IMAGE, MASK, LABELS, SHEET = "image.png", "segmentation.png", "labels.json", "sheet.png"
FILES = (IMAGE, MASK, LABELS, SHEET)


def is_parts(path: str | os.PathLike[str]) -> bool:
    """Whether a path is that of such a folder. It holds no request: one with a `case.json` is a case folder."""
    folder = Path(path)
    return all((folder / name).is_file() for name in (IMAGE, MASK, LABELS)) and not (folder / "case.json").exists()


def parts_files(picture: str | os.PathLike[str], seg: Any = None, labels: Any = None) -> tuple[Any, Any, Any]:
    """The image, label map and labels file that such a folder stands for.

    Anything else comes back as it is, as do a label map and labels that are given along with such a folder.
    """
    if not is_parts(picture):
        return picture, seg, labels
    folder = Path(picture)
    return (
        str(folder / IMAGE),
        str(folder / MASK) if seg is None else seg,
        str(folder / LABELS) if labels is None else labels,
    )


def check_folder(path: str | os.PathLike[str], force: bool) -> None:
    """Find out before the work that the folder cannot be written.

    Raises:
        InputError: it is a file or a case folder, it cannot be made, or it has one of the files and not `force`.
    """
    folder = Path(path)
    if folder.exists() and not folder.is_dir():
        raise InputError(f"{folder} is a file: give -o a folder")
    if (folder / "case.json").exists():
        raise InputError(f"{folder} is a case folder, which has its segmentation: give -o another folder")
    for name in FILES:
        refuse_existing(folder / name, force)
    nearest = next(place for place in (folder.absolute(), *folder.absolute().parents) if place.exists())
    if not nearest.is_dir() or not os.access(nearest, os.W_OK):
        raise InputError(f"cannot make the folder {folder}: {nearest} is no folder that can be written to")


def make_folder(path: str | os.PathLike[str]) -> None:
    """Make a folder, and those above it, where it is not there.

    Raises:
        InputError: it cannot be made.
    """
    try:
        Path(path).mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:
        why = describe(error) if isinstance(error, OSError) else str(error)
        raise InputError(f"cannot make the folder {path}: {why}") from error


def refuse_existing(path: str | os.PathLike[str], force: bool) -> None:
    """Raise `InputError` where `path` exists and may not be replaced."""
    if not force and os.path.lexists(path):
        raise InputError(f"{path} exists: --force replaces it")


def write_picture(path: str | os.PathLike[str], picture: UInt8[np.ndarray, "H W 3"]) -> None:
    """Write an RGB picture as PNG."""
    write_bytes(path, encode_image(picture))


def write_mask(path: str | os.PathLike[str], mask: Integer[np.ndarray, "H W"]) -> None:
    """Write a label map as grey PNG, of 8 bits where they suffice, else 16."""
    write_bytes(path, encode_image(mask.astype(np.uint8 if int(mask.max()) < 256 else np.uint16)))


def write_labels(path: str | os.PathLike[str], labels: Mapping[int, str]) -> None:
    """Write names by segment id as JSON, one a line, as `--labels` takes them."""
    table = {str(k): labels[k] for k in sorted(labels)}
    write_text(path, json.dumps(table, indent=1, ensure_ascii=False) + "\n")
