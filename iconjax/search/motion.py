"""What transforms do to segments: displacement, rotation, scaling."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

STILL_PX = 0.35
"""Motion of less than this many pixels (at 512 x 512) is none."""


@dataclass(frozen=True)
class Motion:
    """What transforms did to each segment.

    Attributes:
        shift: (n,) greatest displacement of a corner of its box, px.
        turn: (n,) rotation, degrees clockwise.
        scales: (n, 2) singular values of the linear part, larger first.
    """

    shift: Float[np.ndarray, " n"]
    turn: Float[np.ndarray, " n"]
    scales: Float[np.ndarray, "n 2"]

    def stretch(self, i: int) -> float:
        """Largest change of size of segment `i` along any direction, as a logarithm."""
        return float(np.abs(np.log(np.maximum(self.scales[i], 1e-3))).max())


def measure_motion(matrices: Float[np.ndarray, "n 6"], features: Float[np.ndarray, "n 6"]) -> Motion:
    """Measure the motion of every segment, given its box features before the edit."""
    m = matrices.reshape(-1, 2, 3)
    x0, _, x1, y0, _, y1 = features.T
    corners = np.stack([[x0, y0], [x1, y0], [x1, y1], [x0, y1]]).transpose(2, 0, 1)  # n 4 2
    moved = np.einsum("nij,nkj->nki", m[:, :, :2], corners) + m[:, None, :, 2]
    shift = np.linalg.norm(moved - corners, axis=-1).max(1)
    turn = np.degrees(np.arctan2(m[:, 1, 0] - m[:, 0, 1], m[:, 0, 0] + m[:, 1, 1]))
    return Motion(shift, turn, np.linalg.svd(m[:, :, :2], compute_uv=False))


def same_motion(a: Float[np.ndarray, "6"], b: Float[np.ndarray, "6"], tolerance: float = 1e-3) -> bool:
    """Whether two transforms are one, within `tolerance` of each entry."""
    return bool(np.abs(a - b).max() <= tolerance)


def corner_distance(a: Float[np.ndarray, "6"], b: Float[np.ndarray, "6"], box: Float[np.ndarray, "6"]) -> float:
    """How far two transforms carry the corners of a segment's box apart, px."""
    corners = np.array([[x, y, 1.0] for x in box[[0, 2]] for y in box[[3, 5]]])
    return float(np.linalg.norm(corners @ (a - b).reshape(2, 3).T, axis=1).max())
