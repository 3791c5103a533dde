"""The constraint language told on a terminal, from its declarations."""

from __future__ import annotations

from textwrap import wrap

from iconjax.dsl.problems import nearest
from iconjax.dsl.registry import default_registry
from iconjax.errors import InputError

WIDTH = 100


def list_operators() -> list[str]:
    """Every operator with its meaning, by group, one a line or two."""
    registry = default_registry()
    lines = []
    for group in registry.groups.values():
        lines += [group.title.upper(), *wrap(group.about, WIDTH, initial_indent="  ", subsequent_indent="  ")]
        for operator in registry.operators.values():
            if operator.group == group.name:
                lines += [f"  {operator.signature}", *_indented(operator.meaning, 6)]
        lines.append("")
    lines.append("RESERVED NAMES")
    for name, meaning in registry.names.items():
        lines += [f'  "{name}"', *_indented(meaning, 6)]
    return lines


def describe_operator(name: str) -> list[str]:
    """All about one operator.

    Raises:
        InputError: there is none of that name; the message holds the nearest.
    """
    registry = default_registry()
    operator = registry.operators.get(name)
    if operator is None:
        hint = nearest(name, list(registry.operators)) or "; 'iconjax dsl' lists them all"
        raise InputError(f"there is no operator {name!r}{hint}")
    group = registry.groups[operator.group]
    about = f"{group.title}: {group.about}"
    return [
        operator.signature,
        *_indented(operator.meaning, 4),
        f"    e.g. {operator.example}",
        *_indented(about, 4),
    ]


def _indented(text: str, by: int) -> list[str]:
    return wrap(text, WIDTH, initial_indent=" " * by, subsequent_indent=" " * by)
