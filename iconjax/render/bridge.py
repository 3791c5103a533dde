"""Continuation of a segment under what lies across it: a bar behind a post, a rim behind a handle."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float, Integer
from scipy import ndimage

from iconjax.render.hidden import continue_colour

LEAST = 0.1  # either visible end must be at least this share of the hidden stretch
BOTH = 0.4  # and the two together at least this share
SURE = 2.0  # a stretch is sure with this many times as much
ELONGATED = 4.0  # from this ratio of extents on, a segment's own long direction is followed too

_SQUARE = np.ones((3, 3), bool)


def bridge(
    data: Float[np.ndarray, "h w 4"], mine: Bool[np.ndarray, "h w"], cover: Bool[np.ndarray, "h w"]
) -> Bool[np.ndarray, "h w"]:
    """Continue a segment's premultiplied pixels, in place, under `cover` where both ends of a stretch show.

    A stretch is a run of covered pixels along a row, a column or the long direction of an elongated segment,
    with pixels of `mine` right at both its ends. Short ends do not vouch for a long stretch: what stands
    between the arms of a U does not hide a bar. Returns the pixels that were filled.
    """
    best = np.full(mine.shape, np.inf)
    sure = np.zeros(mine.shape, bool)
    result = data.copy()
    for slope, upright in _directions(mine):
        view = _Sheared(mine.shape, slope, upright)
        found = _along_rows(view.take(data, 0.0), view.take(mine, False), view.take(cover, False))
        gap, certain, filled = (view.back(part) for part in found)
        better = gap < best
        result[better], best[better] = filled[better], gap[better]
        sure |= certain
    region = _accepted(np.isfinite(best), sure)
    data[region] = result[region]
    if not region.any():
        return region
    whole = ndimage.binary_closing(region | mine, _SQUARE, iterations=2)
    chinks = (whole & cover | _shut(whole, cover)) & ~region
    if chinks.any():
        data[chinks] = continue_colour(data, region | mine, chinks)[chinks]
    return np.asarray(region | chinks)


def _shut(whole: Bool[np.ndarray, "h w"], cover: Bool[np.ndarray, "h w"]) -> Bool[np.ndarray, "h w"]:
    """The holes of `whole` that are covered all over."""
    holes, count = ndimage.label(ndimage.binary_fill_holes(whole) & ~whole, _SQUARE)
    covered = np.asarray(ndimage.minimum(cover, holes, np.arange(1, count + 1)), bool)
    return np.asarray(np.concatenate([[False], covered])[holes])


def _accepted(possible: Bool[np.ndarray, "h w"], sure: Bool[np.ndarray, "h w"]) -> Bool[np.ndarray, "h w"]:
    """The possible regions that are mostly sure, as wholes, so that no comb of lone lines is drawn."""
    places, count = ndimage.label(ndimage.binary_opening(possible, _SQUARE))
    share = np.asarray(ndimage.mean(sure, places, np.arange(1, count + 1)))
    keep = np.concatenate([[False], share >= 0.5])[places]
    return np.asarray(possible & ndimage.binary_dilation(keep, _SQUARE))


def _directions(mine: Bool[np.ndarray, "h w"]) -> list[tuple[float, bool]]:
    found = [(0.0, False), (0.0, True)]
    rows, cols = np.nonzero(mine)
    if len(rows) < 16:
        return found
    power, axes = np.linalg.eigh(np.cov(np.stack([cols, rows])))
    dx, dy = axes[:, 1]
    if power[1] > ELONGATED**2 * power[0]:
        upright = bool(abs(dy) > abs(dx))
        slope = float(dx / dy if upright else dy / dx)
        if abs(slope) > 0.01:
            found.append((slope, upright))
    return found


class _Sheared:
    """A picture whose rows follow a slanted direction, by shifting whole columns; `back` undoes it."""

    def __init__(self, shape: tuple[int, ...], slope: float, upright: bool) -> None:
        self.upright = upright
        h, w = shape[::-1] if upright else shape
        shift = np.rint(np.arange(w) * slope).astype(int)
        shift -= shift.min()
        self.rows: Integer[np.ndarray, "h w"] = np.arange(h)[:, None] + (shift.max() - shift)[None, :]
        self.cols: Integer[np.ndarray, "h w"] = np.broadcast_to(np.arange(w), (h, w))
        self.shape = (h + int(shift.max()), w)

    def take(self, picture: np.ndarray, empty: float) -> np.ndarray:
        turned = picture.swapaxes(0, 1) if self.upright else picture
        result = np.full((*self.shape, *picture.shape[2:]), empty, picture.dtype)
        result[self.rows, self.cols] = turned
        return result

    def back(self, picture: np.ndarray) -> np.ndarray:
        result: np.ndarray = picture[self.rows, self.cols]
        return result.swapaxes(0, 1) if self.upright else result


def _along_rows(
    data: Float[np.ndarray, "h w 4"], mine: Bool[np.ndarray, "h w"], cover: Bool[np.ndarray, "h w"]
) -> tuple[Float[np.ndarray, "h w"], Bool[np.ndarray, "h w"], Float[np.ndarray, "h w 4"]]:
    """Each pixel's stretch: its length (inf for none), whether it is sure, and what continues its ends."""
    width = mine.shape[1]
    left, before = _ends(mine, cover)
    right, after = _ends(mine[:, ::-1], cover[:, ::-1])
    right, after = width - 1 - right[:, ::-1], after[:, ::-1]
    gap = (right - left - 1).astype(float)
    short, both = np.minimum(before, after), before + after
    good = cover & (short > 0) & (short >= LEAST * gap) & (both >= BOTH * gap)
    sure = good & (short >= SURE * LEAST * gap) & (both >= SURE * BOTH * gap)
    rows, cols = np.nonzero(good)
    start, stop = left[rows, cols], right[rows, cols]
    share = ((cols - start) / (stop - start))[:, None]
    filled = np.zeros_like(data)
    filled[rows, cols] = data[rows, start] * (1.0 - share) + data[rows, stop] * share
    return np.where(good, gap, np.inf), sure, filled


def _ends(
    mine: Bool[np.ndarray, "h w"], cover: Bool[np.ndarray, "h w"]
) -> tuple[Integer[np.ndarray, "h w"], Integer[np.ndarray, "h w"]]:
    """The last uncovered column left of each pixel, and how long the segment's run is that ends there."""
    column = np.broadcast_to(np.arange(mine.shape[1]), mine.shape)
    last = np.maximum.accumulate(np.where(~cover, column, -1), axis=1)
    run = column - np.maximum.accumulate(np.where(~mine, column, -1), axis=1)
    row = np.arange(mine.shape[0])[:, None]
    return last, np.where(last >= 0, run[row, np.maximum(last, 0)], 0)
