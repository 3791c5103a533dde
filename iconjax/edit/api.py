"""The one function that most users need. Light to import: everything heavy is loaded when it is called."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from PIL.Image import Image

    from iconjax.edit.config import EditConfig
    from iconjax.edit.result import EditResult
    from iconjax.language.base import Translator
    from iconjax.scene.svg import SvgScene
    from iconjax.scene.types import Segmentation

    Path = str | os.PathLike[str]
    Picture = np.ndarray | Image | Path | SvgScene


def edit(
    image: Picture,
    seg: Segmentation | Picture | None = None,
    request: str | None = None,
    *,
    labels: Mapping[int, str] | Path | None = None,
    translator: Translator | str | None = None,
    program: Path | Sequence[str] | None = None,
    config: EditConfig | None = None,
    interpretations: int = 1,
) -> EditResult:
    """Edit an icon as a sentence asks.

    Args:
        image: the picture, as an (H, W, 3) uint8 array, a PIL image or a path; or the path of a case
            folder, which brings its own segmentation, labels and request; or of a folder made by `iconjax
            segment`, which brings all but the request; or the path of an SVG (or what
            `iconjax.scene.svg.open_svg` made of one), whose elements are the segments.
        seg: which pixel belongs to what: a `Segmentation`, or a label map (array, PIL image or path) in which
            0 is background.
        request: what to change, in English.
        labels: names of the label map's values, `{1: "Lamp:Shade"}`, or the path of a JSON or CSV file.
        translator: who reads the request: a name, an object with `translate(request, scene)`, or None for
            automatic: Anthropic where it is available and credentials are configured, else the built-in
            offline translator.
        program: constraints in the DSL, as text, a list of calls or a path object; skips translation.
        config: how to search, see `EditConfig`.
        interpretations: most readings of an ambiguous request to follow; the result is that of the likeliest, and its
            `interpretations` holds one result for each reading that leads to a different picture.

    Returns:
        The edited picture with everything known about it; look at `satisfied` before you rely on it.

    Raises:
        IconjaxError: the input cannot be used, the request was not understood, or a setting is not allowed
            (`InputError`, `TranslationError`, `ProgramError`, `ConfigError`).
    """
    from iconjax.edit.pipeline import run_edit  # here and not above: it imports JAX

    return run_edit(
        image,
        seg,
        request,
        labels=labels,
        translator=translator,
        program=program,
        config=config,
        interpretations=interpretations,
    )
