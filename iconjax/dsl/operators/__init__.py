"""The functions behind the operators: pure JAX functions over `Region`s and scalars, bound by name.

The library's own modules are listed in `MODULES`; they import JAX, this file does not.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from types import ModuleType
from typing import Any, NamedTuple, TypeVar

MODULES = tuple(
    f"iconjax.dsl.operators.{name}"
    for name in ("arithmetic", "values", "attributes", "relations", "placement", "motion", "boolean")
)
_F = TypeVar("_F", bound=Callable[..., Any])


class Binding(NamedTuple):
    """What a function is bound to.

    Attributes:
        name: name of the operator.
        role: "value" for what the operator returns (a specifier: its violation), "residual" for the signed
            form.
        unit: name of the only unit it is for, or None for all others.
    """

    name: str
    role: str
    unit: str | None


def implements(name: str, *, unit: str | None = None) -> Callable[[_F], _F]:
    """Bind a function to operator `name`: it returns the value; of a specifier, the violation (>= 0)."""
    return _bind(Binding(name, "value", unit))


def residual_of(name: str, *, unit: str | None = None) -> Callable[[_F], _F]:
    """Bind a function to the residual of specifier `name`: a scalar or vector whose norm is the violation."""
    return _bind(Binding(name, "residual", unit))


def bindings(module: ModuleType) -> Iterator[tuple[Binding, Callable[..., Any]]]:
    """All functions that `module` binds."""
    for function in list(vars(module).values()):
        if getattr(function, "__module__", None) == module.__name__:
            for binding in getattr(function, "__implements__", ()):
                yield binding, function


def _bind(binding: Binding) -> Callable[[_F], _F]:
    def decorate(function: _F) -> _F:
        bound = (*getattr(function, "__implements__", ()), binding)
        function.__implements__ = bound  # type: ignore[attr-defined]
        return function

    return decorate
