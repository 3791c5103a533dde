"""What the readers of clauses share."""

from __future__ import annotations

from iconjax.language.clauses import Quantity
from iconjax.language.frames import Slots

FOLLOWING = frozenset(
    {"until", "till", "so that", "so", "such that", "in such a way that", "where", "in a way that", "to keep"}
)
"""Words that lead to a clause which says how far the one before goes."""
TURNED = ("parallel", "perpendicular")


def followed(slots: Slots) -> bool:
    """Whether the next clause says how far this one goes."""
    return slots.follows in FOLLOWING


def is_own(quantity: Quantity) -> bool:
    """Whether a measure is the theme's own ("its height")."""
    return all(p.pronoun is not None and p.owner is None and p.side is None for p in quantity.owners)


def listed(names: tuple[str, ...]) -> str:
    """Names in quotes."""
    return ", ".join(f'"{n}"' for n in names)
