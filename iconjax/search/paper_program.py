"""The paper's secondary constraints as rows of the same program as the primary ones, switched by a mask."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from jaxtyping import Float, Int

from iconjax.dsl.nodes import Call, Program, SegmentRef
from iconjax.dsl.registry import Registry
from iconjax.dsl.units import Unit
from iconjax.relations.types import Relation
from iconjax.search.setup import BODIES, Setup, static_size
from iconjax.solve.arrays import Code, Regions
from iconjax.solve.compile import CompiledProgram, compile_program
from iconjax.solve.regions import index_array
from iconjax.solve.table import OperatorTable, operator_table
from iconjax.solve.violation import Violations

TIERS = (
    (16, 16, 8, 16),
    (32, 32, 16, 32),
    (48, 48, 16, 48),
    (64, 64, 24, 64),
    (96, 96, 32, 96),
    (160, 160, 48, 160),
)
"""Static sizes of a program with its secondary constraints: leaves, steps, regions, residuals. Beyond the
last, the sizes of `solve.compile` are kept."""


@dataclass(frozen=True)
class PaperProgram:
    """The program of a search.

    Attributes:
        violations: its arrays.
        table: operators by number.
        wide: whether a region is an intersection.
        primary: how many primary constraints there are; they come first.
        weak, strong: relation number -> row of its function, and of `coincide_on_point`.
    """

    violations: Violations
    table: OperatorTable
    wide: bool
    primary: int
    weak: Mapping[int, int]
    strong: Mapping[int, int]

    def active(self, states: Sequence[str]) -> Float[np.ndarray, " g"]:
        """The mask for relation states, by relation number ("ST", "WK", "N")."""
        mask = np.zeros(self.violations.allowed.shape)
        mask[: self.primary] = 1.0
        for e, row in self.weak.items():
            mask[row] = states[e] != "N"
            mask[self.strong[e]] = states[e] == "ST"
        return mask

    def sizes(self, residuals: Float[np.ndarray, " c"]) -> Float[np.ndarray, " g"]:
        """The violation of every constraint, px, before anything is allowed for."""
        rows, edges = len(self.violations.allowed), len(self.violations.a)
        owner = np.concatenate([self.violations.owner, np.repeat(np.arange(rows - edges, rows), 2)])
        return np.sqrt(np.bincount(owner, residuals**2, rows)[:rows])

    def excess(self, residuals: Float[np.ndarray, " c"]) -> Float[np.ndarray, " g"]:
        """The violation of every constraint beyond what is allowed, px."""
        beyond = self.sizes(residuals) - np.asarray(self.violations.allowed)
        return np.where(beyond > 0, beyond, 0.0)

    def allowing(self, residuals: Float[np.ndarray, " c"]) -> PaperProgram:
        """The program in which secondary constraints may be violated as far as in the unedited picture, which
        has `residuals`: connected parts may have a thin white gap between them."""
        allowed: Any = self.sizes(residuals)
        allowed[: self.primary] = 0.0
        return replace(self, violations=self.violations._replace(allowed=allowed))


def build_program(setup: Setup, registry: Registry, edges: Sequence[int], movable: Sequence[int]) -> PaperProgram:
    """Compile the program of `setup` together with the function of each relation in `edges`.

    Segments are numbered by their place in `movable`; all others never move.
    """
    constraints = [(c, u) for c, u in zip(setup.program.calls, setup.units, strict=True) if u is not None]
    calls, units = [c for c, _ in constraints], [u for _, u in constraints]
    primary, relations, names = len(calls), setup.setting.relations, setup.scene.names
    calls += [_weak(relations[e], names) for e in edges]
    units += [Unit.LENGTH] * len(edges)
    table = operator_table(registry)
    compiled = compile_program(
        Program(tuple(calls)), units, setup.scene, relations, table,
        {o.name: o.residual_size for o in registry.operators.values()},
        frozenset(o.name for o in registry.operators.values() if o.variadic), setup.sizes.segments,
    )  # fmt: skip
    code, regions = trim(compiled)
    size = static_size(len(movable), BODIES, "moving parts")
    where = np.full(setup.sizes.segments + 1, size)
    where[list(movable)] = np.arange(len(movable))
    outs, meetings = code.out.shape[0], max(16, 2 ** (len(edges) - 1).bit_length())
    arrays: dict[str, Any] = {
        "owner": index_array(compiled.owner, outs, outs + meetings),
        **_meetings([relations[e] for e in edges], meetings, where, size),
        "allowed": np.zeros(outs + meetings),
    }
    violations = Violations(code, _renumbered(regions, where, size), canvas=setup.problem.canvas, **arrays)
    weak, strong = ({e: start + k for k, e in enumerate(edges)} for start in (primary, outs))
    return PaperProgram(violations, table, compiled.wide, primary, weak, strong)


def _weak(relation: Relation, names: Sequence[str]) -> Call:
    return Call(relation.kind, (SegmentRef(names[relation.a]), SegmentRef(names[relation.b])))


def _renumbered(regions: Regions, where: Int[np.ndarray, " n"], still: int) -> Regions:
    share = np.zeros((len(regions.share), still + 1))
    np.add.at(share.T, where, np.asarray(regions.share).T)
    arrays: dict[str, Any] = {
        "hull_segment": where[np.asarray(regions.hull_segment)],
        "segment": where[np.asarray(regions.segment)],
        "share": share,
    }
    return regions._replace(**arrays)


def _meetings(relations: Sequence[Relation], rows: int, where: Int[np.ndarray, " n"], still: int) -> dict[str, Any]:
    """Where relations meet: one place, as material of both; across a gap it is in neither."""
    meeting = np.zeros((rows, 2))
    for e, r in enumerate(relations):
        meeting[e] = r.contact.middle.mean(0)
    a, b = [where[r.a] for r in relations], [where[r.b] for r in relations]
    return {"a": index_array(a, rows, still), "b": index_array(b, rows, still), "meeting": meeting}


def trim(compiled: CompiledProgram) -> tuple[Code, Regions]:
    """The program in smaller arrays: one residual more does not have to double all of them."""
    code, regions = compiled.code, compiled.regions
    named = int(np.max([np.append(x, -1).max() for x in (code.region_a, code.region_b, regions.first, regions.second)]))
    used = (int(code.leaves), int(code.steps), named + 1, len(compiled.owner))
    tier = next((t for t in TIERS if all(u <= size for u, size in zip(used, t, strict=True))), None)
    whole = code.leaf_op.shape[0]
    if tier is None or tier[0] >= whole:
        return code, regions
    leaves, steps, rows, outs = tier

    def register(numbers: Any) -> Any:
        return np.where(numbers >= whole, numbers - whole + leaves, numbers)

    smaller = code._replace(
        **{name: getattr(code, name)[:leaves] for name in ("leaf_op", "region_a", "region_b", "extra")},
        **{name: getattr(code, name)[:steps] for name in ("step_op", "literal")},
        value_a=register(code.value_a[:steps]),
        value_b=register(code.value_b[:steps]),
        out=register(code.out[:outs]),
        scale=code.scale[:outs],
    )
    return smaller, Regions(*(x[:rows] for x in regions))
