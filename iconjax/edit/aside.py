"""What an edit did besides what was asked, and what it had to assume: a few short lines for the command line."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from jaxtyping import Float

from iconjax.dsl.nodes import segment_names
from iconjax.dsl.parse import parse
from iconjax.edit.explain import centre, describe_motion

if TYPE_CHECKING:
    from iconjax.edit.result import EditResult
    from iconjax.scene.types import Scene

SEEN_PX = 0.5
"""What moves less than this at every corner of its box seems to stay."""
SHOWN = 4
"""Segments that are named in a line; of more, the number is told."""
LONGEST = 220
"""Characters of a line."""
GUESS = "names no amount"
"""In a line of the built-in translator that tells of an amount it chose."""


def asides(result: EditResult) -> list[str]:
    """At most three lines: what else moved, which amounts were chosen, and what else the translator noted."""
    lines = []
    if others := also_moved(result):
        lines.append(f"also moved: {_listed(others, len(result.scene.segments))}")
    # A language model's lines are its reading, in words that nothing is known of.
    guesses, notes = assumptions(result.understood, result.scene) if result.translator == "offline" else ([], [])
    if guesses:
        chosen = dict.fromkeys(_chosen(result, guess) for guess in guesses)
        lines.append(_short(f"no amount was named, so one was chosen: {'; '.join(chosen)}"))
    if notes:
        lines.append(_short(f"note: {'; '.join(notes)}"))
    return lines


def also_moved(result: EditResult) -> list[str]:
    """Names of the segments that visibly moved, though no primary constraint names them or their object."""
    program = parse(result.program, result.scene.names, result.scene.objects)
    named = {name for call in program.calls for name in segment_names(call)}
    return [
        s.name
        for s in result.scene.segments
        if not named & {s.name, s.object} and _shift(result.transforms[s.id], s.box) >= SEEN_PX
    ]


def assumptions(understood: Sequence[str], scene: Scene) -> tuple[list[str], list[str]]:
    """Of a translator's reading: clauses whose amount it chose, and remarks that are about no segment."""
    guesses, notes = [], []
    for line in understood:
        if GUESS in line:
            guesses.append(line.partition(" (")[0])
        elif not line.startswith((*scene.names, *scene.objects, "canvas")):
            notes.append(line)
    return guesses, notes


def _chosen(result: EditResult, guess: str) -> str:
    """A clause with a chosen amount, as what became of the first thing that it is about."""
    about, _, _ = guess.partition(": ")
    things = about.split(" and ")
    for s in result.scene.segments:
        if {s.name, s.object} & set(things):
            return f"{about} {motion}" if (motion := describe_motion(result.transforms[s.id], centre(s.box))) else guess
    return guess


def _shift(matrix: Float[np.ndarray, "2 3"], box: tuple[float, float, float, float]) -> float:
    """How far a motion takes the corner of a box that it takes furthest, px."""
    x0, y0, x1, y1 = box
    corners = np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])
    return float(np.linalg.norm(corners @ matrix[:, :2].T + matrix[:, 2] - corners, axis=1).max())


def _listed(names: Sequence[str], total: int) -> str:
    more = len(names) - SHOWN
    if more <= 1:
        return _short(", ".join(names))
    return _short(f"{', '.join(names[:SHOWN])} and {more} more of the {total} segments")


def _short(text: str) -> str:
    text = " ".join(text.split())
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 4].rstrip()} ..."
