"""Read operator declarations (the TOML files of `dsl_specs/`) into records; refuse faulty ones."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from iconjax.dsl.units import RULES, Unit
from iconjax.errors import ConfigError

TYPES = ("Segment", "Value", "Point")
RETURNS = ("None", "Violation", "Value", "Segment")
EXTRAS = ("", "points", "contact")


@dataclass(frozen=True)
class Param:
    """A parameter: its name and its type, "Segment", "Value" or "Point"."""

    name: str
    type: str


@dataclass(frozen=True)
class Group:
    """A group of operators, as it is shown in references."""

    name: str
    title: str
    about: str


@dataclass(frozen=True)
class Operator:
    """The declaration of one operator.

    Attributes:
        name: as written in programs.
        group: name of its group, e.g. "derived".
        params: what it takes; with `variadic`, the last may be repeated.
        returns: "None" (a motion specifier), "Violation" (a constraint), "Value" or "Segment".
        unit: of the value or violation: the name of a `Unit`, or a rule over the arguments: "same",
            "product", "quotient". Empty where there is none.
        meaning: one line, with the names of `params`.
        example: one call.
        structural: resolved by the compiler (it selects material); has no function.
        named: takes names of segments or unions of them, not material made from them.
        extra: "points" or "contact" when the function takes the two material points as a last argument, an
            array (x, y, u, v) of places before the edit: from the program, or supplied by the compiler.
        residual_size: length of the residual of a specifier, 1 for a scalar.
        outlines: compares two whole outlines, which is dear to compile and to run.
    """

    name: str
    group: str
    params: tuple[Param, ...]
    returns: str
    unit: str
    meaning: str
    example: str
    variadic: bool = False
    structural: bool = False
    named: bool = False
    extra: str = ""
    residual_size: int = 1
    outlines: bool = False

    @property
    def is_motion(self) -> bool:
        """Whether it is a motion specifier."""
        return self.returns == "None"

    @property
    def is_specifier(self) -> bool:
        """Whether a program may consist of calls to it."""
        return self.returns in ("None", "Violation")

    @property
    def has_function(self) -> bool:
        """Whether a function is bound to it."""
        return not (self.is_motion or self.structural)

    @property
    def arity(self) -> int:
        """Number of arguments of the bound function: one for each parameter but points, and the extra."""
        return sum(p.type != "Point" for p in self.params) + bool(self.extra)

    @property
    def signature(self) -> str:
        """E.g. `touch(S: Segment, T: Segment) -> Violation [length]`."""
        params = ", ".join(f"{p.name}: {p.type}" for p in self.params) + (", ..." if self.variadic else "")
        return f"{self.name}({params}) -> {self.returns}" + (f" [{self.unit}]" if self.unit else "")


@dataclass(frozen=True)
class Declarations:
    """Everything that one or more specs files declare, in their order."""

    operators: Mapping[str, Operator]
    groups: Mapping[str, Group]
    names: Mapping[str, str]


def read_declarations(path: Path) -> Declarations:
    """Read one specs file, or all of a folder in the order of their file names.

    Raises:
        ConfigError: no such file, not TOML, or a declaration is incomplete, has unknown fields or is made
        twice.
    """
    files = sorted(path.glob("*.toml")) if path.is_dir() else [path]
    if not files or not all(f.is_file() for f in files):
        raise ConfigError(f"no operator declarations (*.toml) at {path}")
    operators: dict[str, Operator] = {}
    groups: dict[str, Group] = {}
    names: dict[str, str] = {}
    for file in files:
        table = _load(file)
        group = str(table.get("group", ""))
        if group:
            groups[group] = Group(group, str(table.get("title", group)), str(table.get("about", "")))
        for entry in table.get("operator", ()):
            operator = _operator(entry, group, file)
            if operator.name in operators:
                raise ConfigError(f"{file.name}: operator {operator.name} is declared twice")
            operators[operator.name] = operator
        names |= {str(entry["name"]): str(entry["meaning"]) for entry in table.get("name", ())}
    return Declarations(operators, groups, names)


def _load(file: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(file.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ConfigError(f"{file.name}: not readable as TOML: {error}") from None


def _operator(entry: Mapping[str, Any], group: str, file: Path) -> Operator:
    where = f"{file.name}: operator {entry.get('name', '?')}"
    required = {"name", "params", "returns", "meaning", "example"}
    optional = {"unit", "variadic", "structural", "named", "extra", "residual_size", "outlines"}
    if missing := sorted(required - entry.keys()):
        raise ConfigError(f"{where}: {', '.join(missing)} missing")
    if unknown := sorted(entry.keys() - required - optional):
        raise ConfigError(f"{where}: unknown field {', '.join(unknown)}")
    params = tuple(Param(*(s.strip() for s in p.partition(":")[::2])) for p in entry["params"])
    operator = Operator(**{"unit": "", **entry, "group": group, "params": params})
    _require(group, where, "a file with operators names their group")
    _require(operator.name.isidentifier(), where, "the name is no identifier")
    _require(
        bool(params) and all(p.type in TYPES for p in params),
        where,
        f"parameter types are {', '.join(TYPES)}",
    )
    _require(operator.returns in RETURNS, where, f"returns is one of {', '.join(RETURNS)}")
    _require(operator.extra in EXTRAS, where, "extra is one of points, contact")
    has_unit = operator.returns in ("Violation", "Value")
    known = operator.unit in RULES or operator.unit in {u.value for u in Unit}
    _require(known if has_unit else not operator.unit, where, "unit is missing, unknown, or out of place")
    return operator


def _require(condition: object, where: str, message: str) -> None:
    if not condition:
        raise ConfigError(f"{where}: {message}")
