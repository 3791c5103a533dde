"""An edit told in plain words."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from jaxtyping import Float

from iconjax.search.types import ConstraintReport

if TYPE_CHECKING:
    from iconjax.edit.result import EditResult

STATES = {"ST": "held", "WK": "held, sliding", "N": "given up", "F": "fused: moves as one with its host"}
"""Relation states in words."""


def explain(result: EditResult) -> str:
    """What was asked, what was done and what does not hold, one thing a line."""
    lines = [f"Request: {result.request}"] if result.request else []
    lines += [f"Read by {result.translator} as:"] if result.understood else []
    lines += [f"  {line}" for line in result.understood]
    lines += ["Constraints:", *(f"  {describe_constraint(c)}" for c in result.constraints)]
    moved = [
        f"  {s.name}: {text}"
        for s in result.scene.segments
        if (text := describe_motion(result.transforms[s.id], centre(s.box)))
    ]
    lines += ["Changed:", *moved] if moved else ["Nothing was changed."]
    still = len(result.scene.segments) - len(moved)
    lines += [f"  {still} other segment{'s' if still != 1 else ''} stayed exactly as before"] if moved and still else []
    loose = [r for r in result.relations if r.state in ("WK", "N")]
    lines += ["Loosened:"] if loose else []
    lines += [f"  {r.a} - {r.b} ({r.kind}): {STATES.get(r.state, r.state)}" for r in loose]
    lines += [f"Note: {note}" for note in result.notes]
    return "\n".join(lines)


def describe_constraint(constraint: ConstraintReport) -> str:
    """One constraint and whether it holds, with by how much it is missed."""
    if constraint.satisfied:
        return f"holds   {constraint.text}"
    return f"MISSED  {constraint.text}  by {amount(constraint)}"


def amount(constraint: ConstraintReport) -> str:
    """A violation with its unit, rounded for reading."""
    value = float(constraint.violation)
    return f"{round(value, 1 if value >= 1 else 3):g} {constraint.unit}".rstrip()


def centre(box: tuple[float, float, float, float]) -> tuple[float, float]:
    """Middle of a box (min x, min y, max x, max y)."""
    return (box[0] + box[2]) / 2, (box[1] + box[3]) / 2


def describe_motion(matrix: Float[np.ndarray, "2 3"], about: tuple[float, float]) -> str:
    """How `matrix` moves, turns and scales a thing with middle `about` (px); "" for the exact identity."""
    if np.array_equal(matrix, np.eye(2, 3)):
        return ""
    (a, b, _), (c, d, _) = matrix
    point = np.array([*about, 1.0])
    dx, dy = matrix @ point - point[:2]
    turn = math.degrees(math.atan2(c - b, a + d))  # the rotation nearest to the linear part
    stretch = np.linalg.svd(matrix[:, :2], compute_uv=False)
    parts = []
    if math.hypot(dx, dy) >= 0.05:
        parts.append(_way(dx, dy))
    if abs(turn) >= 0.05:
        parts.append(f"turned {abs(turn):.1f} deg {'clockwise' if turn > 0 else 'counter-clockwise'}")
    if np.abs(stretch - 1).max() >= 5e-4:
        parts.append(_scaling(matrix[:, :2], stretch))
    if a * d - b * c < 0:
        parts.append("mirrored")
    return ", ".join(parts) or "changed by less than a tenth of a pixel"


def _way(dx: float, dy: float) -> str:
    sides = []
    if abs(dx) >= 0.05:
        sides.append(f"{abs(dx):.1f} px {'right' if dx > 0 else 'left'}")
    if abs(dy) >= 0.05:
        sides.append(f"{abs(dy):.1f} px {'down' if dy > 0 else 'up'}")
    return "moved " + " and ".join(sides or [f"{math.hypot(dx, dy):.2f} px"])


def _scaling(linear: Float[np.ndarray, "2 2"], stretch: Float[np.ndarray, " 2"]) -> str:
    if abs(linear[0, 1]) < 1e-9 and abs(linear[1, 0]) < 1e-9:
        x, y = abs(linear[0, 0]), abs(linear[1, 1])
        if abs(x - y) < 5e-4:
            return f"scaled to {x:.1%}"
        sides = [f"{name} to {v:.1%}" for name, v in (("width", x), ("height", y)) if abs(v - 1) >= 5e-4]
        return "scaled in " + " and ".join(sides)
    if abs(stretch[0] - stretch[1]) < 5e-4:
        return f"scaled to {stretch.mean():.1%}"
    return f"scaled to {stretch[0]:.1%} and {stretch[1]:.1%} along its axes"
