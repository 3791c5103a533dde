"""References made from the declarations: the Markdown page of `docs/`, plain text for terminals and prompts.

`python -m iconjax.dsl.docs` prints the Markdown page; with a path, writes it there.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

from iconjax.dsl.declarations import Group, Operator
from iconjax.dsl.problems import nearest
from iconjax.dsl.registry import Registry, default_registry
from iconjax.errors import InputError

_INTRO = """# The constraint language

<!-- Generated from dsl_specs/ by `python -m iconjax.dsl.docs docs/dsl.md`; change those. -->

A program is a list of calls, one a line; `#` begins a comment. Each call is a specifier: it states what the
edited picture has to fulfil. A segment is written as a string: `"Lamp:Shade"`, or `"Lamp"` for the union of
all its parts. Numbers are in pixels or degrees, whichever they are compared with; y points down, and angles
are positive clockwise on screen.

```text
scale("Pot")
equal(vert_len("Pot"), mul(0.5, vert_len(old("Pot"))))
touch("Plant", "Pot")
```
"""
_UNIT_TEXT = {
    "same": "that of its arguments",
    "product": "the product of its arguments' units",
    "quotient": "the quotient of its arguments' units",
    "length": "pixels",
    "angle": "degrees",
    "area": "square pixels",
    "direction": "component of a unit vector",
    "ratio": "ratio",
    "": "",
}


def to_markdown(registry: Registry | None = None) -> str:
    """The operator reference as a Markdown page."""
    registry = registry or default_registry()
    lines = [_INTRO]
    for group, operators in _grouped(registry):
        lines += [
            f"## {group.title}\n",
            f"{group.about}\n",
            "| call | meaning | unit | example |",
            "| --- | --- | --- | --- |",
        ]
        lines += [_row(o) for o in operators]
        lines.append("")
    lines += ["## Reserved names\n", "| name | meaning |", "| --- | --- |"]
    lines += [f'| `"{name}"` | {_cell(meaning)} |' for name, meaning in registry.names.items()]
    return "\n".join(lines) + "\n"


def to_reference(registry: Registry | None = None) -> str:
    """The operator reference as plain text, one operator a line under the title of its group."""
    registry = registry or default_registry()
    width = max(len(_call(o)) for o in registry.operators.values())
    blocks = []
    for group, operators in _grouped(registry):
        lines = [f"{group.title}: {group.about}", *(f"  {_call(o):<{width}}  {o.meaning}" for o in operators)]
        blocks.append("\n".join(lines))
    names = (f"  {name!r:<{width}}  {meaning}".replace("'", '"') for name, meaning in registry.names.items())
    blocks.append("\n".join(["Reserved names", *names]))
    return "\n\n".join(blocks)


def describe(name: str, registry: Registry | None = None) -> str:
    """One operator in full: signature, meaning, example.

    Raises:
        InputError: there is no such operator; the message names the nearest.
    """
    registry = registry or default_registry()
    operator = registry.operators.get(name)
    if operator is None:
        raise InputError(f"no operator is named {name[:80]}{nearest(name, tuple(registry.operators))}")
    title = registry.groups[operator.group].title
    return f"{operator.signature}\n  {title}: {operator.meaning}\n  e.g. {operator.example}"


def _grouped(registry: Registry) -> Iterator[tuple[Group, list[Operator]]]:
    for group in registry.groups.values():
        operators = [o for o in registry.operators.values() if o.group == group.name]
        if operators:
            yield group, operators


def _call(operator: Operator) -> str:
    params = ", ".join("[x, y]" if p.type == "Point" else p.name for p in operator.params)
    return f"{operator.name}({params}{', ...' if operator.variadic else ''})"


def _row(operator: Operator) -> str:
    unit = _UNIT_TEXT[operator.unit]
    return f"| `{_call(operator)}` | {_cell(operator.meaning)} | {unit} | `{_cell(operator.example)}` |"


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def main(arguments: list[str]) -> None:
    """Print the Markdown page, or write it to the path given."""
    page = to_markdown()
    if arguments:
        Path(arguments[0]).write_text(page, encoding="utf-8")
    else:
        sys.stdout.write(page)


if __name__ == "__main__":
    main(sys.argv[1:])
