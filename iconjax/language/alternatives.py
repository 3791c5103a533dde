"""Other readings of clauses that leave something open: which way to turn, whether "half as big" speaks of area."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from iconjax.language.clauses import Amount, Clause


def variants(clauses: Sequence[Clause]) -> list[list[Clause]]:
    """The clauses as read, and then with one thing after the other that is open taken differently."""
    out = [list(clauses)]
    for at, clause in enumerate(clauses):
        out.extend([*clauses[:at], other, *clauses[at + 1 :]] for other in _others(clause))
    return out


def _others(clause: Clause) -> Iterator[Clause]:
    amount = clause.amount
    if amount is None:
        return
    if clause.action == "rotate" and not clause.direction and amount.value > 0:
        # nearly always one of the two is meant, and the request does not say which
        yield from (replace(clause, direction=sense) for sense in ("cw", "ccw"))
    if clause.action == "scale" and clause.dimension == "size" and _says_area(amount):
        yield replace(clause, amount=replace(amount, value=round(math.sqrt(amount.value), 4)))
    if clause.action in ("scale", "move", "rotate") and amount.mode == "unsaid":
        yield replace(clause, amount=_stronger(clause.action, amount))


def _says_area(amount: Amount) -> bool:
    """Whether a factor of size may be one of area: "half as big", "twice the size"."""
    return (
        amount.unit == "factor"
        and not amount.vague
        and any(math.isclose(amount.value, v) for v in (0.25, 0.5, 2, 3, 4))
    )


def _stronger(action: str, amount: Amount) -> Amount:
    """The amount of a change that the request leaves open, once more as large."""
    if action == "scale":
        return replace(
            amount, value=round(amount.value + (amount.value - 1), 4) if amount.value > 1 else round(amount.value**2, 4)
        )
    return replace(amount, value=2 * amount.value)
