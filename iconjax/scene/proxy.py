"""The paper's proxy segment: what is mostly surrounded by a segment counts as inside it."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool


def proxy_mask(mask: Bool[np.ndarray, "H W"], rays: int = 16, ratio: float = 0.9) -> Bool[np.ndarray, "H W"]:
    """Pixels from which at least `ratio` of `rays` evenly spaced rays hit `mask`, and those of `mask`."""
    mask = np.asarray(mask, dtype=bool)
    out = mask.copy()
    if not mask.any():
        return out
    rows, cols = np.flatnonzero(mask.any(1)), np.flatnonzero(mask.any(0))
    window = slice(rows[0], rows[-1] + 1), slice(cols[0], cols[-1] + 1)
    crop = mask[window]  # outside the box half of the rays run away
    hits = np.zeros(crop.shape, dtype=np.int32)
    for angle in np.arange(rays) * (2 * np.pi / rays):
        hits += _seen(crop, float(np.cos(angle)), float(np.sin(angle)))
    out[window] |= hits >= ratio * rays - 1e-9
    return out


def _seen(mask: Bool[np.ndarray, "h w"], dx: float, dy: float) -> Bool[np.ndarray, "h w"]:
    """Pixels from which a ray towards (dx, dy) meets the mask."""
    if abs(dy) > abs(dx):
        return _seen(mask.T, dy, dx).T
    if dx < 0:
        return _seen(mask[:, ::-1], -dx, dy)[:, ::-1]
    height, width = mask.shape
    # Shear the picture until the rays run along its rows, look along them from the right, and shear it back.
    drop = np.rint(np.arange(width) * (dy / dx)).astype(int)
    drop -= drop.min()
    tall = height + int(drop.max())
    row = np.arange(height)[:, None] + (drop.max() - drop)[None]
    col = np.broadcast_to(np.arange(width), (height, width))
    sheared = np.zeros((tall, width), dtype=bool)
    sheared[row, col] = mask
    ahead = np.logical_or.accumulate(sheared[:, ::-1], axis=1)[:, ::-1]
    return np.asarray(ahead[row, col])
