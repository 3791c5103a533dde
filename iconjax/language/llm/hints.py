"""Guesses of motions as transforms."""

from __future__ import annotations

import math

import numpy as np
from jaxtyping import Float

from iconjax.language.base import Hint


def hint_matrix(hint: Hint, box: tuple[float, float, float, float]) -> Float[np.ndarray, "2 3"]:
    """The affine map of a hint: scaled along x and y, turned, moved, about the centre of the segment's `box`."""
    centre = np.array([(box[0] + box[2]) / 2, (box[1] + box[3]) / 2])
    c, s = math.cos(math.radians(hint.rotate)), math.sin(math.radians(hint.rotate))
    linear = np.array([[c, -s], [s, c]]) @ np.diag(hint.scale)
    shift = centre + np.array(hint.translate) - linear @ centre
    return np.column_stack([linear, shift])
