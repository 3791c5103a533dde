"""What can be known to be wrong with a command before the long work begins."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from iconjax.errors import ConfigError, InputError
from iconjax.files import IMAGE_SUFFIXES, check_writable, image_format

if TYPE_CHECKING:
    from iconjax.language.base import Translator

CASE_FILES = (
    "case.json",
    "image.png",
    "segmentation.png",
    "labels.json",
    "sheet.png",
    "program.txt",
    "checks.json",
    "ground_truth.png",
    "ground_truth.json",
)
"""Files of a case folder or of one made by `iconjax segment`, which no output replaces."""


def is_vector(picture: str | os.PathLike[str]) -> bool:
    """Whether a path names an SVG, by its ending."""
    return Path(picture).suffix.lower() in (".svg", ".svgz")


def default_output(picture: str) -> Path:
    """Where the edited picture goes when nobody says: `NAME-edited.png` (.svg for an SVG) in the current folder."""
    path = Path(picture)
    if is_vector(picture):
        return Path(f"{path.stem}-edited.svg")
    return Path(f"{path.resolve().name if path.is_dir() else path.stem}-edited.png")


def one_segment(picture: str, count: int) -> str | None:
    """What to say of a picture of `count` segments where they are one, in which nothing can be moved apart."""
    if count != 1:
        return None
    if is_vector(picture):
        way = "split its path or group into several in a drawing program, or take a file with more elements"
    else:
        way = "cut its label map in two, find more with iconjax segment (--method, --holes), or take another file"
    return f"{picture} has one segment, so that nothing in it can be moved apart: {way}"


def check_picture(picture: str, seg: str | None, labels: str | None) -> None:
    """A picture with its segments, or a folder that has them in itself.

    Raises:
        InputError: it is missing, or the options do not fit it.
    """
    path = Path(picture)
    if not path.exists():
        raise InputError(f"there is no file or folder {picture}")
    if path.is_dir():
        from iconjax.scene.segment.folder import is_parts

        if (seg is not None or labels is not None) and not is_parts(picture):
            raise InputError(
                f"{picture} is a case folder, which has its own segmentation: leave out --seg and --labels"
            )
        check_folder(path)
    elif is_vector(picture):
        if seg is not None:
            raise InputError(f"{picture} is an SVG, which has its segments in itself: leave out --seg")
    elif seg is None:
        raise InputError(
            f"{picture} is an image, so it needs --seg (a label map) and --labels; or run iconjax segment {picture}"
        )


def check_folder(folder: Path) -> None:
    """Whether a folder is a case folder or one made by `iconjax segment`.

    Raises:
        InputError: it is neither.
    """
    from iconjax.scene.segment.folder import is_parts

    if not (folder / "case.json").exists() and not is_parts(folder):
        raise InputError(
            f"{folder} is no picture: a case folder has case.json, image.png and segmentation.png; one made by "
            "iconjax segment has image.png, segmentation.png and labels.json"
        )


def check_choices(
    translator: str | None, program: str | None, interpretations: int, **llm: str | None
) -> Translator | None:
    """Options that exclude each other, that are not supported, or that name no translator.

    Args:
        llm: options that only a language model has, as `iconjax.edit.choose.llm_options` takes them.

    Returns:
        The translator that the options choose; None where a program is given.

    Raises:
        ConfigError: the message says what to leave out or to write.
    """
    for name in [n for n, value in [("translator", translator), *llm.items()] if value is not None]:
        if program is not None:
            raise ConfigError(f"--program skips translation: leave out --{name}")
    if interpretations < 1:
        raise ConfigError("--interpretations has to be at least 1")
    if interpretations > 1 and program is not None:
        raise ConfigError("a program has one interpretation: leave out --interpretations")
    if program is not None:
        return None
    from iconjax.edit.choose import choose_translator, llm_options

    return choose_translator(llm_options(translator, **llm))


def numbered(target: Path, count: int) -> list[Path]:
    """Where the pictures of `count` readings go: `target`, then NAME-2, NAME-3 and so on beside it."""
    return [target if k == 1 else target.with_stem(f"{target.stem}-{k}") for k in range(1, count + 1)]


def check_outputs(
    pictures: Sequence[Path], json_file: str | None, trace: str | None, inputs: tuple[str | None, ...]
) -> None:
    """Output files that cannot be written, that collide, or that would overwrite an input, the picture being first.

    Raises:
        InputError: the first that is wrong.
    """
    target = pictures[0]
    vector = is_vector(inputs[0] or "")
    if not is_vector(target):
        if vector and target.suffix.lower() not in IMAGE_SUFFIXES:
            known = ", ".join((".svg", ".svgz", *IMAGE_SUFFIXES))
            raise InputError(f"cannot write {target}: the name of an edited SVG ends in one of {known}")
        image_format(target)
    elif not vector:
        raise InputError(f"cannot write {target}: only an edited SVG can be saved as SVG, name it .png")
    targets = [p for p in (*pictures, json_file, trace) if p is not None and str(p) != "-"]
    places = [Path(p).resolve() for p in targets]
    taken = {Path(p).resolve() for p in inputs if p is not None}
    taken |= {place / name for place in taken if place.is_dir() for name in CASE_FILES}
    for path, place in zip(targets, places, strict=True):
        if places.count(place) > 1:
            raise InputError(f"{path} is named twice as an output")
        if place.is_file() and any(other.exists() and place.samefile(other) for other in taken):
            raise InputError(f"{path} is an input: it is not overwritten")
        check_writable(path)
