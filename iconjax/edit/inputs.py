"""What the caller hands over, made into a scene: pictures, label maps, labels, folders, programs."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from iconjax.checks import check_folder, is_vector
from iconjax.errors import InputError
from iconjax.files import describe
from iconjax.scene.build import build_scene
from iconjax.scene.load import load_case
from iconjax.scene.segment.folder import parts_files
from iconjax.scene.types import Scene

if TYPE_CHECKING:
    from iconjax.scene.svg import SvgScene

LARGEST_TEXT = 1 << 20
"""Bytes: no program is as long, so a longer file is the wrong file."""


@dataclass(frozen=True)
class Inputs:
    """A scene and the request that came with it.

    Attributes:
        scene: the picture with its segments.
        request: the caller's request, else that of the case folder, else "".
        vector: the opened SVG, where the picture is one.
    """

    scene: Scene
    request: str
    vector: SvgScene | None = None


def open_inputs(image: Any, seg: Any = None, request: str | None = None, labels: Any = None) -> Inputs:
    """Read what `iconjax.edit` was given; see there.

    Raises:
        InputError: something cannot be read, does not fit together or is contradictory.
    """
    if request is not None and not isinstance(request, str):
        raise InputError(f"the request has to be text, not {type(request).__name__}")
    if is_folder(image):
        image, seg, labels = parts_files(image, seg, labels)
    if is_folder(image):
        if seg is not None or labels is not None:
            raise InputError(f"{image} is a case folder, which has its own segmentation: leave out seg and labels")
        check_folder(Path(image))
        case = load_case(image)
        scene = build_scene(case.image, case.segmentation)
        return Inputs(scene, case.request if request is None else request)
    vector = _open_vector(image, seg, labels)
    if vector is not None:
        return Inputs(vector.scene, request or "", vector)
    if seg is None:
        raise InputError("no segmentation: give seg (a label map) and labels, or a case folder in place of the image")
    return Inputs(build_scene(image, seg, labels), request or "")


def _open_vector(image: Any, seg: Any, labels: Any) -> SvgScene | None:
    """The SVG that `image` is or names, None where it is a raster picture."""
    if isinstance(image, (str, os.PathLike)) and is_vector(image):
        from iconjax.scene.svg import open_svg  # only an SVG needs it

        if seg is not None:
            raise InputError(f"{image} is an SVG, which has its segments in itself: leave out seg")
        return open_svg(image, labels)
    if type(image).__name__ != "SvgScene":
        return None
    if seg is not None or labels is not None:
        raise InputError("an opened SVG has segments and labels: leave out seg, and give labels to open_svg")
    vector: SvgScene = image
    return vector


def is_folder(image: Any) -> bool:
    """Whether `image` is the path of a folder."""
    return isinstance(image, (str, os.PathLike)) and Path(image).is_dir()


def program_text(program: str | os.PathLike[str] | Sequence[str]) -> str | tuple[str, ...]:
    """A program as the parser takes it: text as it is, a path object read, a sequence of calls checked.

    Raises:
        InputError: it is none of these, or empty.
    """
    if isinstance(program, os.PathLike):
        program = read_text(program, "program")
    if isinstance(program, str):
        lines = program.splitlines()
    elif isinstance(program, Sequence) and all(isinstance(line, str) for line in program):
        lines = list(program)
    else:
        raise InputError("the program has to be text, a path object or a list of calls, each as text")
    if all(not line.strip() or line.lstrip().startswith("#") for line in lines):
        raise InputError('the program is empty: it needs one call a line, such as touch("Lamp", "Table")')
    return program if isinstance(program, str) else tuple(lines)


def read_text(path: str | os.PathLike[str], what: str) -> str:
    """The text of a small UTF-8 file.

    Args:
        path: the file.
        what: how to call it in an error.
    """
    try:
        with open(path, "rb") as stream:
            data = stream.read(LARGEST_TEXT + 1)
    except (OSError, ValueError) as error:
        reason = describe(error) if isinstance(error, OSError) else str(error)
        raise InputError(f"cannot read {what} {path}: {reason}") from error
    if len(data) > LARGEST_TEXT:
        raise InputError(f"{what} {path} is longer than {LARGEST_TEXT} bytes")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"{what} {path} is not a text file (UTF-8)") from error
    if "\0" in text:
        raise InputError(f"{what} {path} is not a text file (it holds NUL characters)")
    return text
