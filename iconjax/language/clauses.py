"""What a request asks, clause by clause, before it becomes constraints."""

from __future__ import annotations

from dataclasses import dataclass

from iconjax.language.names import Phrase


@dataclass(frozen=True)
class Amount:
    """How much.

    Attributes:
        value: the number; percent and fractions as ratios (0.4), angles in degrees, lengths in pixels.
        unit: "ratio" (part of something), "times", "px", "deg" or "none" (a bare number).
        mode: "by", "to" or "" as written.
        of: the quantity that a ratio is a part of, where the request says so.
        vague: the request gave no number ("a bit").
    """

    value: float
    unit: str
    mode: str = ""
    of: Quantity | None = None
    vague: bool = False


@dataclass(frozen=True)
class Quantity:
    """A measure of things: "its height", "the width of the table", "the gap between the birds".

    Attributes:
        dim: vert, hori, length, thick, size, proportions, or "gap".
        owners: whose; empty for that of the clause's own theme.
    """

    dim: str
    owners: tuple[Phrase, ...] = ()


@dataclass(frozen=True)
class Clause:
    """One reading: what is asked of which things.

    Attributes:
        action: scale, move, place, rotate, orient, hinge, keep, stay, swap, gap, align or together.
        theme: names of what it is about, one constraint for each.
        amount: how much; None where the action needs none.
        dimension: extent or side that it speaks of.
        direction: left, right, up, down, cw, ccw or "".
        relation: on, above, touch, ...
        reference: names that the theme is related to.
        manner: further properties, e.g. "keep axis".
    """

    action: str
    theme: tuple[str, ...]
    amount: Amount | None = None
    dimension: str = ""
    direction: str = ""
    relation: str = ""
    reference: tuple[str, ...] = ()
    side: str | None = None
    theme_side: str | None = None
    manner: frozenset[str] = frozenset()
