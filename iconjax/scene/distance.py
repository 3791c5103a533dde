"""Signed distance fields of pixel masks."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float
from scipy.ndimage import distance_transform_edt


def signed_distance(mask: Bool[np.ndarray, "H W"]) -> Float[np.ndarray, "H W"]:
    """Distance in pixels from each pixel centre to the border of `mask`, negative inside.

    The border runs halfway between an inner and an outer pixel, so no value is between -0.5 and 0.5. What
    lies beyond the picture is outside. An empty mask is further away than anything: height + width.
    """
    padded = np.pad(np.asarray(mask, dtype=bool), 1)
    if not padded.any():
        return np.full(np.shape(mask), float(sum(np.shape(mask))))
    inside = distance_transform_edt(padded)
    outside = distance_transform_edt(~padded)
    field = np.where(padded, 0.5 - inside, outside - 0.5)
    return np.asarray(field[1:-1, 1:-1])
