"""The operators of the DSL: their declarations, and the functions bound to them (imported when asked for)."""

from __future__ import annotations

import functools
import importlib
import inspect
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

from iconjax.dsl.declarations import Declarations, Group, Operator, Param, read_declarations
from iconjax.dsl.operators import MODULES, Binding, bindings
from iconjax.dsl.units import Unit
from iconjax.errors import ConfigError

__all__ = ["Group", "Operator", "Param", "Registry", "default_registry", "specs_folder"]


def specs_folder() -> Path:
    """The folder of the library's own declarations: in an installed package, or at the root of a checkout."""
    installed = Path(__file__).parent / "specs"
    return installed if installed.is_dir() else Path(__file__).parents[2] / "dsl_specs"


@dataclass(frozen=True)
class Registry:
    """What programs may be made of. Loading it needs no JAX; asking for a function imports operator modules.

    Attributes:
        operators: declarations by name, in the order in which references list them.
        groups: groups by name, in order.
        names: reserved segment names with their meaning ("canvas").
        modules: modules, or their import names, that bind functions to the operators.
    """

    operators: Mapping[str, Operator]
    groups: Mapping[str, Group]
    names: Mapping[str, str]
    modules: tuple[str | ModuleType, ...]

    @classmethod
    def load(cls, specs: Path, modules: Iterable[str | ModuleType]) -> Registry:
        """A registry of the declarations at `specs` (a file or a folder), implemented by `modules`."""
        declared = read_declarations(specs)
        return cls(declared.operators, declared.groups, declared.names, tuple(modules))

    def extended(self, specs: Path | str, *modules: str | ModuleType) -> Registry:
        """This registry with more operators: a user's own specs file or folder, and modules that bind them.

        Raises:
            ConfigError: a declaration is faulty or takes a name that is taken, or the modules do not fit it.
        """
        more: Declarations = read_declarations(Path(specs))
        if taken := sorted(self.operators.keys() & more.operators.keys()):
            raise ConfigError(f"operator names already taken: {', '.join(taken)}")
        registry = Registry(
            {**self.operators, **more.operators},
            {**self.groups, **{k: v for k, v in more.groups.items() if k not in self.groups}},
            {**self.names, **more.names},
            (*self.modules, *modules),
        )
        registry.verify()
        return registry

    def verify(self) -> None:
        """Import the operator modules and check them against the declarations, both ways and in arity.

        Raises:
            ConfigError: lists everything that does not fit.
        """
        self._functions  # noqa: B018 - the property does the checking

    def function(self, name: str, unit: Unit | None = None) -> Callable[..., Any]:
        """The function of an operator; of a specifier, its violation: a scalar >= 0 in the unit of the call.

        It takes a `Region` for each Segment parameter and a scalar for each Value. Variadic operators take
        two values, or the one union region, and are folded by the caller. `unit` is the unit of the call,
        where it matters: angles are compared the shorter way round.
        """
        return self._lookup(name, "value", unit)

    def residual(self, name: str, unit: Unit | None = None) -> Callable[..., Any]:
        """The residual of a specifier, for least squares; it takes the same arguments as `function`.

        A scalar, or a vector of the operator's `residual_size`, whose norm is the violation; signed and
        smooth through zero where the constraint is two-sided.
        """
        return self._lookup(name, "residual", unit)

    def _lookup(self, name: str, role: str, unit: Unit | None) -> Callable[..., Any]:
        wanted = unit.value if unit else None
        functions = self._functions
        for key in (Binding(name, role, wanted), Binding(name, role, None)):
            if key in functions:
                return functions[key]
        raise ConfigError(f"operator {name} has no {role} function")

    @functools.cached_property
    def _functions(self) -> Mapping[Binding, Callable[..., Any]]:
        functions: dict[Binding, Callable[..., Any]] = {}
        faults: list[str] = []
        for module in self.modules:
            loaded = importlib.import_module(module) if isinstance(module, str) else module
            for binding, function in bindings(loaded):
                if binding in functions:
                    faults.append(f"{binding.name} is implemented twice ({binding.role})")
                functions[binding] = function
                faults += _misfits(binding, function, self.operators.get(binding.name))
        for operator in self.operators.values():
            roles = ("value", "residual") if operator.is_specifier else ("value",)
            missing = [r for r in roles if operator.has_function and Binding(operator.name, r, None) not in functions]
            faults += [f"{operator.name} is declared but has no {role} function" for role in missing]
        if faults:
            raise ConfigError("operator declarations and functions differ: " + "; ".join(faults))
        return functions


def _misfits(binding: Binding, function: Callable[..., Any], operator: Operator | None) -> list[str]:
    if operator is None:
        return [f"{binding.name} is implemented but not declared"]
    if not operator.has_function:
        return [f"{binding.name} takes no function"]
    if binding.role == "residual" and not operator.is_specifier:
        return [f"{binding.name} is no specifier and has no residual"]
    count = len(inspect.signature(function).parameters)
    if count != operator.arity:
        return [f"{binding.name} is declared with {operator.arity} arguments, its {binding.role} takes {count}"]
    return []


@functools.cache
def default_registry() -> Registry:
    """The library's own operators."""
    return Registry.load(specs_folder(), MODULES)
