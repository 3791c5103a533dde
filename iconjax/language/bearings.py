"""Which way "inwards", "outwards", "forward" and "back" lead for a thing of the picture."""

from __future__ import annotations

from collections.abc import Sequence

from iconjax.errors import TranslationError
from iconjax.language.hearing import label_words
from iconjax.language.lexicon import lexicon
from iconjax.language.shapes import Shapes

RELATIVE = frozenset({"in", "out", "forward", "backward"})
OPPOSITE = {"left": "right", "right": "left", "up": "down", "down": "up"}
STEPS = {"left": (-1.0, 0.0), "right": (1.0, 0.0), "up": (0.0, -1.0), "down": (0.0, 1.0)}
"""Direction -> its unit vector in pixels, y down."""
FACING = {"outer": "out", "inner": "in"}
"""Sides by where they face -> the direction in which they lie."""
SIDES_OF = {"left": "left", "right": "right", "up": "top", "down": "bottom"}
ENDS = ("front", "back")
LEAST = 0.02
"""Least offset that says a direction, as a share of the picture's larger side."""


def bearing(shapes: Shapes, name: str, direction: str, group: Sequence[str] = ()) -> str:
    """Left, right, up or down for a direction that depends on the thing.

    Args:
        direction: in, out, forward, backward; others come back as they are.
        group: the things whose middle "in" leads to; without others, the rest of the thing's object or the picture.

    Raises:
        TranslationError: the picture does not say which way that is.
    """
    if direction in ("in", "out"):
        inward = _inward(shapes, name, group)
        return inward if direction == "in" else OPPOSITE[inward]
    if direction in ("forward", "backward"):
        front = facing(shapes, name)
        return front if direction == "forward" else OPPOSITE[front]
    return direction


def side_facing(shapes: Shapes, owners: Sequence[str], side: str) -> str:
    """The side that is meant, where it is said by what it faces: "the outer edge of the left lamp".

    Raises:
        TranslationError: several things, or the picture as a whole, have several such sides.
    """
    if side not in FACING:
        return side
    if len(owners) != 1 or owners[0].startswith("@") or owners[0] == "canvas":
        raise TranslationError(f"which edge is the {side} one is not clear: say left, right, upper or lower")
    return SIDES_OF[bearing(shapes, owners[0], FACING[side])]


def _inward(shapes: Shapes, name: str, group: Sequence[str]) -> str:
    others = [n for n in group if n != name] or _rest(shapes, name)
    boxes = [shapes.box(n) for n in (*others, name)] if others else [shapes.box("canvas")]
    middle = [(min(b[a] for b in boxes) + max(b[a + 2] for b in boxes)) / 2 for a in (0, 1)]
    x, y = (m - c for m, c in zip(middle, shapes.centre(name), strict=True))
    if max(abs(x), abs(y)) < LEAST * shapes.scene.size:
        raise TranslationError(f'which way is inwards for "{name}" is not clear: say left, right, up or down')
    if abs(x) >= abs(y) or abs(x) > 2 * LEAST * shapes.scene.size:
        return "right" if x > 0 else "left"
    return "down" if y > 0 else "up"


def _rest(shapes: Shapes, name: str) -> list[str]:
    own = shapes.segments(name)
    ids = {s.id for s in own}
    return [s.name for s in shapes.scene.segments if own and s.object == own[0].object and s.id not in ids]


def facing(shapes: Shapes, name: str) -> str:
    """Left or right: where the parts that are in front by their names lie from those behind.

    Raises:
        TranslationError: no names tell, or they disagree.
    """
    own = {s.object for s in shapes.segments(name)}
    every = shapes.scene.segments
    for segments in ([s for s in every if s.object in own], every):
        places = {kind: [shapes.centre(s.name)[0] for s in segments if _is_end(s.name, kind)] for kind in ENDS}
        boxes = [shapes.box(s.name) for s in segments]
        middle = (min(b[0] for b in boxes) + max(b[2] for b in boxes)) / 2
        front, back = (sum(xs) / len(xs) if xs else middle for xs in places.values())
        if abs(front - back) > LEAST * shapes.scene.size:
            return "right" if front > back else "left"
    raise TranslationError("which way is forward is not clear: say left or right")


def _is_end(name: str, kind: str) -> bool:
    words = lexicon()
    return any(e.value == kind for w in label_words(name, words) for e in words.entries(w, "end"))


def turning(shapes: Shapes, name: str, direction: str) -> int:
    """1 for clockwise, -1 for counter-clockwise: the turn about its foot that carries a thing left or right.

    Raises:
        TranslationError: the thing lies level with where it turns.
    """
    (x, y), (px, py) = shapes.centre(name), shapes.pivot(name)
    step = STEPS[direction]
    along = -(y - py) * step[0] + (x - px) * step[1]  # how a clockwise turn moves its middle
    if abs(along) < LEAST * shapes.scene.size:
        raise TranslationError(f'which way "{name}" turns is not clear: say clockwise or counter-clockwise')
    return 1 if along > 0 else -1
