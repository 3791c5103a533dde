"""Units of values: their algebra, and the common scale on which violations are compared."""

from __future__ import annotations

import math
from enum import Enum
from typing import Any


class Unit(Enum):
    """What a value measures. Positions are lengths; a number literal has no unit until it meets one."""

    NUMBER = "number"
    RATIO = "ratio"
    DIRECTION = "direction"
    LENGTH = "length"
    AREA = "area"
    ANGLE = "angle"

    @property
    def symbol(self) -> str:
        """How the unit is written after a number: px, deg, px2, or nothing."""
        return {Unit.LENGTH: "px", Unit.ANGLE: "deg", Unit.AREA: "px2"}.get(self, "")


_BARE = (Unit.NUMBER, Unit.RATIO, Unit.DIRECTION)
_LENGTH_POWER = {Unit.NUMBER: 0, Unit.RATIO: 0, Unit.DIRECTION: 0, Unit.LENGTH: 1, Unit.AREA: 2}
_OF_POWER = {0: Unit.RATIO, 1: Unit.LENGTH, 2: Unit.AREA}


def same(a: Unit, b: Unit) -> Unit | None:
    """The unit of two values that are added or compared; None where that makes no sense."""
    if a == b or b is Unit.NUMBER:
        return a
    if a is Unit.NUMBER:
        return b
    return Unit.RATIO if a in _BARE and b in _BARE else None


def product(a: Unit, b: Unit) -> Unit | None:
    """The unit of a product; None where it has no name here (an angle times a length, a volume)."""
    if b is Unit.NUMBER:
        return a
    if a is Unit.NUMBER:
        return b
    if Unit.ANGLE in (a, b):
        return Unit.ANGLE if Unit.RATIO in (a, b) else None
    if {a, b} == {Unit.RATIO, Unit.DIRECTION}:
        return Unit.DIRECTION
    return _OF_POWER.get(_LENGTH_POWER[a] + _LENGTH_POWER[b])


def quotient(a: Unit, b: Unit) -> Unit | None:
    """The unit of a quotient; None where it has no name here (one over a length)."""
    if b is Unit.NUMBER:
        return a
    if a == b:
        return Unit.RATIO
    if a is Unit.ANGLE:
        return Unit.ANGLE if b is Unit.RATIO else None
    if b is Unit.ANGLE:
        return None
    if a is Unit.DIRECTION and b is Unit.RATIO:
        return Unit.DIRECTION
    return _OF_POWER.get(_LENGTH_POWER[a] - _LENGTH_POWER[b])


RULES = {"same": same, "product": product, "quotient": quotient}


def pixels_per_unit(unit: Unit, size: float) -> float:
    """How many pixels a violation of 1 is worth in a picture whose larger side is `size`.

    An angle moves the end of a lever as long as a quarter of the picture, and so does a change of direction
    or of a ratio; an area is the displacement of a side of that length.
    """
    lever = size / 4
    if unit is Unit.LENGTH:
        return 1.0
    if unit is Unit.ANGLE:
        return lever * math.pi / 180
    if unit is Unit.AREA:
        return 1 / lever
    return lever


def to_pixels(unit: Unit, value: Any, size: float) -> Any:
    """Bring a violation (a float or an array of any shape) in `unit` to the common scale, pixels."""
    return value * pixels_per_unit(unit, size)
