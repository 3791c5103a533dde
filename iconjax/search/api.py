"""The one way into the search."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from iconjax.dsl.nodes import Program
from iconjax.dsl.pretty import to_text
from iconjax.dsl.registry import Registry, default_registry
from iconjax.dsl.units import Unit, pixels_per_unit
from iconjax.scene.types import Scene
from iconjax.search.advice import Advice
from iconjax.search.coherent import CoherentSearch
from iconjax.search.config import SearchConfig
from iconjax.search.hints import hint_matrices
from iconjax.search.motion import Motion, measure_motion
from iconjax.search.paper import PaperSearch
from iconjax.search.setup import Setup, prepare
from iconjax.search.types import ConstraintReport, RelationReport, SearchOutcome

TOLERANCE_PX, TOLERANCE_DEG, TOLERANCE_RATIO = 0.01, 2.0, 0.01
"""A constraint is satisfied within 1 % of the picture's size, 2 degrees, or 0.01 for bare numbers (contract,
section 8)."""


def search_edit(
    scene: Scene,
    program: Program,
    config: SearchConfig | None = None,
    registry: Registry | None = None,
    advice: Advice | None = None,
) -> SearchOutcome:
    """Find the transforms that meet `program` and leave `scene` coherent.

    Raises:
        ProgramError: the program does not type-check or is too large.
        InputError: more segments than the solver can hold.
    """
    config = config or SearchConfig()
    begin = time.perf_counter()
    advice = advice or Advice()
    setup = prepare(scene, program, config, registry, advice.crucial)
    search: CoherentSearch | PaperSearch
    if config.strategy == "paper":
        search = PaperSearch(setup, registry or default_registry(), config)
        state, solved = search.run()
        found = _Found(solved.matrices, solved.residuals, state.relations, solved.score, tuple(search.notes))
    else:
        search = CoherentSearch(setup, config, _guess(scene, advice))
        best = search.run()
        found = _Found(best.matrices, best.primary, best.judgement.outcomes, best.cost, ())
    n = len(scene.segments)
    motion = measure_motion(found.matrices, setup.setting.facts.features)
    names = scene.names
    relations = tuple(
        RelationReport(names[r.a], names[r.b], r.kind, r.scope, state)
        for r, state in zip(setup.setting.relations, found.relations, strict=True)
    )
    return SearchOutcome(
        matrices=found.matrices.reshape(n, 2, 3).copy(),
        motion_states={s.id: motion_word(motion, i) for i, s in enumerate(scene.segments)},
        relations=relations,
        constraints=report_constraints(setup, found.primary),
        score=found.score,
        trace=tuple(search.entries),
        timings={
            "compile": search.engine.compile_seconds,
            "search": time.perf_counter() - begin - search.engine.compile_seconds,
        },
        notes=found.notes,
    )


def _guess(scene: Scene, advice: Advice) -> Float[np.ndarray, "n 6"] | None:
    if not advice.guesses:
        return None
    where = {s.id: i for i, s in enumerate(scene.segments)}
    return hint_matrices(len(where), {where[k]: m for k, m in advice.guesses.items() if k in where})


@dataclass(frozen=True)
class _Found:
    """What either strategy finds; residuals of the primary constraints come first in `primary`."""

    matrices: Float[np.ndarray, "n 6"]
    primary: Float[np.ndarray, " c"]
    relations: tuple[str, ...]
    score: float
    notes: tuple[str, ...]


def motion_word(motion: Motion, i: int) -> str:
    """The motion state that a result amounts to."""
    if motion.shift[i] < 1e-6:
        return "N"
    scaled = np.abs(np.log(np.maximum(motion.scales[i], 1e-9))).max() > 1e-4
    return "T" + ("R" if abs(motion.turn[i]) > 1e-3 else "") + ("S" if scaled else "")


def report_constraints(setup: Setup, primary: Float[np.ndarray, " c"]) -> tuple[ConstraintReport, ...]:
    """The violation of each primary constraint, in its own unit."""
    size = setup.setting.size
    out = []
    for k, (call, unit) in enumerate(zip(setup.program.calls, setup.units, strict=True)):
        if unit is None:
            continue
        parts = [primary[j] for j, owner in enumerate(setup.compiled.owner) if owner == k]
        violation = float(np.linalg.norm(parts)) / pixels_per_unit(unit, size)
        holds = violation <= _tolerance(unit, size)
        out.append(ConstraintReport(to_text(call), "primary", violation, unit.symbol, holds))
    return tuple(out)


def _tolerance(unit: Unit, size: float) -> float:
    if unit is Unit.ANGLE:
        return TOLERANCE_DEG
    if unit in (Unit.LENGTH, Unit.AREA):
        return TOLERANCE_PX * size * (size / 4 if unit is Unit.AREA else 1.0)
    return TOLERANCE_RATIO


def satisfied(reports: Sequence[ConstraintReport]) -> bool:
    """Whether every constraint holds."""
    return all(r.satisfied for r in reports)
