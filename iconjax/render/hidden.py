"""What lies under a segment that another one encloses: the host's own colour, continued."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float
from scipy import ndimage

from iconjax.render.ownership import RIM, TRACE, Box, Ownership, grown

SHADING = 96  # colours that span less than this are one shaded surface


def hidden_region(own: Ownership, i: int, front: Bool[np.ndarray, " n"]) -> tuple[Box, Bool[np.ndarray, "h w"]] | None:
    """Where segment i goes on under others: a window and a mask in it, or None.

    These are its inner holes that other segments (those of `front`, which are painted after it) fill up to
    its rim. A hole through which the background touches the segment is a true hole and stays one.
    """
    box = own.boxes[i]
    if box is None:
        return None
    window = grown(box, 1, own.owner.shape)
    owner = own.owner[window]
    mine = owner == i
    holes, count = ndimage.label(ndimage.binary_fill_holes(mine) & ~mine, np.ones((3, 3)))
    if not count:
        return None
    fringe = ndimage.binary_dilation(mine, np.ones((3, 3), bool))
    index = np.arange(1, count + 1)
    border = ndimage.sum_labels(fringe, holes, index)
    bare = ndimage.sum_labels(fringe & (owner < 0), holes, index)
    closed = np.concatenate([[False], bare <= 0.05 * border])
    region = closed[holes] & (owner >= 0) & np.append(front, False)[owner]
    return (window, region) if region.any() else None


def continue_colour(
    colour: Float[np.ndarray, "h w 3"], known: Bool[np.ndarray, "h w"], region: Bool[np.ndarray, "h w"]
) -> Float[np.ndarray, "h w 3"]:
    """Colours for `region`, grown from the nearest pixels of `known` and smoothed where they are shaded."""
    index = ndimage.distance_transform_edt(~known, return_distances=False, return_indices=True)
    filled = colour[tuple(index)]
    span = np.ptp(filled[region], axis=0).max()
    if not 3 < span < SHADING:  # flat, or different things that must not run into each other
        return np.asarray(filled)
    depth = int(ndimage.distance_transform_cdt(region).max())
    width = 2 * depth + 1
    while width >= 3:
        smooth = ndimage.uniform_filter(filled, (width, width, 0), mode="nearest")
        filled[region] = smooth[region]
        width = width // 4 * 2 + 1
    return np.asarray(filled)


def rim_of(region: Bool[np.ndarray, "h w"]) -> Bool[np.ndarray, "h w"]:
    """`region` grown over the pixels that anti-aliasing may have mixed with what fills it."""
    return np.asarray(ndimage.binary_dilation(region, np.ones((3, 3), bool), iterations=RIM))


def heal(
    canvas: Float[np.ndarray, "H W 4"], own: Ownership, matrices: Float[np.ndarray, "n 2 3"]
) -> Float[np.ndarray, "H W 4"]:
    """Close, on the finished canvas, what a moved segment tore open in the midst of several others.

    Only gaps shut in on all sides by painted pixels, none of which showed the background before, are closed;
    a true hole that has come along with its segment is none.
    """
    still = np.append((matrices == np.eye(2, 3)).all(axis=(1, 2)), True)
    bare = (own.owner < 0) | ((own.label < 0) & still[own.owner])
    gaps, count = ndimage.label(canvas[..., 3] < TRACE, np.ones((3, 3)))
    torn = np.ones(count + 1, bool)
    torn[np.unique(gaps[bare])] = torn[0] = False
    for k in np.nonzero(torn)[0]:
        rows, cols = np.nonzero(gaps == k)
        window = grown((slice(rows.min(), rows.max() + 1), slice(cols.min(), cols.max() + 1)), 4, gaps.shape)
        gap, view = gaps[window] == k, canvas[window]
        known = view[..., 3] > 0.999
        fill = rim_of(gap) & ~known
        if known.any() and fill.any() and not _came_along(gap, window, own, matrices[~still[:-1]]):
            below = continue_colour(view[..., :3], known, fill)
            view[fill, :3] += (1.0 - view[fill, 3:]) * below[fill]
            view[fill, 3] = 1.0
    return canvas


def _came_along(
    gap: Bool[np.ndarray, "h w"], window: Box, own: Ownership, matrices: Float[np.ndarray, "m 2 3"]
) -> bool:
    """Whether some moved segment had this gap beside it, as background, where it was before."""
    inside = np.argwhere(gap)
    around = np.argwhere(ndimage.binary_dilation(gap, np.ones((3, 3), bool), iterations=RIM + 1) & ~gap)
    corner = np.array([window[0].start, window[1].start])
    shape = np.array(own.owner.shape)
    for matrix in matrices:
        if abs(np.linalg.det(matrix[:, :2])) < 1e-9:
            continue
        owners = []
        for place in (inside, around):
            point = (place + corner + 0.5)[:, ::-1] - matrix[:, 2]
            cell = np.floor(np.linalg.solve(matrix[:, :2], point.T).T[:, ::-1] + 1e-9).astype(int)
            valid = ((cell >= 0) & (cell < shape)).all(axis=1)
            cell = np.clip(cell, 0, shape - 1)
            owners.append(np.where(valid, own.owner[cell[:, 0], cell[:, 1]], -1))
        if (owners[0] < 0).mean() > 0.5 and (owners[1] >= 0).mean() > 0.25:
            return True
    return False
