"""The type check: names, arguments and units of a program, all errors at once."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from iconjax.dsl.declarations import Operator, Param
from iconjax.dsl.nodes import Call, Invalid, Node, Number, Point, Program, SegmentRef
from iconjax.dsl.problems import InvalidProgramError, Problem, nearest
from iconjax.dsl.registry import Registry
from iconjax.dsl.units import RULES, Unit

_A = {
    "Segment": "a segment",
    "Value": "a value",
    "Point": "a point [x, y]",
    "Violation": "a constraint of its own",
    "None": "a motion",
}


@dataclass(frozen=True)
class Checked:
    """What the check found out.

    Attributes:
        units: the unit of every value in the program, and of the violation of every top-level call but the
            motion specifiers. Nodes compare by structure, so equal expressions share an entry.
        problems: all errors; empty for a valid program.
    """

    units: Mapping[Node, Unit]
    problems: tuple[Problem, ...]

    def unit(self, node: Node) -> Unit:
        """The unit of a value, or of the violation of a specifier."""
        return self.units[node]


def check(program: Program, registry: Registry, names: Collection[str] | None = None) -> Checked:
    """Type-check a program; `names` are the valid segment, object and reserved names (None: any)."""
    checker = _Checker(registry, None if names is None else tuple(dict.fromkeys(names)))
    for call in program.calls:
        checker.statement(call)
    return Checked(checker.units, tuple(checker.problems))


def check_or_raise(program: Program, registry: Registry, names: Collection[str] | None = None) -> Checked:
    """`check`, raising ProgramError with all errors."""
    checked = check(program, registry, names)
    if checked.problems:
        raise InvalidProgramError(checked.problems)
    return checked


@dataclass(frozen=True)
class _Type:
    """What a node is: a type of `TYPES` or `RETURNS`, "?" if already reported; and the unit, where known."""

    name: str
    unit: Unit | None = None


_UNKNOWN = _Type("?")


@dataclass
class _Checker:
    registry: Registry
    names: tuple[str, ...] | None
    units: dict[Node, Unit] = field(default_factory=dict)
    problems: list[Problem] = field(default_factory=list)

    def statement(self, call: Call) -> None:
        found = self.infer(call)
        if found.name in ("Value", "Segment"):
            self.note(
                call,
                f"{call.name} gives {_A[found.name]}, which states nothing; compare it, e.g. with equal(...)",
            )

    def infer(self, node: Node) -> _Type:
        if isinstance(node, Number):
            self.units[node] = Unit.NUMBER
            return _Type("Value", Unit.NUMBER)
        if isinstance(node, SegmentRef):
            return self.infer_name(node)
        if isinstance(node, Call):
            return self.infer_call(node)
        return _Type("Point") if isinstance(node, Point) else _UNKNOWN

    def infer_name(self, node: SegmentRef) -> _Type:
        if self.names is not None and node.name not in self.names:
            self.note(node, f'no segment is named "{node.name[:80]}"{nearest(node.name, self.names)}')
        return _Type("Segment")

    def infer_call(self, call: Call) -> _Type:
        operator = self.registry.operators.get(call.name)
        found = [self.infer(arg) for arg in call.args]
        if operator is None:
            self.note(
                call,
                f"no operator is named {call.name[:80]}{nearest(call.name, tuple(self.registry.operators))}",
            )
            return _UNKNOWN
        if not self.right_count(call, operator):
            return _Type(operator.returns)
        for i, (arg, type_) in enumerate(zip(call.args, found, strict=True)):
            self.argument(arg, type_, operator.params[min(i, len(operator.params) - 1)], operator)
        unit = self.unit_of(call, operator, [t.unit for t in found if t.name in ("Value", "?")])
        if unit is not None:
            self.units[call] = unit
        return _Type(operator.returns, unit)

    def right_count(self, call: Call, operator: Operator) -> bool:
        least, given = len(operator.params), len(call.args)
        if given == least or (operator.variadic and given > least):
            return True
        wanted = f"{least}{' or more' if operator.variadic else ''} argument{'s' if least > 1 else ''}"
        self.note(call, f"{call.name} takes {wanted}, not {given}: {operator.signature}")
        return False

    def argument(self, arg: Node, found: _Type, param: Param, operator: Operator) -> None:
        if found.name not in (param.type, "?"):
            self.note(arg, f"{operator.name} takes {_A[param.type]} here, not {_A[found.name]}")
        elif param.type == "Segment" and (operator.is_motion or operator.named):
            self.named_material(arg, operator)

    def named_material(self, arg: Node, operator: Operator) -> None:
        """What is to move must be segments, not a piece of one or a copy of it, and not the picture."""
        if isinstance(arg, Call) and arg.name == "union":
            for part in arg.args:
                self.named_material(part, operator)
        elif isinstance(arg, Call):
            self.note(arg, f"{operator.name} takes a segment by its name, not {arg.name[:80]}(...)")
        elif isinstance(arg, SegmentRef) and arg.name in self.registry.names:
            self.note(arg, f'"{arg.name}" does not move; {operator.name} takes a segment')

    def unit_of(self, call: Call, operator: Operator, units: list[Unit | None]) -> Unit | None:
        if operator.unit not in RULES:
            return Unit(operator.unit) if operator.unit else None
        if not units or any(u is None for u in units):
            return None
        total = units[0]
        for unit in units[1:]:
            assert total is not None and unit is not None
            combined = RULES[operator.unit](total, unit)
            if combined is None:
                self.note(call, f"{call.name} cannot combine {_with_unit(total)} and {_with_unit(unit)}")
                return None
            total = combined
        return total

    def note(self, node: Node, message: str) -> None:
        if not isinstance(node, Invalid):
            self.problems.append(Problem(node.line, node.column, message))


def _with_unit(unit: Unit) -> str:
    return f"{'an' if unit.value[0] == 'a' else 'a'} {unit.value}"
