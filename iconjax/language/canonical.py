"""Programs in a form that is equal for equal meanings: to merge readings and to compare a program with a reference.

`equal(a, b)` and `equal(b, a)`, `div(x, 2)` and `mul(0.5, x)`, `minus(a, b)` on one side and `plus` on the other
come to the same: what is linear is brought to one side and divided by its first coefficient.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Mapping
from typing import TypeAlias

Form: TypeAlias = tuple[object, ...]
COMMUTATIVE = frozenset(
    {"union", "min_dist", "max_dist", "avg_dist", "angle", "together", "parallel", "perpendicular", "touch", "overlap"}
    | {"detach", "min", "max", "dist_x", "dist_y", "align_x", "align_y", "hinge"}
)
MOTIONS = frozenset({"translate", "rotate", "scale"})
DIGITS = 3
_Linear: TypeAlias = dict[Form, float]
"""Terms -> coefficients; the empty form is the constant."""


def canonical(line: str) -> Form:
    """A call in a form that is equal for equal meanings.

    Raises:
        SyntaxError, ValueError: the text is no call of the DSL.
    """
    return _form(ast.parse(line.strip(), mode="eval").body)


def same_meaning(one: Iterable[str], other: Iterable[str], members: Mapping[str, frozenset[int]]) -> bool:
    """Whether two programs say the same.

    Motion specifiers are compared loosely, as the constraints say most of them anyhow: each has to find one of any
    kind in the other program that shares a segment with it.

    Args:
        one, other: the programs.
        members: name -> ids of the segments it speaks of.
    """
    a, b = ({canonical(line) for line in program} for program in (one, other))
    if {f for f in a if f[0] not in MOTIONS} != {f for f in b if f[0] not in MOTIONS}:
        return False
    moved = [[members.get(str(f[1]), frozenset()) for f in forms if f[0] in MOTIONS] for forms in (a, b)]
    return all(any(m & n for n in moved[1 - side]) for side in (0, 1) for m in moved[side])


def _form(node: ast.expr) -> Form:
    match node:
        case ast.Call(func=ast.Name(id="equal"), args=[a, b]):
            return ("equal", *_compared(_difference(a, b), free=True))
        case ast.Call(func=ast.Name(id="larger"), args=[a, b]):
            return ("at least", *_compared(_difference(a, b), free=False))
        case ast.Call(func=ast.Name(id="smaller"), args=[a, b]):
            return ("at least", *_compared(_difference(b, a), free=False))
        case ast.Call(func=ast.Name(id=name), args=args) if name not in ("plus", "minus", "mul", "div"):
            inner = [_form(a) for a in args]
            if name == "coincide_on_point" and len(inner) == 4:  # the two points may be named in either order
                inner = [part for pair in sorted((inner[:2], inner[2:]), key=repr) for part in pair]
            return (name, *(sorted(inner, key=repr) if name in COMMUTATIVE else _plain(inner)))
        case ast.Constant(value=str(text)):
            return (text,)
        case ast.List(elts=elements):
            return ("point", *map(_form, elements))
    return ("value", *_terms(_linear(node)))


def _plain(inner: list[Form]) -> list[object]:
    """Names as they are, so that the first argument of a specifier can be looked up."""
    return [f[0] if len(f) == 1 and isinstance(f[0], str) else f for f in inner]


def _linear(node: ast.expr) -> _Linear:
    match node:
        case ast.Constant(value=int() | float() as value):
            return {(): float(value)}
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return _times(_linear(operand), -1.0)
        case ast.Call(func=ast.Name(id="plus"), args=args):
            return _sum(*map(_linear, args))
        case ast.Call(func=ast.Name(id="minus"), args=[a, b]):
            return _difference(a, b)
        case ast.Call(func=ast.Name(id="mul" | "div" as name), args=[a, b]):
            return _product(name, _linear(a), _linear(b))
    return {_form(node): 1.0}


def _product(name: str, a: _Linear, b: _Linear) -> _Linear:
    if set(b) <= {()}:
        factor = b.get((), 0.0)
        return _times(a, factor if name == "mul" else 1.0 / factor if factor else 0.0)
    if name == "mul" and set(a) <= {()}:
        return _times(b, a.get((), 0.0))
    parts: list[object] = [("value", *_terms(a)), ("value", *_terms(b))]
    return {(name, *(sorted(parts, key=repr) if name == "mul" else parts)): 1.0}


def _difference(a: ast.expr, b: ast.expr) -> _Linear:
    return _sum(_linear(a), _times(_linear(b), -1.0))


def _sum(*forms: _Linear) -> _Linear:
    out: _Linear = {}
    for form in forms:
        for term, factor in form.items():
            out[term] = out.get(term, 0.0) + factor
    return out


def _times(form: _Linear, factor: float) -> _Linear:
    return {term: factor * value for term, value in form.items()}


def _compared(form: _Linear, free: bool) -> Form:
    """Terms divided by the first coefficient; where the sign matters (`free` is false), by its size."""
    terms = sorted((t for t in form if t and abs(form[t]) > 1e-9), key=repr)
    lead = form[terms[0]] if terms else 1.0
    return _terms(_times(form, 1.0 / (lead if free else abs(lead))))


def _terms(form: _Linear) -> Form:
    kept = sorted(((t, round(v, DIGITS) + 0.0) for t, v in form.items() if abs(v) > 1e-9), key=repr)
    return tuple(kept)
