"""Guessed transforms as a help to the search: one more place to begin, and the casting vote between equals.

A guess never stands in for a constraint: it is solved and judged like any other candidate.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from jaxtyping import Float

from iconjax.search.candidate import Setting, body_roots
from iconjax.search.motion import STILL_PX, measure_motion, same_motion
from iconjax.search.state import Mode, State
from iconjax.solve.pose import Bodies

BEGUN = 8
"""Initial states that also begin at the guess."""
TIE = 0.05
"""Costs closer than this are equal: the one nearer to the guess wins."""
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


def hinted_state(setting: Setting, guess: Float[np.ndarray, "n 6"]) -> State:
    """Every guessed segment free in the ways it was guessed to move; what moves alike moves as one."""
    facts = setting.facts
    motion = measure_motion(guess, facts.features)
    moved = motion.shift > STILL_PX * setting.size / 512
    modes: list[Mode] = ["N"] * len(guess)
    for i in sorted(np.flatnonzero(moved), key=lambda k: -facts.area[k]):
        leader = next((j for j in range(len(modes)) if modes[j][0] == "T" and same_motion(guess[i], guess[j])), None)
        if leader is not None:
            modes[i] = f"W:{leader}"
        elif i not in setting.intent.fixed:
            turn = "R" if abs(motion.turn[i]) > TURNED_DEG else ""
            modes[i] = "T" + turn + _scale_kind(guess[i].reshape(2, 3)[:, :2])
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
    x0, _, x1, y0, _, y1 = features.T
    corners = np.stack([[x0, y0], [x1, y0], [x1, y1], [x0, y1]]).transpose(2, 0, 1)
    off = (matrices - guess).reshape(-1, 2, 3)
    gap = np.einsum("nij,nkj->nki", off[:, :, :2], corners) + off[:, None, :, 2]
    return float(np.linalg.norm(gap, axis=-1).max(1).mean())
