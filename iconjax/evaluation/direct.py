"""The paper's baselines as editors: a model gives the transforms (`dm`), or all constraints, solved once (`dc`)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np
from jaxtyping import Float

from iconjax.evaluation.asking import baseline_exchange, read_motions, read_program
from iconjax.evaluation.cases import EvalCase
from iconjax.evaluation.editors import Edited, draw, measure_reference, scene_of
from iconjax.evaluation.methods import Method
from iconjax.evaluation.model import Meter, open_client
from iconjax.language.llm.hints import hint_matrix
from iconjax.language.llm.settings import LlmSettings
from iconjax.scene.types import Scene


@dataclass(frozen=True)
class DirectEditor:
    """`dm` or `dc` as a way to edit.

    Attributes:
        method: which, and whether the model sees the picture.
        settings: of the model, or of the recordings that answer in its place.
    """

    method: Method
    settings: LlmSettings

    def __call__(self, case: EvalCase) -> Edited:
        """Ask, and do what the reply says.

        Raises:
            LlmError: there is no reply, or it does not have the form asked for.
            ProgramError: its constraints do not parse or type-check.
        """
        begin = perf_counter()
        scene = scene_of(case)
        meter = Meter(open_client(self.method.translator, self.settings))
        reply = meter.send(baseline_exchange(self.method.base, case.request, scene, self.method.image))
        asked = perf_counter()
        timings = {"translate": asked - begin}
        if self.method.base == "dm":
            program: tuple[str, ...] = ()
            moved = {h.segment: hint_matrix(h, _box(scene, h.segment)) for h in read_motions(reply.text, scene)}
            transforms = {s.id: moved[s.name] for s in scene.segments if s.name in moved}
        else:
            program = read_program(reply.text)
            matrices, seconds = solve_once(scene, program)
            transforms = {s.id: m for s, m in zip(scene.segments, matrices, strict=True)}
            timings |= seconds
        solved = perf_counter()
        image = draw(case, transforms)
        end = perf_counter()
        timings["render"] = end - solved
        details = {"program": list(program), "reply": reply.text, "usage": meter.counts(), "timings": timings}
        return Edited(transforms, image, measure_reference(case, transforms), details, end - begin)


def solve_once(scene: Scene, program: tuple[str, ...]) -> tuple[Float[np.ndarray, "n 2 3"], Mapping[str, float]]:
    """Solve a program as the paper solves a state: no relations found in the picture, no search.

    Returns:
        The transform of each segment, and the seconds for "compile" and "search".

    Raises:
        ProgramError: it does not parse or type-check.
    """
    from iconjax.dsl.parse import parse  # late, because these bring JAX
    from iconjax.dsl.registry import default_registry
    from iconjax.search.config import SearchConfig
    from iconjax.search.paper import PaperSearch
    from iconjax.search.setup import prepare

    begin = perf_counter()
    config = SearchConfig(strategy="paper", relation_search=False, motion_search=False)
    setup = prepare(scene, parse(program, scene.names, scene.objects), config)
    alone = replace(setup, setting=replace(setup.setting, relations=()))
    search = PaperSearch(alone, default_registry(), config)
    _, solved = search.run()
    seconds, compiling = perf_counter() - begin, search.engine.compile_seconds
    return solved.matrices.reshape(-1, 2, 3).copy(), {"compile": compiling, "search": seconds - compiling}


def _box(scene: Scene, name: str) -> tuple[float, float, float, float]:
    return next(s.box for s in scene.segments if s.name == name)
