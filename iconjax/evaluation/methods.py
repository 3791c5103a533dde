"""Methods that a benchmark compares, by name, and the editor behind each name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float, UInt8

from iconjax.errors import ConfigError
from iconjax.evaluation.affine import Transforms, read_transforms
from iconjax.evaluation.cases import EvalCase
from iconjax.scene.types import Scene, Segmentation
from iconjax.search.types import ConstraintReport

STRATEGIES = {"ours": "coherent", "paper": "paper"}
"""First word of a method -> strategy of the search."""

BASELINES = ("unedited", "truth")
"""Rows that every table has: the picture as it was, and the possible solution of the case."""

FLAGS = {
    "-MS": "without motion search",
    "-RS": "without relation search",
    "+program": "given the reference program",
}
"""Words that may follow it."""


@dataclass(frozen=True)
class Edited:
    """What a method makes of a case.

    Attributes:
        transforms: segment id -> 2x3 matrix in pixels; a segment left out stays.
        image: the edited picture; None where the method draws none.
        constraints: the reference program's constraints, measured on the edit; None where nobody measured.
        details: further facts for the record, as plain JSON data.
    """

    transforms: Transforms
    image: UInt8[np.ndarray, "H W 3"] | None = None
    constraints: tuple[ConstraintReport, ...] | None = None
    details: Mapping[str, Any] = field(default_factory=dict)


Editor = Callable[[EvalCase], Edited]
"""A way to edit: a case in, an edit out; what it raises is reported for that case."""


@dataclass(frozen=True)
class Method:
    """A named way to edit, see `parse_method`.

    Attributes:
        name: the name in tables.
        strategy: strategy of the search; None for a baseline.
        motion_search, relation_search: whether the two searches are on (the paper's ablation).
        reads_request: whether a translator reads the request; else the case's reference program is given.
    """

    name: str
    strategy: str | None = None
    motion_search: bool = True
    relation_search: bool = True
    reads_request: bool = True

    @property
    def folder(self) -> str:
        """Name of the folder that holds its results."""
        return self.name.replace(" ", "")

    def describe(self) -> dict[str, Any]:
        """Its settings as plain data."""
        return asdict(self)


def parse_method(name: str) -> Method:
    """Read the name of a method: a baseline, or a strategy followed by `FLAGS`, e.g. "ours -MS +program".

    Raises:
        ConfigError: there is no such method; the message says what there is.
    """
    base, *flags = name.split() or [""]
    if base in BASELINES and not flags:
        return Method(base)
    if base not in STRATEGIES or not set(flags) <= set(FLAGS):
        words = ", ".join(f"{flag} ({meaning})" for flag, meaning in FLAGS.items())
        first, second = ", ".join(BASELINES), ", ".join(STRATEGIES)
        raise ConfigError(f"unknown method {name!r}; there are {first}, and {second} followed by any of {words}")
    return Method(
        name=" ".join((base, *(flag for flag in FLAGS if flag in flags))),
        strategy=STRATEGIES[base],
        motion_search="-MS" not in flags,
        relation_search="-RS" not in flags,
        reads_request="+program" not in flags,
    )


def make_editor(method: Method, translator: str | None = None) -> Editor:
    """The editor behind a method.

    Args:
        method: the method.
        translator: who reads requests, by name; None means automatic.
    """
    if method.name == "unedited":
        return _unedited
    if method.name == "truth":
        return _truth
    return _IconjaxEditor(method, translator)


def _unedited(case: EvalCase) -> Edited:
    return Edited({}, case.image, measure_reference(case, {}))


def _truth(case: EvalCase) -> Edited:
    return Edited(case.truth, _draw(case, case.truth), measure_reference(case, case.truth))


@dataclass(frozen=True)
class _IconjaxEditor:
    """`iconjax.edit` with the settings of a method."""

    method: Method
    translator: str | None

    def __call__(self, case: EvalCase) -> Edited:
        from iconjax.edit.api import edit  # late, because it brings JAX
        from iconjax.edit.config import EditConfig

        assert self.method.strategy is not None
        config = EditConfig(
            strategy=self.method.strategy,
            relation_search=self.method.relation_search,
            motion_search=self.method.motion_search,
        )
        given = not self.method.reads_request
        if given and case.program is None:
            raise ConfigError(f"case {case.id} has no program.txt, which method {self.method.name!r} needs")
        result = edit(
            Path(case.folder) / "image.png",
            Path(case.folder) / "segmentation.png",
            case.request,
            labels=dict(case.labels),
            translator=self.translator,
            program=case.program.splitlines() if given and case.program is not None else None,
            config=config,
        )
        constraints = result.constraints if given else measure_reference(case, result.transforms)
        details = {key: value for key, value in result.to_dict().items() if key != "transforms"}
        return Edited(result.transforms, result.image, constraints, details)


def measure_reference(case: EvalCase, transforms: Transforms) -> tuple[ConstraintReport, ...] | None:
    """Measure the reference program of a case on an edit; None where there is no program."""
    if case.program is None:
        return None
    from iconjax.dsl.parse import parse
    from iconjax.search.measure import measure_program  # JAX is not needed to load the module

    scene = _scene(case)
    return measure_program(scene, parse(case.program, scene.names, scene.objects), _stack(case, transforms))


def _draw(case: EvalCase, transforms: Transforms) -> UInt8[np.ndarray, "H W 3"]:
    from iconjax.render.depth import depth_order
    from iconjax.render.raster import render

    scene = _scene(case)
    return render(scene, _stack(case, transforms), depth_order(scene).order)


def _scene(case: EvalCase) -> Scene:
    from iconjax.scene.build import build_scene

    return build_scene(case.image, Segmentation(case.mask, case.labels))


def _stack(case: EvalCase, transforms: Transforms) -> Float[np.ndarray, "n 2 3"]:
    return np.stack(list(read_transforms(transforms, sorted(case.labels)).values()))
