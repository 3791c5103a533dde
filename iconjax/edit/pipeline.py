"""The stages of an edit in order: load, translate, parse, search, draw."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from time import perf_counter
from typing import Any

import numpy as np

from iconjax import __version__
from iconjax.dsl.pretty import to_text
from iconjax.edit.attempt import Attempt, attempt, distinct, main_reading, reconsider
from iconjax.edit.choose import choose_translator
from iconjax.edit.config import EditConfig
from iconjax.edit.inputs import Inputs, open_inputs, program_text
from iconjax.edit.result import EditResult
from iconjax.errors import ConfigError, InputError, TranslationError
from iconjax.language.base import ManyReader, RelationJudge, Translation
from iconjax.language.llm.record import MissingRecordingError
from iconjax.relations.detect import detect_relations
from iconjax.render.depth import DepthOrder, depth_order
from iconjax.render.raster import render
from iconjax.scene.types import Scene
from iconjax.search.advice import Advice

Progress = Callable[[str], None]
MOST_READINGS = 8
"""Readings of one request that can be asked for."""


def run_edit(
    image: Any,
    seg: Any = None,
    request: str | None = None,
    *,
    labels: Any = None,
    translator: Any = None,
    program: Any = None,
    config: EditConfig | None = None,
    interpretations: int = 1,
    progress: Progress = lambda stage: None,
) -> EditResult:
    """Do what `iconjax.edit` promises, telling `progress` which stage begins."""
    if config is not None and not isinstance(config, EditConfig):
        raise ConfigError(f"config is a {type(config).__name__}; it has to be an EditConfig")
    check_interpretations(interpretations, program is not None)
    settings = (config or EditConfig()).to_search()
    progress("reading the picture")
    inputs = open_inputs(image, seg, request, labels)
    start = perf_counter()
    if program is None:
        progress("reading the request")
        chosen = choose_translator(translator)
        if interpretations > 1 and isinstance(chosen, ManyReader):
            chosen = chosen.with_readings(interpretations)
        translation = read_request(inputs.request, inputs.scene, chosen)
    else:
        chosen = None
        translation = Translation(_calls(program_text(program)), "program")
    translated = perf_counter() - start
    progress("searching")
    author = translation.translator if program is None else None
    advice, told = ask_advice(chosen, inputs.scene)
    first = attempt(inputs.scene, main_reading(translation), author, settings, advice)
    first, translation = reconsider(inputs.scene, first, translation, chosen, settings, advice)
    further = translation.readings[1:interpretations]
    others = [attempt(inputs.scene, reading, author, settings, advice) for reading in further]
    progress("drawing")
    results = [_draw(inputs, translation, one, translated, told) for one in distinct(inputs.scene, [first, *others])]
    return replace(results[0], interpretations=tuple(results) if interpretations > 1 else ())


def _draw(
    inputs: Inputs, translation: Translation, done: Attempt, translated: float, told: tuple[str, ...]
) -> EditResult:
    outcome, scene = done.outcome, inputs.scene
    start = perf_counter()
    depth = depth_order(scene)
    picture = render(scene, outcome.matrices, depth.order)
    return EditResult(
        image=picture,
        transforms={s.id: np.array(m, dtype=np.float64) for s, m in zip(scene.segments, outcome.matrices, strict=True)},
        program=tuple(to_text(done.program)),
        relations=outcome.relations,
        satisfied=not done.missed,
        constraints=outcome.constraints,
        score=float(outcome.score),
        motion_states=outcome.motion_states,
        depth_order=tuple(scene.segments[i].id for i in depth.order),
        timings={
            "translate": translated,
            "compile": float(outcome.timings.get("compile", 0.0)),
            "search": float(outcome.timings.get("search", 0.0)),
            "render": perf_counter() - start,
        },
        translator=translation.translator,
        rounds=translation.rounds,
        request=inputs.request,
        gloss=done.reading.gloss,
        understood=translation.understood,
        notes=(*(inputs.vector.notes if inputs.vector else ()), *told, *outcome.notes, *_depth_notes(scene, depth)),
        trace=outcome.trace,
        version=__version__,
        scene=scene,
        vector=inputs.vector,
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


def ask_advice(translator: object, scene: Scene) -> tuple[Advice, tuple[str, ...]]:
    """What a translator that can judge relations says of the scene's, and what the user should know about it."""
    if not isinstance(translator, RelationJudge):
        return Advice(), ()
    names = scene.names
    pairs = [(names[r.a], names[r.b]) for r in detect_relations(scene) if r.scope != "inter"]
    try:
        return Advice(crucial=translator.crucial(scene, pairs)), ()
    except MissingRecordingError:
        raise
    except TranslationError as error:  # advice is never needed: the stated rule does as well
        return Advice(), (f"which connections hold an object together was decided by rule: {error}",)


def check_interpretations(count: int, programmed: bool) -> None:
    """Whether so many readings can be asked for.

    Raises:
        ConfigError: not a number from 1 to 8, or several of a program, which has one meaning.
    """
    if isinstance(count, bool) or not isinstance(count, int) or not 1 <= count <= MOST_READINGS:
        raise ConfigError(f"interpretations is {count!r}; it can be 1 to {MOST_READINGS}")
    if count > 1 and programmed:
        raise ConfigError("a program has one interpretation: leave out interpretations, or give a request")


def _calls(program: str | tuple[str, ...]) -> tuple[str, ...]:
    return (program,) if isinstance(program, str) else program


def _depth_notes(scene: Scene, depth: DepthOrder) -> list[str]:
    notes = []
    for cycle in depth.cycles:
        names = ", ".join(scene.segments[i].name for i in cycle)
        notes.append(f"each of these lies in front of another, so their order was cut at one place: {names}")
    return notes
