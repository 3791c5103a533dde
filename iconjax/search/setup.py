"""Everything an edit's search works with, made once: facts, relations, intent, the compiled program, the engine."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import networkx as nx
import numpy as np

from iconjax.dsl.check import check_or_raise
from iconjax.dsl.nodes import Call, Program, walk
from iconjax.dsl.registry import Registry, default_registry
from iconjax.dsl.units import Unit
from iconjax.errors import InputError
from iconjax.relations.detect import detect_relations
from iconjax.relations.graph import relation_graph
from iconjax.relations.types import Relation
from iconjax.scene.types import Scene
from iconjax.search.candidate import Setting, Sizes
from iconjax.search.config import SearchConfig
from iconjax.search.facts import Alignment, Facts, gather_facts
from iconjax.search.intent import Intent, read_intent
from iconjax.search.shapes import Shapes
from iconjax.solve.arrays import Alignments, Joints, Problem
from iconjax.solve.compile import CompiledProgram, compile_program
from iconjax.solve.engine import Engine
from iconjax.solve.regions import index_array, scene_hulls
from iconjax.solve.table import OperatorTable, operator_table

SEGMENTS = (16, 64, 256, 512)
BODIES = (8, 16, 32, 64, 128, 256, 512)
HULL = 24


@dataclass(frozen=True)
class Setup:
    """What a search works with.

    Attributes:
        scene, program: the edit.
        units: unit of each call's violation, None for motion specifiers.
        setting: facts, relations, intent and forces.
        shapes: outlines for judging.
        compiled: the program as arrays.
        problem: arrays that all candidates share.
        table: operators by number.
        sizes: static sizes, for the fewest bodies.
    """

    scene: Scene
    program: Program
    units: tuple[Unit | None, ...]
    setting: Setting
    shapes: Shapes
    compiled: CompiledProgram
    problem: Problem
    table: OperatorTable
    sizes: Sizes

    def engine(self, solver: str) -> Engine:
        """A new engine for this problem."""
        return Engine(self.problem, self.table, self.compiled.wide, solver)


def static_size(count: int, sizes: Sequence[int], what: str) -> int:
    """The smallest static size that holds `count`.

    Raises:
        InputError: more than the largest.
    """
    for size in sizes:
        if count <= size:
            return size
    raise InputError(f"the picture has {count} {what}; at most {sizes[-1]} are possible: merge some segments")


def prepare(
    scene: Scene,
    program: Program,
    config: SearchConfig,
    registry: Registry | None = None,
    crucial: frozenset[frozenset[str]] | None = None,
) -> Setup:
    """Measure the scene, read the program, build the arrays; `crucial` as in `detect_relations`."""
    registry = registry or default_registry()
    relations = detect_relations(scene, crucial)
    facts = gather_facts(scene, relations)
    intent = read_intent(program, scene)
    facts = replace(facts, alignments=(*_supports(facts, intent), *facts.alignments))
    setting = Setting(
        facts, relations, intent, config.forces, float(scene.size), _pieces(len(scene.segments), relations)
    )
    checked = check_or_raise(program, registry)
    motion = {o.name for o in registry.operators.values() if o.is_motion}
    units = tuple(None if c.name in motion else checked.unit(c) for c in program.calls)
    n = static_size(len(scene.segments), SEGMENTS, "segments")
    sizes = Sizes(n, _grown(len(relations), 2 * n), _grown(len(facts.alignments), 4 * n), BODIES[0])
    table = operator_table(
        registry, frozenset(node.name for c in program.calls for node in walk(c) if isinstance(node, Call))
    )
    compiled = compile_program(
        program, units, scene, relations, table,
        {o.name: o.residual_size for o in registry.operators.values()},
        frozenset(o.name for o in registry.operators.values() if o.variadic), n,
    )  # fmt: skip
    problem = Problem(
        compiled.code, compiled.regions, _joints(relations, sizes), _alignments(facts, sizes),
        scene_hulls(scene, HULL, n), np.array([0.0, scene.width, 0.0, scene.height]),
    )  # fmt: skip
    return Setup(scene, program, units, setting, Shapes(scene, relations), compiled, problem, table, sizes)


def _pieces(count: int, relations: Sequence[Relation]) -> tuple[int, ...]:
    firm = [r for r in relations if r.scope != "inter" and r.kind != "near"]
    graph = relation_graph(firm, range(count))
    number = {i: k for k, piece in enumerate(nx.connected_components(graph)) for i in piece}
    return tuple(number[i] for i in range(count))


def _supports(facts: Facts, intent: Intent) -> list[Alignment]:
    """What is put on top of something has its centre over what it stands on."""
    out = []
    for above, below in intent.placed:
        lowest = max(above, key=lambda i: facts.features[i, 5])
        top = min(below, key=lambda i: facts.features[i, 3])
        width = float(facts.features[top, 2] - facts.features[top, 0])
        off = abs(float(facts.features[lowest, 1] - facts.features[top, 1]))
        slack = off if off < 0.45 * width else 0.1 * width  # what is above it already need not be centred
        out.append(Alignment(lowest, top, 1, "support", slack, slack, 0.0))
    return out


def _grown(count: int, least: int) -> int:
    size = least
    while size < count:
        size *= 2
    return size


def _joints(relations: Sequence[Relation], sizes: Sizes) -> Joints:
    e, still = sizes.relations, sizes.segments
    points_a, points_b, tangent = np.zeros((e, 3, 2)), np.zeros((e, 3, 2)), np.tile([1.0, 0.0], (e, 1))
    for k, r in enumerate(relations):
        pairs = np.stack([r.contact.middle, r.contact.first, r.contact.second])
        points_a[k], points_b[k] = pairs[:, 0], pairs[:, 1]
        along = (r.contact.second - r.contact.first).mean(0)
        length = float(np.linalg.norm(along))
        nx, ny = r.contact.normal
        tangent[k] = along / length if length > 4 else (-ny, nx)
    a = index_array([r.a for r in relations], e, still)
    b = index_array([r.b for r in relations], e, still)
    return Joints(a, b, points_a, points_b, tangent)


def _alignments(facts: Facts, sizes: Sizes) -> Alignments:
    rows, still = facts.alignments, sizes.segments
    f = sizes.alignments
    offset, slack = np.zeros(f), np.zeros(f)
    for k, a in enumerate(rows):
        before = facts.features[a.a, a.feature] - (0.0 if a.b is None else facts.features[a.b, a.feature])
        offset[k] = (before if a.wanted is None else a.wanted) + (a.high - a.low) / 2
        slack[k] = (a.high + a.low) / 2
    return Alignments(
        index_array([a.a for a in rows], f, still),
        index_array([still if a.b is None else a.b for a in rows], f, still),
        index_array([a.feature for a in rows], f, 0),
        offset,
        slack,
    )
