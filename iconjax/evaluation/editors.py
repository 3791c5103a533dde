"""The editor behind each method: a case in, an edit out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
from jaxtyping import Float, UInt8

from iconjax.errors import ConfigError
from iconjax.evaluation.affine import Transforms, read_transforms
from iconjax.evaluation.cases import EvalCase
from iconjax.evaluation.methods import ASKING, DIRECT, Method
from iconjax.evaluation.model import open_client, open_translator
from iconjax.language.base import Translator
from iconjax.language.llm.settings import LlmSettings
from iconjax.scene.types import Scene, Segmentation
from iconjax.search.types import ConstraintReport


@dataclass(frozen=True)
class Edited:
    """What a method makes of a case.

    Attributes:
        transforms: segment id -> 2x3 matrix in pixels; a segment left out stays.
        image: the edited picture; None where the method draws none.
        constraints: the reference program's constraints, measured on the edit; None where nobody measured.
        details: further facts for the record, as plain JSON data.
        seconds: time the edit itself took; None means all the time that the editor took.
    """

    transforms: Transforms
    image: UInt8[np.ndarray, "H W 3"] | None = None
    constraints: tuple[ConstraintReport, ...] | None = None
    details: Mapping[str, Any] = field(default_factory=dict)
    seconds: float | None = None


Editor = Callable[[EvalCase], Edited]
"""A way to edit: a case in, an edit out; what it raises is reported for that case."""


def make_editor(method: Method, settings: LlmSettings | None = None) -> Editor:
    """The editor behind a method.

    Args:
        method: the method.
        settings: of the language model and its recordings; by default from the environment.

    Raises:
        ConfigError: its translator cannot be had, for example for want of recordings.
    """
    settings = settings or LlmSettings.from_environment()
    if method.translator in ASKING:
        open_client(method.translator, settings)  # what is missing is said before the long work
    if method.name == "unedited":
        return _unedited
    if method.name == "truth":
        return _truth
    if method.base in DIRECT:
        from iconjax.evaluation.direct import DirectEditor  # here, because it needs this module

        return DirectEditor(method, settings)
    return _IconjaxEditor(method, settings)


def _unedited(case: EvalCase) -> Edited:
    return Edited({}, case.image, measure_reference(case, {}), seconds=0.0)


def _truth(case: EvalCase) -> Edited:
    begin = perf_counter()
    picture = draw(case, case.truth)
    return Edited(case.truth, picture, measure_reference(case, case.truth), seconds=perf_counter() - begin)


@dataclass(frozen=True)
class _IconjaxEditor:
    """`iconjax.edit` with the settings of a method."""

    method: Method
    settings: LlmSettings

    def __call__(self, case: EvalCase) -> Edited:
        from iconjax.edit.api import edit  # late, because it brings JAX
        from iconjax.edit.config import EditConfig

        assert self.method.strategy is not None
        config = EditConfig(
            strategy=self.method.strategy,
            relation_search=self.method.relation_search,
            motion_search=self.method.motion_search,
        )
        given = self.method.translator == "program"
        if given and case.program is None:
            raise ConfigError(f"case {case.id} has no program.txt, which method {self.method.name!r} needs")
        reader: Translator | str | None = None if given else self.method.translator
        meter = None
        if self.method.translator in ASKING:
            reader, meter = open_translator(self.method.translator, self.settings)
        begin = perf_counter()
        result = edit(
            Path(case.folder) / "image.png",
            Path(case.folder) / "segmentation.png",
            case.request,
            labels=dict(case.labels),
            translator=reader,
            program=case.program.splitlines() if given and case.program is not None else None,
            config=config,
        )
        seconds = perf_counter() - begin
        constraints = result.constraints if given else measure_reference(case, result.transforms)
        details = {key: value for key, value in result.to_dict().items() if key != "transforms"}
        if meter is not None:
            details["usage"] = meter.counts()
        return Edited(result.transforms, result.image, constraints, details, seconds)


def measure_reference(case: EvalCase, transforms: Transforms) -> tuple[ConstraintReport, ...] | None:
    """Measure the reference program of a case on an edit; None where there is no program."""
    if case.program is None:
        return None
    from iconjax.dsl.parse import parse
    from iconjax.search.measure import measure_program  # JAX is not needed to load the module

    scene = scene_of(case)
    return measure_program(scene, parse(case.program, scene.names, scene.objects), _stack(case, transforms))


def draw(case: EvalCase, transforms: Transforms) -> UInt8[np.ndarray, "H W 3"]:
    """The picture of a case with its segments moved."""
    from iconjax.render.depth import depth_order
    from iconjax.render.raster import render

    scene = scene_of(case)
    return render(scene, _stack(case, transforms), depth_order(scene).order)


def scene_of(case: EvalCase) -> Scene:
    """The scene of a case, as an edit sees it."""
    from iconjax.scene.build import build_scene

    return build_scene(case.image, Segmentation(case.mask, case.labels))


def _stack(case: EvalCase, transforms: Transforms) -> Float[np.ndarray, "n 2 3"]:
    return np.stack(list(read_transforms(transforms, sorted(case.labels)).values()))
