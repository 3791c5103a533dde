"""Cutting a shape where it is thin between two bodies."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy import ndimage

from iconjax.scene.outline import fill

NECK = 0.5
"""A neck is narrower than this share of the narrower of the two bodies it joins."""
BODY = 0.06
"""A body has at least this share of the shape's (filled) area."""
MOST = 4
"""A shape that falls into more bodies is a pattern, such as the sails of a wheel, and stays whole."""
CONVEX = 0.9
"""Least share of its convex hull that a hole fills to count as filled."""
WIDER, LONG = 1.25, 1.5
"""A neck ends where it is so many times as wide; one longer than so many times its width is a part, not a neck."""
RIPPLE = 0.08
"""Peaks of depth that stand out less than this share of the deepest make no body of their own."""


def cut_necks(mask: Bool[np.ndarray, "h w"]) -> Int[np.ndarray, "h w"]:
    """Bodies 1..n of one connected shape, 0 outside; n is 1 where it has no neck.

    Round holes count as filled, so a ring is as broad as its disc. How deep a pixel lies is its distance to the
    outline; the watershed of depth cuts the shape at the saddles between its peaks, and pieces that meet at a
    saddle which is not much shallower than the lower of their two peaks are one body.
    """
    from skimage.morphology import h_maxima
    from skimage.segmentation import watershed

    whole = _fill_round(mask)
    depth = ndimage.distance_transform_edt(np.pad(whole, 1))[1:-1, 1:-1]
    top = float(depth.max())
    peaks, count = ndimage.label(h_maxima(depth, max(1.0, RIPPLE * top)), np.ones((3, 3)))
    if count < 2:
        return mask.astype(np.int64)
    basins = watershed(-depth, peaks, mask=whole)
    height = ndimage.maximum(depth, basins, np.arange(count + 1))
    area = np.bincount(basins.ravel(), minlength=count + 1).astype(float)
    body = _unite(_saddles(basins, depth, count), np.asarray(height), area, BODY * float(whole.sum()))
    used, number = np.unique(body[1:], return_inverse=True)
    cut = np.concatenate([[0], number + 1])[basins]
    return np.asarray(np.where(mask, cut if 1 < len(used) <= MOST else 1, 0))


def _fill_round(mask: Bool[np.ndarray, "h w"]) -> Bool[np.ndarray, "h w"]:
    """`mask` with its convex holes closed: the hole of a ring, not the gap between shapes that touch."""
    from skimage.measure import regionprops

    whole = mask.copy()
    for hole in regionprops(ndimage.label(fill(mask) & ~mask)[0]):
        if hole.solidity > CONVEX:
            whole[hole.slice] |= hole.image
    return whole


def _saddles(basins: Int[np.ndarray, "h w"], depth: Float[np.ndarray, "h w"], count: int) -> Float[np.ndarray, "n n"]:
    """The greatest depth at which two basins meet by a short neck, infinite by a long one, 0 where they do not meet."""
    from skimage.morphology import skeletonize

    ridge = skeletonize(basins > 0)
    saddle = np.zeros((count + 1, count + 1))
    for a, b in combinations(range(1, count + 1), 2):
        rows, cols = np.nonzero((basins == a) & ndimage.binary_dilation(basins == b, np.ones((3, 3))))
        if len(rows):
            at = int(depth[rows, cols].argmax())
            least = float(depth[rows[at], cols[at]])
            narrow, _ = ndimage.label(ridge & (depth < WIDER * least + 1), np.ones((3, 3)))
            near = np.s_[max(rows[at] - 2, 0) : rows[at] + 3, max(cols[at] - 2, 0) : cols[at] + 3]
            piece = narrow[near].max(initial=0)
            long = piece > 0 and np.count_nonzero(narrow == piece) > LONG * 2 * least
            saddle[a, b] = saddle[b, a] = np.inf if long else least
    return saddle


def _unite(
    saddle: Float[np.ndarray, "n n"], height: Float[np.ndarray, " n"], area: Float[np.ndarray, " n"], least: float
) -> Int[np.ndarray, " n"]:
    """The body of each basin: pairs without a neck between them are united, the least neck-like first."""
    body = np.arange(len(height))
    saddle, height, area = saddle.copy(), height.copy(), area.copy()
    while True:
        ratio = saddle / np.maximum(np.minimum(height[:, None], height[None]), 1e-9)
        small = (area < least)[:, None] | (area < least)[None]
        ratio = np.where(small & (saddle > 0), ratio + 1.0, ratio)
        a, b = np.unravel_index(int(ratio.argmax()), ratio.shape)
        if ratio[a, b] < NECK:
            return body
        body[body == b] = a
        saddle[a], saddle[:, a] = np.maximum(saddle[a], saddle[b]), np.maximum(saddle[:, a], saddle[:, b])
        saddle[b], saddle[:, b], saddle[a, a] = 0.0, 0.0, 0.0
        height[a], area[a] = max(height[a], height[b]), area[a] + area[b]
