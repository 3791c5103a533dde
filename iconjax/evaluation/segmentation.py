"""How much work a found segmentation leaves to do (paper, "Evaluation for Segmentation Tool")."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Integer
from scipy import ndimage

RADIUS = 20.0
"""A true boundary pixel is covered by a found one within so many pixels, at 512 x 512 (paper: r = 20)."""
MATCH = 0.7
"""A true segment is found where some found segment has a larger intersection over union with it."""

Mask = Integer[np.ndarray, "H W"]


@dataclass(frozen=True)
class SegmentationScore:
    """A found segmentation against the true one.

    Attributes:
        true: true segments.
        found: found segments.
        missing: length in pixels of the true boundaries that no found boundary covers, which a person has to draw.
        unnamed: labels a person has to give: one for every found segment, as its name is provisional, and one for
            every true segment that is still to be drawn.
        mislabelled: what is left of them where every found segment has the label of the true segment that
            it overlaps most: true segments without a found one, and found segments that are mostly background.
        matched: true segments with a found one of intersection over union above `MATCH`.
        split: found segments beyond the first of the same true segment.
    """

    true: int
    found: int
    missing: float
    unnamed: int
    mislabelled: int
    matched: int
    split: int


def score_segmentation(found: Mask, true: Mask, radius: float = RADIUS) -> SegmentationScore:
    """Compare two label maps of the same size; 0 is background in both, and names do not matter."""
    share = overlaps(true, found)
    n, m = share.shape[0] - 1, share.shape[1] - 1
    present = np.bincount(found.ravel(), minlength=m + 1)[1:] > 0
    owner = share[:, 1:].argmax(0)[present]
    owned = len(set(owner.tolist()) - {0})
    union = share.sum(1)[:, None] + share.sum(0)[None] - share
    best = (share / np.maximum(union, 1))[1:, 1:].max(1, initial=0.0)
    count = int(present.sum())
    return SegmentationScore(
        true=n,
        found=count,
        missing=missing_length(found, true, radius),
        unnamed=count + n - owned,
        mislabelled=n - owned + int((owner == 0).sum()),
        matched=int((best > MATCH).sum()),
        split=int((owner > 0).sum()) - owned,
    )


def overlaps(true: Mask, found: Mask) -> Float[np.ndarray, "n m"]:
    """Pixels that true segment i (row) and found segment j (column) share; 0 is background."""
    n, m = int(true.max()) + 1, int(found.max()) + 1
    pair = true.astype(np.int64).ravel() * m + found.ravel()
    return np.bincount(pair, minlength=n * m).reshape(n, m).astype(float)


def missing_length(found: Mask, true: Mask, radius: float = RADIUS) -> float:
    """Number of true boundary pixels further than `radius`, at 512 x 512, from every found boundary pixel.

    In pixels at 512 x 512, too, so that pictures of all sizes can be averaged.
    """
    unit = max(true.shape) / 512
    edge, drawn = boundary(true), boundary(found)
    if not drawn.any():
        return float(edge.sum() / unit)
    away = ndimage.distance_transform_edt(~drawn)
    return float((edge & (away > radius * unit)).sum() / unit)


def boundary(mask: Mask) -> Bool[np.ndarray, "H W"]:
    """Pixels whose right or lower neighbour has another label: paths one pixel wide between segments."""
    edge = np.zeros(mask.shape, dtype=bool)
    edge[:, :-1] |= mask[:, :-1] != mask[:, 1:]
    edge[:-1] |= mask[:-1] != mask[1:]
    return edge
