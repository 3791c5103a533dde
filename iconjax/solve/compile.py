"""From a checked program to the instructions and regions that the solver runs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from iconjax.dsl.nodes import Call, Node, Number, Point, Program, SegmentRef
from iconjax.dsl.pretty import to_text
from iconjax.dsl.units import Unit, pixels_per_unit
from iconjax.errors import ProgramError
from iconjax.relations.types import Relation
from iconjax.scene.types import Scene
from iconjax.solve.arrays import Code, Regions
from iconjax.solve.regions import (
    RegionSpec,
    build_regions,
    canvas_material,
    frozen,
    index_array,
    materials_of,
    side_of,
)
from iconjax.solve.table import OperatorTable

LEAVES, STEPS, REGIONS, OUTPUTS = (16, 48, 256), (32, 96, 512), (8, 24, 128), (8, 24, 128)
"""Static sizes of a program: leaves, steps, regions, residuals."""
SIDES = {"top", "bot", "left", "right"}


@dataclass(frozen=True)
class CompiledProgram:
    """A program as arrays.

    Attributes:
        code, regions: what the solver runs.
        owner: for each residual, the position of the call it belongs to.
        wide: whether a region is an intersection, which needs larger arrays.
    """

    code: Code
    regions: Regions
    owner: tuple[int, ...]
    wide: bool


@dataclass(frozen=True)
class _Register:
    """Where a value is: leaf or step number `index`."""

    leaf: bool
    index: int


@dataclass
class _Build:
    scene: Scene
    relations: Sequence[Relation]
    table: OperatorTable
    variadic: frozenset[str]
    leaves: list[tuple[int, int, int, tuple[float, ...]]] = field(default_factory=list)
    steps: list[tuple[int, _Register, _Register, float]] = field(default_factory=list)
    specs: list[RegionSpec] = field(default_factory=list)
    known_regions: dict[Node, int] = field(default_factory=dict)
    known_values: dict[Node, _Register] = field(default_factory=dict)

    def value(self, node: Node) -> _Register:
        """Register that holds a value; equal expressions share one."""
        if node not in self.known_values:
            self.known_values[node] = self._value(node)
        return self.known_values[node]

    def _value(self, node: Node) -> _Register:
        if isinstance(node, Number):
            itself = _Register(True, 0)
            self.steps.append((0, itself, itself, node.value))
            return _Register(False, len(self.steps) - 1)
        assert isinstance(node, Call)
        if node.name in self.variadic and len(node.args) > 2:
            return self.value(Call(node.name, (Call(node.name, node.args[:-1]), node.args[-1])))
        return self.apply(node, 0, None)

    def apply(self, call: Call, component: int, unit: Unit | None) -> _Register:
        """One leaf or step for a component of a call."""
        number = self.table.leaf(call.name, component, unit)
        if number is None:
            x, y = self.value(call.args[0]), self.value(call.args[-1])
            self.steps.append((self.table.step(call.name, component, unit), x, y, 0.0))
            return _Register(False, len(self.steps) - 1)
        if self.table.leaf_kinds[number] == "region":
            a = b = self.region(call.args[0] if len(call.args) == 1 else Call("union", call.args))
            extra: tuple[float, ...] = ()
        else:
            segments = [arg for arg in call.args if not isinstance(arg, Point)]
            a, b = self.region(segments[0]), self.region(segments[1])
            extra = self.extra(call, segments) if self.table.leaf_kinds[number] == "points" else ()
        self.leaves.append((number, a, b, (*extra, 0.0, 0.0, 0.0, 0.0)[:4]))
        return _Register(True, len(self.leaves) - 1)

    def extra(self, call: Call, segments: Sequence[Node]) -> tuple[float, ...]:
        points = [p for p in call.args if isinstance(p, Point)]
        if points:
            return tuple(v for p in points for v in (p.x, p.y))
        (px, py), (qx, qy) = meeting_point(self.scene, self.relations, self.spec(segments[0]), self.spec(segments[1]))
        return px, py, qx, qy

    def region(self, node: Node) -> int:
        """Number of a region; equal expressions share one."""
        if node not in self.known_regions:
            spec = self.spec(node)
            self.specs.append(spec)
            self.known_regions[node] = len(self.specs) - 1
        return self.known_regions[node]

    def spec(self, node: Node) -> RegionSpec:
        if isinstance(node, SegmentRef):
            if node.name == "canvas":
                return RegionSpec((canvas_material(self.scene),))
            return RegionSpec(materials_of(self.scene, self.scene.members(node.name)))
        assert isinstance(node, Call)
        if node.name == "inter":
            return RegionSpec((), (self.region(node.args[0]), self.region(node.args[1])))
        inner = [self.spec(a) for a in node.args]
        if any(s.meet for s in inner):
            raise ProgramError(f"{to_text(node)}: an intersection cannot be used inside {node.name}; use it directly")
        materials = tuple(m for s in inner for m in s.materials)
        if node.name == "old":
            return RegionSpec(frozen(materials))
        if node.name in SIDES:
            return RegionSpec(side_of(materials, node.name))
        return RegionSpec(materials)


def compile_program(
    program: Program,
    units: Sequence[Unit | None],
    scene: Scene,
    relations: Sequence[Relation],
    table: OperatorTable,
    residual_sizes: dict[str, int],
    variadic: frozenset[str],
    segments: int,
) -> CompiledProgram:
    """Compile the constraints of `program`; motion specifiers leave no residual.

    Args:
        units: unit of each call's violation, None for motion specifiers.
        residual_sizes: number of residuals of each specifier.
        variadic: operators that take any number of arguments.
        segments: number of segments that arrays are padded to.

    Raises:
        ProgramError: larger than the largest static size, or an intersection where none can be.
    """
    build = _Build(scene, relations, table, variadic)
    outputs: list[tuple[_Register, int, float]] = []
    for k, (call, unit) in enumerate(zip(program.calls, units, strict=True)):
        if unit is None:
            continue
        for component in range(residual_sizes[call.name]):
            outputs.append((build.apply(call, component, unit), k, pixels_per_unit(unit, scene.size)))
    return _pack(build, outputs, segments)


def _static(count: int, sizes: tuple[int, ...], what: str) -> int:
    for size in sizes:
        if count <= size:
            return size
    raise ProgramError(f"the program needs {count} {what}; at most {sizes[-1]} are possible: split the request")


def _pack(build: _Build, outputs: list[tuple[_Register, int, float]], segments: int) -> CompiledProgram:
    # The four sizes grow together, so that there are few combinations to compile.
    needs = (
        (len(build.leaves), LEAVES, "measurements"), (len(build.steps), STEPS, "operations"),
        (len(build.specs), REGIONS, "regions"), (len(outputs), OUTPUTS, "constraints"),
    )  # fmt: skip
    level = max(sizes.index(_static(count, sizes, what)) for count, sizes, what in needs)
    leaves, steps, rows, outs = (sizes[level] for _, sizes, _ in needs)

    def number(r: _Register) -> int:
        return r.index if r.leaf else leaves + r.index

    extra, literal, scale = np.zeros((leaves, 4)), np.zeros(steps), np.zeros(outs)
    for k, (_, _, _, points) in enumerate(build.leaves):
        extra[k] = points
    literal[: len(build.steps)] = [v for _, _, _, v in build.steps]
    scale[: len(outputs)] = [s for _, _, s in outputs]
    code = Code(
        leaf_op=index_array([op for op, *_ in build.leaves], leaves, 0),
        region_a=index_array([a for _, a, _, _ in build.leaves], leaves, 0),
        region_b=index_array([b for _, _, b, _ in build.leaves], leaves, 0),
        extra=extra,
        leaves=np.array(len(build.leaves)),
        step_op=index_array([op for op, *_ in build.steps], steps, 0),
        value_a=index_array([number(x) for _, x, _, _ in build.steps], steps, 0),
        value_b=index_array([number(y) for _, _, y, _ in build.steps], steps, 0),
        literal=literal,
        steps=np.array(len(build.steps)),
        out=index_array([number(r) for r, _, _ in outputs], outs, 0),
        scale=scale,
    )
    wide = any(s.meet for s in build.specs)
    return CompiledProgram(code, build_regions(build.specs, segments, rows), tuple(k for _, k, _ in outputs), wide)


def meeting_point(
    scene: Scene, relations: Sequence[Relation], a: RegionSpec, b: RegionSpec
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Where two regions meet, as a material point of each: at the centre of a pin, if one of them is one; else their
    tightest relation; else their nearest points."""
    for spec in (b, a):
        centre = _pin(spec)
        if centre is not None:
            return centre, centre
    first, second = {m.carrier for m in a.materials}, {m.carrier for m in b.materials}
    best = None
    for r in relations:
        swap = r.b in first and r.a in second
        if swap or (r.a in first and r.b in second):
            p, q = r.contact.middle[::-1] if swap else r.contact.middle
            if best is None or r.contact.gap < best[0]:
                best = (r.contact.gap, p, q)
    if best is None:
        points_a = np.concatenate([loop for m in a.materials for loop in m.loops])
        points_b = np.concatenate([loop for m in b.materials for loop in m.loops])
        apart = np.linalg.norm(points_a[:, None] - points_b[None], axis=-1)
        i, j = np.unravel_index(apart.argmin(), apart.shape)
        best = (0.0, points_a[i], points_b[j])
    (px, py), (qx, qy) = best[1], best[2]
    return (float(px), float(py)), (float(qx), float(qy))


PIN = 0.08
"""How far the area of a pin may be from that of the disc in its box."""


def _pin(spec: RegionSpec) -> tuple[float, float] | None:
    """The centre of a region that is a single disc: what turns at a bolt, a wheel or a hub turns about its centre."""
    if len(spec.materials) != 1 or len(spec.materials[0].loops) != 1:
        return None
    loop = spec.materials[0].loops[0]
    (x0, y0), (x1, y1) = loop.min(0), loop.max(0)
    square = min(x1 - x0, y1 - y0) > 0.88 * max(x1 - x0, y1 - y0)
    if not square or abs(spec.materials[0].area / (np.pi / 4 * (x1 - x0) * (y1 - y0)) - 1) > PIN:
        return None
    return float(x0 + x1) / 2, float(y0 + y1) / 2
