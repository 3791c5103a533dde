"""The operators of a registry as the numbered functions that a compiled program refers to."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from typing import Any, NamedTuple

from iconjax.dsl.registry import Operator, Registry
from iconjax.dsl.units import Unit


class OperatorTable(NamedTuple):
    """Operators by number: leaves measure regions, steps compute with values (step 0 is a literal).

    Attributes:
        leaf_keys, step_keys: key of each operator, see `number`.
        leaf_kinds: what each leaf takes: "region", "regions" or "points" (two regions and two points).
        leaf_functions, step_functions: a pure scalar function for each.
        inter: the function behind `inter`.
        digest: identifies the table, for caches of compiled code.
    """

    leaf_keys: tuple[str, ...]
    leaf_kinds: tuple[str, ...]
    leaf_functions: tuple[Callable[..., Any], ...]
    step_keys: tuple[str, ...]
    step_functions: tuple[Callable[..., Any], ...]
    inter: Callable[..., Any]
    digest: str

    def leaf(self, name: str, component: int = 0, unit: Unit | None = None) -> int | None:
        """Number of component `component` of leaf operator `name` (for a specifier: of its residual), or None."""
        return _find(self.leaf_keys, name, component, unit)

    def step(self, name: str, component: int = 0, unit: Unit | None = None) -> int:
        """Number of a step operator."""
        found = _find(self.step_keys, name, component, unit)
        assert found is not None, f"{name} is neither a leaf nor a step"
        return found + 1


def _find(keys: tuple[str, ...], name: str, component: int, unit: Unit | None) -> int | None:
    for key in (_key(name, component, unit), _key(name, component, None)):
        if key in keys:
            return keys.index(key)
    return None


def _key(name: str, component: int, unit: Unit | None) -> str:
    return f"{name}#{component}" + (f"@{unit.value}" if unit else "")


_tables: dict[tuple[int, bool], tuple[Registry, OperatorTable]] = {}


def operator_table(registry: Registry, used: frozenset[str] = frozenset()) -> OperatorTable:
    """Number the operators of `registry` that have a function: of specifiers the residuals, of others the values.

    Comparing the outlines of two segments takes most of the time to compile. A program that `used` none of these
    operators gets a table without them; so there are two tables, whatever the program.
    """
    pairs = any(_compares(registry.operators[name]) for name in used) or not used
    key = (id(registry), pairs)
    if key not in _tables:  # the registry is kept, so that its id stays its own
        _tables[key] = (registry, _number(registry, pairs))
    return _tables[key][1]


def _compares(operator: Operator) -> bool:
    return operator.has_function and operator.outlines


def _number(registry: Registry, pairs: bool) -> OperatorTable:
    leaves: list[tuple[str, str, Callable[..., Any]]] = []
    steps: list[tuple[str, Callable[..., Any]]] = []
    for operator in registry.operators.values():
        if not operator.has_function or operator.returns == "Segment" or (_compares(operator) and not pairs):
            continue
        plain = _function(registry, operator, None)
        for unit in (None, Unit.ANGLE):
            function = _function(registry, operator, unit)
            if unit and function is plain:
                continue
            for component in range(operator.residual_size):
                key, one = (
                    _key(operator.name, component, unit),
                    _component(function, component, operator.residual_size),
                )
                kind = _kind(operator)
                if kind == "values":
                    steps.append((key, one))
                else:
                    leaves.append((key, kind, one))
    text = "|".join([*(k + d for k, d, _ in leaves), *(k for k, _ in steps)])
    own = "+".join(str(getattr(m, "__name__", m)) for m in registry.modules)
    return OperatorTable(
        leaf_keys=tuple(key for key, _, _ in leaves),
        leaf_kinds=tuple(kind for _, kind, _ in leaves),
        leaf_functions=tuple(function for _, _, function in leaves),
        step_keys=tuple(key for key, _ in steps),
        step_functions=tuple(function for _, function in steps),
        inter=registry.function("inter"),
        digest=hashlib.sha256(f"{text}|{own}".encode()).hexdigest()[:16],
    )


def _function(registry: Registry, operator: Operator, unit: Unit | None) -> Callable[..., Any]:
    return (registry.residual if operator.is_specifier else registry.function)(operator.name, unit)


def _component(function: Callable[..., Any], component: int, size: int) -> Callable[..., Any]:
    if size == 1:
        return function
    return lambda *args: function(*args)[component]


def _kind(operator: Operator) -> str:
    if operator.extra:
        return "points"
    segments = sum(p.type == "Segment" for p in operator.params)
    if not segments:
        return "values"
    return "region" if operator.variadic or segments == 1 else "regions"
