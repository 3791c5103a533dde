"""How far given transforms are from meeting a program: for edits that the search did not make."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float

from iconjax.dsl.nodes import Program
from iconjax.dsl.registry import Registry
from iconjax.scene.types import Scene
from iconjax.search.api import report_constraints
from iconjax.search.config import SearchConfig
from iconjax.search.setup import Setup, prepare
from iconjax.search.types import ConstraintReport
from iconjax.solve.cache import compiled, precise_cpu
from iconjax.solve.program import residuals


def measure_program(
    scene: Scene, program: Program, matrices: Float[np.ndarray, "n 2 3"], registry: Registry | None = None
) -> tuple[ConstraintReport, ...]:
    """The violation of each constraint of `program` when the segments of `scene` are moved by `matrices`.

    Raises:
        ProgramError: the program does not type-check or is too large.
    """
    setup = prepare(scene, program, SearchConfig(), registry)
    return report_constraints(setup, _residuals(setup, matrices))


def _residuals(setup: Setup, matrices: Float[np.ndarray, "n 2 3"]) -> Float[np.ndarray, " c"]:
    count = setup.sizes.segments
    padded = np.tile([1.0, 0.0, 0.0, 0.0, 1.0, 0.0], (count, 1))
    padded[: len(matrices)] = np.asarray(matrices, float).reshape(-1, 6)
    table, wide = setup.table, setup.compiled.wide

    def run(code, regions, moved):  # type: ignore[no-untyped-def]
        return residuals(code, regions, moved, np.arange(count), table, wide)[0]

    arguments: Sequence[object] = (setup.compiled.code, setup.compiled.regions, padded)
    with precise_cpu():
        executable, _ = compiled(f"measure|{wide}|{table.digest}", run, tuple(arguments))
        return np.asarray(executable(*arguments))[: len(setup.compiled.owner)]
