"""Guessed transforms as a help to the search: one more place to begin, and the casting vote between equals.

A guess never stands in for a constraint: it is solved and judged like any other candidate.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from jaxtyping import Float

from iconjax.search.candidate import Setting, body_roots
from iconjax.search.motion import STILL_PX, corner_distance, measure_motion
from iconjax.search.state import Mode, State
from iconjax.solve.pose import Bodies

BEGUN = 8
"""Initial states that also begin at the guess."""
TIE, TIE_SHARE = 0.05, 0.15
"""Costs that differ by less than this, plus this share of the least, are as good as equal: the one nearer to the guess
wins."""
ALIKE = 0.012
"""Guesses that differ by less than this share of the picture are meant to be one motion."""
TURNED_DEG, SCALED = 1.0, 0.02
"""A guess that turns or scales by less than this means no rotation or no scaling."""


def hint_matrices(count: int, guesses: Mapping[int, Float[np.ndarray, "2 3"]]) -> Float[np.ndarray, "n 6"]:
    """The guessed transform of every segment, by position; identity where there is no guess or no sane one."""
    out = np.tile(np.array([1.0, 0.0, 0.0, 0.0, 1.0, 0.0]), (count, 1))
    for i, guess in guesses.items():
        matrix = np.asarray(guess, float)
        linear = matrix[:, :2]
        if 0 <= i < count and np.isfinite(matrix).all() and np.linalg.det(linear) > 1e-4:
            out[i] = matrix.reshape(6)
    return out


def hinted_state(setting: Setting, asked: State, guess: Float[np.ndarray, "n 6"]) -> State:
    """The state `asked`, in which only what the request names is free, with everything else that was guessed to move
    free in the ways it was guessed to; what moves alike within a few pixels moves as one."""
    facts, intent = setting.facts, setting.intent
    motion = measure_motion(guess, facts.features)
    named = {i for thing in intent.things for i in thing.members}
    modes = list(asked.modes)
    free = [i for i in np.flatnonzero(motion.shift > STILL_PX * setting.size / 512) if i not in named | intent.fixed]
    leaders = [i for i in range(len(modes)) if asked.root(i) == i and modes[i] != "N"]
    for i in sorted(free, key=lambda k: -facts.area[k]):
        if modes[i].startswith("W:"):
            continue  # a detail goes with its host
        alike = [j for j in leaders if corner_distance(guess[i], guess[j], facts.features[i]) < ALIKE * setting.size]
        if alike:
            modes[i] = f"W:{alike[0]}"
        else:
            turn = "R" if abs(motion.turn[i]) > TURNED_DEG else ""
            modes[i] = "T" + turn + _scale_kind(guess[i].reshape(2, 3)[:, :2])
            leaders.append(int(i))
    return State(tuple(modes), {}, "as guessed")


def _scale_kind(linear: Float[np.ndarray, "2 2"]) -> Mode:
    x, y = np.log(np.maximum(np.linalg.norm(linear, axis=0), 1e-6))
    if max(abs(x), abs(y)) < SCALED:
        return ""
    if abs(x - y) < SCALED:
        return "Su"
    return "Sx" if abs(y) < SCALED else "Sy" if abs(x) < SCALED else "Sxy"


def hinted_start(state: State, bodies: Bodies, guess: Float[np.ndarray, "n 6"]) -> Float[np.ndarray, "n 5"]:
    """Parameters of the bodies of `state`, by root segment, that come closest to the guess."""
    z = np.zeros((len(state.modes), 5))
    for k, root in enumerate(body_roots(state)):
        matrix = guess[root].reshape(2, 3)
        c, s = np.cos(bodies.axis[k]), np.sin(bodies.axis[k])
        scaled = matrix[:, :2] @ np.array([[c, -s], [s, c]])
        logs = np.log(np.maximum(np.linalg.norm(scaled, axis=0), 1e-6))
        turn = np.arctan2(matrix[1, 0] - matrix[0, 1], matrix[0, 0] + matrix[1, 1])
        z[root, :2] = matrix[:, :2] @ bodies.centre[k] + matrix[:, 2] - bodies.centre[k]
        z[root, 2:] = bodies.radius[k] * np.array([turn, *(logs if not bodies.uniform[k] else [logs.mean(), 0.0])])
    return z


def distance(
    matrices: Float[np.ndarray, "n 6"], guess: Float[np.ndarray, "n 6"], features: Float[np.ndarray, "n 6"]
) -> float:
    """Mean over segments of how far a corner of its box lies from where the guess puts it, px."""
    return float(np.mean([corner_distance(m, g, f) for m, g, f in zip(matrices, guess, features, strict=True)]))
