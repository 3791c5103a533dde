"""What a program may not ask at once."""

from __future__ import annotations

import ast
from collections.abc import Sequence

from iconjax.errors import TranslationError


def check_values(program: Sequence[str]) -> None:
    """One quantity cannot become two values: "extend it 40 px to the right and 20 px to the left".

    Raises:
        TranslationError: a quantity is set to two different values.
    """
    told: dict[str, tuple[str, str]] = {}
    for line in program:
        call = ast.parse(line, mode="eval").body
        if isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id == "equal":
            left, right = call.args
            offset = ""
            if isinstance(left, ast.Call) and ast.unparse(left.func) == "minus" and _is_known(left.args[1]):
                offset = ast.unparse(left.args[1])  # "a - b is c": a is b + c
                left = left.args[0]
            if _is_known(right):
                value = (ast.unparse(right), offset)
                if told.setdefault(ast.unparse(left), value) != value:
                    raise TranslationError(f"two different values are asked of {ast.unparse(left)}")


def _is_known(node: ast.AST) -> bool:
    """Whether an expression is known before the edit: numbers, and what speaks of `old` only."""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "old":
        return True
    if isinstance(node, ast.Constant):
        return not isinstance(node.value, str)
    return all(_is_known(child) for child in ast.iter_child_nodes(node))
