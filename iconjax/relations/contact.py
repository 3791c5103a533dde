"""Finding the place where two segments meet, across a thin gap if need be."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float
from scipy.ndimage import binary_erosion
from scipy.spatial import cKDTree

from iconjax.relations.types import Contact


class Border:
    """The border pixels of one segment with a search tree over them.

    Args:
        mask: (H, W) the segment's pixels, without inner holes.
    """

    def __init__(self, mask: Bool[np.ndarray, "H W"]) -> None:
        rows, cols = np.nonzero(mask)
        self.box = (cols.min(), rows.min(), cols.max() + 1, rows.max() + 1)
        crop = np.pad(mask[self.box[1] : self.box[3], self.box[0] : self.box[2]], 1)
        edge = crop & ~binary_erosion(crop)
        r, c = np.nonzero(edge)
        self.points: Float[np.ndarray, "_ 2"] = np.stack([c + self.box[0] - 0.5, r + self.box[1] - 0.5], 1)
        self.tree = cKDTree(self.points)

    def distance(self, other: Border) -> float:
        """The width of the gap between the two, px; 0 where they touch."""
        return max(0.0, float(other.tree.query(self.points)[0].min()) - 1.0)

    def far_from(self, other: Border, reach: float) -> bool:
        """Whether the two boxes are further apart than `reach`."""
        a, b = self.box, other.box
        return bool(max(a[0] - b[2], b[0] - a[2], a[1] - b[3], b[1] - a[3]) > reach)


def find_contact(a: Border, b: Border, reach: float, slack: float) -> Contact | None:
    """Where `a` meets `b`, or None when they are further apart than `reach` px.

    A border point belongs to the contact when its distance to the other segment is within `slack` px of the least one.
    Distances between pixel centres of neighbouring pixels are 1, so a gap of 0 means touching.
    """
    if a.far_from(b, reach):
        return None
    distance, index = b.tree.query(a.points, distance_upper_bound=reach + 1.0)
    least = float(distance.min())
    if not np.isfinite(least):
        return None
    near_a = distance <= least + slack
    pairs_a, pairs_b = a.points[near_a], b.points[index[near_a]]
    back, back_index = a.tree.query(b.points, distance_upper_bound=least + slack + 1e-9)
    near_b = np.isfinite(back)
    pairs_a = np.concatenate([pairs_a, a.points[back_index[near_b]]])
    pairs_b = np.concatenate([pairs_b, b.points[near_b]])
    share, share_b = float(near_a.mean()), float(near_b.mean())
    pairs_a, pairs_b = _resting(pairs_a, pairs_b)
    return _describe(pairs_a, pairs_b, max(0.0, least - 1.0), share, share_b)


def _resting(
    pairs_a: Float[np.ndarray, "m 2"], pairs_b: Float[np.ndarray, "m 2"]
) -> tuple[Float[np.ndarray, "k 2"], Float[np.ndarray, "k 2"]]:
    """Where one side rests on the other, the contact is there: not where it also laps around the flanks."""
    across = pairs_b - pairs_a
    upright = np.abs(across[:, 1]) > np.abs(across[:, 0])
    if upright.mean() < 0.25 or upright.all():
        return pairs_a, pairs_b
    down = across[:, 1] > 0
    share = down[upright].mean()
    if 0.3 < share < 0.7:
        return pairs_a, pairs_b
    rests = upright & (down == (share > 0.5))
    return pairs_a[rests], pairs_b[rests]


def _describe(
    pairs_a: Float[np.ndarray, "m 2"],
    pairs_b: Float[np.ndarray, "m 2"],
    gap: float,
    share: float,
    share_b: float,
) -> Contact:
    middles = (pairs_a + pairs_b) / 2
    centre = middles.mean(0)
    spread = middles - centre
    direction = np.linalg.svd(spread, full_matrices=False)[2][0] if len(spread) > 1 else np.array([1.0, 0.0])
    along = spread @ direction
    length = float(along.max() - along.min()) + 1.0

    def pair(select: Bool[np.ndarray, " m"]) -> Float[np.ndarray, "2 2"]:
        return np.stack([pairs_a[select].mean(0), pairs_b[select].mean(0)])

    everywhere = np.ones(len(along), dtype=bool)
    end = max(1.0, 0.08 * length)
    across = (pairs_b - pairs_a).mean(0)
    norm = float(np.linalg.norm(across))
    flat = np.array([-direction[1], direction[0]])
    normal = across / norm if norm > 0.5 else flat
    return Contact(
        gap=gap,
        length=length,
        share=share,
        share_b=share_b,
        middle=pair(everywhere),
        first=pair(along <= along.min() + end),
        second=pair(along >= along.max() - end),
        normal=normal,
    )
