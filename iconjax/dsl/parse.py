"""Text to syntax tree: Python's grammar, a whitelist of its nodes, limits on size and depth; never `eval`."""

from __future__ import annotations

import ast
import warnings
from collections.abc import Collection, Iterable, Sequence

from iconjax.dsl.check import check
from iconjax.dsl.layout import Chunk, chunks
from iconjax.dsl.nodes import Call, Invalid, Node, Number, Point, Program, SegmentRef
from iconjax.dsl.problems import InvalidProgramError, Problem
from iconjax.dsl.registry import Registry, default_registry

MAX_CHARS = 100_000
MAX_CALLS = 400
MAX_CALL_CHARS = 8_000
MAX_DEPTH = 24
MAX_NUMBER = 1e9

_WRITE_AS = {ast.Add: "plus", ast.Sub: "minus", ast.Mult: "mul", ast.Div: "div"}


def parse(
    text: str | Sequence[str],
    names: Collection[str] | None,
    objects: Collection[str] | None = (),
    registry: Registry | None = None,
) -> Program:
    """Parse and type-check a constraint program.

    Args:
        text: one call a line with `#` comments, or a sequence of calls (a problem's line is then its number).
        names: the unique segment names; None accepts any name.
        objects: the object names, each the union of its parts.
        registry: the operators; by default the library's own.

    Raises:
        ProgramError: lists all errors with line, column and the nearest valid name; `problems` holds them
            one by one.
    """
    registry = registry or default_registry()
    program, problems = parse_syntax(text)
    known = None if names is None else (*names, *(objects or ()), *registry.names)
    problems = [*problems, *check(program, registry, known).problems]
    if problems:
        raise InvalidProgramError(problems)
    return program


def parse_syntax(text: str | Sequence[str]) -> tuple[Program, list[Problem]]:
    """The syntax tree of a program, with `Invalid` nodes for what has no meaning, and the problems found.

    Raises:
        ProgramError: the program is empty or beyond the limits, so that going on makes no sense.
    """
    entries = [text] if isinstance(text, str) else list(text)
    if sum(map(len, entries)) > MAX_CHARS:
        raise InvalidProgramError([Problem(1, 1, f"a program has at most {MAX_CHARS} characters")])
    problems: list[Problem] = []
    calls: list[Call] = []
    for count, chunk in enumerate(chunks(entries, numbered=not isinstance(text, str), parses=_parses), start=1):
        calls += _Reader(chunk, problems).calls()
        if max(count, len(calls)) > MAX_CALLS:
            raise InvalidProgramError([Problem(chunk.line, 1, f"a program has at most {MAX_CALLS} calls")])
    if not calls and not problems:
        raise InvalidProgramError([Problem(1, 1, "the program is empty: write one call a line")])
    return Program(tuple(calls)), problems


def _python(text: str) -> ast.Module | Problem:
    """Python's syntax tree of one call, or what is wrong with it."""
    if len(text) > MAX_CALL_CHARS:
        return Problem(1, 1, f"a call has at most {MAX_CALL_CHARS} characters")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return ast.parse(text)
    except SyntaxError as error:
        return Problem(error.lineno or 1, max(error.offset or 1, 1), f"not a call: {error.msg}")
    except (ValueError, MemoryError, RecursionError):
        return Problem(1, 1, "not a call: unreadable or nested too deeply")


def _parses(text: str) -> bool:
    return isinstance(_python(text), ast.Module)


class _Reader:
    """Turns the Python syntax of one chunk of text into nodes; notes problems and goes on."""

    def __init__(self, chunk: Chunk, problems: list[Problem]) -> None:
        self.chunk = chunk
        self.problems = problems

    def calls(self) -> Iterable[Call]:
        tree = _python(self.chunk.text)
        if isinstance(tree, Problem):
            self.problems.append(Problem(*self.place(tree.line, tree.column), tree.message))
            return
        for statement in tree.body:
            value = statement.value if isinstance(statement, ast.Expr) else None
            if isinstance(value, ast.Call):
                node = self.read(value, 1)
                if isinstance(node, Call):
                    yield node
            else:
                self.note(statement, 'every line is one call, e.g. touch("Cup", "Table")')

    def read(self, node: ast.expr, depth: int) -> Node:
        at = self.at(node)
        if depth > MAX_DEPTH:
            return self.note(node, f"nested more than {MAX_DEPTH} deep")
        if isinstance(node, ast.Call):
            return self.read_call(node, depth)
        if isinstance(node, ast.Constant):
            return self.read_constant(node)
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.UAdd):
            value = self.read(node.operand, depth + 1)
            if isinstance(node.op, ast.UAdd) or isinstance(value, Invalid):
                return value
            if isinstance(value, Number):
                return Number(-value.value, *at)
            return Call("mul", (Number(-1.0, *at), value), *at)
        if isinstance(node, ast.List | ast.Tuple):
            return self.read_point(node, depth)
        if isinstance(node, ast.Name):
            return self.note(node, f'write a segment as a string: "{node.id[:80]}"')
        if isinstance(node, ast.BinOp) and type(node.op) in _WRITE_AS:
            return self.note(node, f"arithmetic is written as a call: {_WRITE_AS[type(node.op)]}(a, b)")
        return self.note(node, "only calls, strings, numbers and points [x, y] are allowed")

    def read_call(self, node: ast.Call, depth: int) -> Node:
        if not isinstance(node.func, ast.Name):
            return self.note(node, "an operator is called by its bare name")
        if node.keywords:
            return self.note(node, f"{node.func.id[:80]} takes no keyword arguments")
        return Call(node.func.id, tuple(self.read(a, depth + 1) for a in node.args), *self.at(node))

    def read_constant(self, node: ast.Constant) -> Node:
        value = node.value
        if isinstance(value, str):
            return SegmentRef(value, *self.at(node))
        if isinstance(value, bool) or not isinstance(value, int | float):
            return self.note(node, f"{str(value)[:40]} is neither a number nor a segment")
        if not abs(value) <= MAX_NUMBER:
            return self.note(node, f"a number is at most {MAX_NUMBER:.0e}")
        return Number(float(value), *self.at(node))

    def read_point(self, node: ast.List | ast.Tuple, depth: int) -> Node:
        parts = [self.read(e, depth + 1) for e in node.elts[:3]]
        if any(isinstance(p, Invalid) for p in parts):
            return Invalid(*self.at(node))
        x, y = parts if len(parts) == 2 else (None, None)
        if not (isinstance(x, Number) and isinstance(y, Number)):
            return self.note(node, "a point is written as two numbers: [x, y]")
        return Point(x.value, y.value, *self.at(node))

    def place(self, line: int, column: int) -> tuple[int, int]:
        column += self.chunk.indent if line == 1 else 0
        return self.chunk.line + (0 if self.chunk.numbered else line - 1), column

    def at(self, node: ast.expr | ast.stmt) -> tuple[int, int]:
        """1-based line and column, in characters (Python counts bytes)."""
        lines = self.chunk.text.split("\n")
        before = (
            lines[node.lineno - 1].encode("utf-8", "replace")[: node.col_offset] if node.lineno <= len(lines) else b""
        )
        return self.place(node.lineno, len(before.decode("utf-8", "replace")) + 1)

    def note(self, node: ast.expr | ast.stmt, message: str) -> Invalid:
        line, column = self.at(node)
        self.problems.append(Problem(line, column, message))
        return Invalid(line, column)
