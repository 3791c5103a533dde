"""What a 2x3 affine transform does to a shape: how far it turns, how much it scales, whether it mirrors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from iconjax.errors import InputError

Matrix = Float[np.ndarray, "2 3"]
Transforms = Mapping[int, Matrix] | Mapping[str, Sequence[Sequence[float]]]
"""Segment id -> 2x3 matrix from original to edited pixels, as arrays or as read from JSON."""

IDENTITY: Matrix = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])


@dataclass(frozen=True)
class Motion:
    """The linear part of a transform, taken apart by the polar decomposition A = R P.

    Attributes:
        degrees: turn of R, clockwise on screen positive, in (-180, 180]; meaningless where `mirrored`.
        factors: largest and smallest scale factor (the singular values of A).
        mirrored: whether the transform turns the shape over.
    """

    degrees: float
    factors: tuple[float, float]
    mirrored: bool


def motion_of(matrix: Matrix) -> Motion:
    """Take a transform apart. For a 2x2 matrix with positive determinant, R turns by atan2(d - b, a + e)."""
    (a, b), (d, e) = matrix[:, :2]
    large, small = np.linalg.svd(matrix[:, :2], compute_uv=False)
    return Motion(
        degrees=float(np.degrees(np.arctan2(d - b, a + e))),
        factors=(float(large), float(small)),
        mirrored=bool(a * e - b * d < 0),
    )


def turn_error(degrees: float, wanted: float) -> float:
    """Unsigned difference of two angles in degrees, 0..180."""
    return abs((degrees - wanted + 180.0) % 360.0 - 180.0)


def apply(matrix: Matrix, points: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, "n 2"]:
    """Move points (x, y) by a transform."""
    return np.asarray(points @ matrix[:, :2].T + matrix[:, 2])


def read_transforms(transforms: Transforms, ids: Sequence[int]) -> dict[int, Matrix]:
    """Bring a table of transforms to one matrix for each id; a segment left out stays.

    Raises:
        InputError: an id that does not exist, or a matrix that is not 2x3 or not finite.
    """
    matrices = {key: IDENTITY.copy() for key in ids}
    for key, value in transforms.items():
        try:
            number, matrix = int(key), np.asarray(value, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise InputError(f"transform of segment {key!r} is not a 2x3 matrix of numbers") from error
        if number not in matrices:
            raise InputError(f"transform of segment {key!r}, but the segments are {', '.join(map(str, ids))}")
        if matrix.shape != (2, 3) or not np.isfinite(matrix).all():
            raise InputError(f"transform of segment {key!r} is not a finite 2x3 matrix")
        matrices[number] = matrix
    return matrices
