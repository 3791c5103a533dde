"""The stages of an edit in order: load, translate, parse, search, draw."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from time import perf_counter
from typing import Any

import numpy as np
from jaxtyping import UInt8

from iconjax import __version__
from iconjax.dsl.nodes import Program
from iconjax.dsl.parse import parse
from iconjax.dsl.pretty import to_text
from iconjax.edit.choose import choose_translator
from iconjax.edit.config import EditConfig
from iconjax.edit.inputs import Inputs, open_inputs, program_text
from iconjax.edit.result import EditResult
from iconjax.errors import ConfigError, InputError, ProgramError, TranslationError
from iconjax.language.base import Translation
from iconjax.render.depth import DepthOrder, depth_order
from iconjax.render.raster import render
from iconjax.scene.types import Scene
from iconjax.search.api import search_edit
from iconjax.search.types import SearchOutcome

Progress = Callable[[str], None]


def run_edit(
    image: Any,
    seg: Any = None,
    request: str | None = None,
    *,
    labels: Any = None,
    translator: Any = None,
    program: Any = None,
    config: EditConfig | None = None,
    progress: Progress = lambda stage: None,
) -> EditResult:
    """Do what `iconjax.edit` promises, telling `progress` which stage begins."""
    if config is not None and not isinstance(config, EditConfig):
        raise ConfigError(f"config is a {type(config).__name__}; it has to be an EditConfig")
    settings = (config or EditConfig()).to_search()
    progress("reading the picture")
    inputs = open_inputs(image, seg, request, labels)
    scene = inputs.scene
    start = perf_counter()
    if program is None:
        progress("reading the request")
        translation = read_request(inputs.request, scene, translator)
        parsed = _parse(translation.program, scene, translation.translator)
    else:
        translation = Translation((), "program")
        parsed = _parse(program_text(program), scene, None)
    translated = perf_counter()
    progress("searching")
    outcome = search_edit(scene, parsed, settings)
    searched = perf_counter()
    progress("drawing")
    depth = depth_order(scene)
    picture = render(scene, outcome.matrices, depth.order)
    timings = {
        "translate": translated - start,
        "compile": float(outcome.timings.get("compile", 0.0)),
        "search": float(outcome.timings.get("search", searched - translated)),
        "render": perf_counter() - searched,
    }
    return _result(inputs, translation, parsed, outcome, depth, picture, timings)


def _result(
    inputs: Inputs,
    translation: Translation,
    program: Program,
    outcome: SearchOutcome,
    depth: DepthOrder,
    picture: UInt8[np.ndarray, "H W 3"],
    timings: dict[str, float],
) -> EditResult:
    segments = inputs.scene.segments
    return EditResult(
        image=picture,
        transforms={s.id: np.array(m, dtype=np.float64) for s, m in zip(segments, outcome.matrices, strict=True)},
        program=tuple(to_text(program)),
        relations=outcome.relations,
        satisfied=all(c.satisfied for c in outcome.constraints),
        constraints=outcome.constraints,
        score=float(outcome.score),
        motion_states=outcome.motion_states,
        depth_order=tuple(segments[i].id for i in depth.order),
        timings=timings,
        translator=translation.translator,
        request=inputs.request,
        understood=translation.understood,
        notes=(*outcome.notes, *_depth_notes(inputs.scene, depth)),
        trace=outcome.trace,
        version=__version__,
        scene=inputs.scene,
    )


def read_request(request: str, scene: Scene, translator: Any = None) -> Translation:
    """The request as constraints, by the translator wanted or chosen.

    Raises:
        InputError: there is no request.
        ConfigError: there is no such translator.
        TranslationError: the request was not understood.
    """
    chosen = choose_translator(translator)
    if not request.strip():
        raise InputError("the request is empty: say what to change, or give a program")
    return chosen.translate(request, scene)


def _parse(calls: str | Sequence[str], scene: Scene, author: str | None) -> Program:
    try:
        return parse(calls, scene.names, scene.objects)
    except ProgramError as error:
        if author is None:  # the caller's own program
            raise
        raise TranslationError(f"translator {author!r} wrote constraints that are not valid: {error}") from error


def _depth_notes(scene: Scene, depth: DepthOrder) -> list[str]:
    notes = []
    for cycle in depth.cycles:
        names = ", ".join(scene.segments[i].name for i in cycle)
        notes.append(f"each of these lies in front of another, so their order was cut at one place: {names}")
    return notes
