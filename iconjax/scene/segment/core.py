"""Patches of one colour: pixels that are no mixture of their neighbours, linked where the colour hardly steps."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float, Int, Shaped
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

MIXED = 4.0
"""A pixel that differs less from a neighbour, in 8-bit steps, is no mixture of it and something else."""
DETOUR = 1.12
"""A mixture lies on the straight way between two colours, up to this ratio of lengths."""
LINK = 3.0
"""Neighbours whose colours differ less, in CIELAB, show the same patch."""
LEAST, MOST = 4, 1200
"""Pixels of the smallest patch, and the most patches; of more, the largest are kept."""
STEADY, STEEPEST, REACH = 0.3, 10.0, 3
"""Over so many pixels to either side, the steps of a gradient differ less than this share of their mean, which is at
most so steep, in 8-bit steps a pixel; an edge is over sooner."""
ROUNDING = 1.5
"""Steps of rounded colours are off by less than this."""
_HALF = ((0, 1), (1, 0), (1, 1), (1, -1))

Colours = Float[np.ndarray, "H W 3"]


def mixtures(image: Colours, gradients: bool = True) -> Bool[np.ndarray, "H W"]:
    """Pixels whose colour lies between those of two opposite neighbours: anti-aliased or blurred edges.

    A gradient is no mixture as long as it changes by less than `MIXED` a pixel or changes steadily; the ridge of a
    thin stroke is none.

    Args:
        image: sRGB, 0..255.
        gradients: whether steady changes are gradients; in a picture that was enlarged, edges are as steady.
    """
    padded = np.pad(image, ((1, 1), (1, 1), (0, 0)), mode="edge")
    height, width = image.shape[:2]
    out = np.zeros((height, width), dtype=bool)
    for dy, dx in _HALF:
        a = padded[1 - dy : 1 - dy + height, 1 - dx : 1 - dx + width]
        b = padded[1 + dy : 1 + dy + height, 1 + dx : 1 + dx + width]
        pa, pb, ab = _norm(image - a), _norm(image - b), _norm(a - b)
        found = (np.minimum(pa, pb) > MIXED) & (pa + pb < DETOUR * ab)
        rows, cols = np.nonzero(found & (ab < 2 * STEEPEST) & gradients)
        found[rows, cols] = ~_steady(image, rows, cols, dy, dx)
        out |= found
    return out


def _steady(
    image: Colours, rows: Int[np.ndarray, " n"], cols: Int[np.ndarray, " n"], dy: int, dx: int
) -> Bool[np.ndarray, " n"]:
    """Whether the colour changes by equal steps along (dy, dx) about pixels; never so beyond the picture's border."""
    height, width = image.shape[:2]
    inside = np.ones(len(rows), dtype=bool)
    run = []
    for k in range(-REACH, REACH + 1):
        r, c = rows + k * dy, cols + k * dx
        inside &= (r >= 0) & (r < height) & (c >= 0) & (c < width)
        run.append(image[np.clip(r, 0, height - 1), np.clip(c, 0, width - 1)])
    steps = np.diff(np.stack(run), axis=0)
    mean = steps.mean(axis=0)
    off = _norm(steps - mean).max(axis=0)
    return np.asarray(inside & (off < STEADY * _norm(mean) + ROUNDING))


def linked(colour: Colours, use: Bool[np.ndarray, "H W"], limit: float) -> tuple[Int[np.ndarray, "H W"], int]:
    """Components 1..n of the pixels in `use`, 0 elsewhere; side neighbours less than `limit` apart are linked."""
    height, width = use.shape
    index = np.arange(height * width).reshape(height, width)
    heads, tails = [], []
    for first, second in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])):
        near = use[first] & use[second] & (_norm(colour[first] - colour[second]) < limit)
        heads.append(index[first][near])
        tails.append(index[second][near])
    head, tail = np.concatenate(heads), np.concatenate(tails)
    graph = coo_array((np.ones(len(head), dtype=bool), (head, tail)), shape=(index.size, index.size))
    _, component = connected_components(graph, directed=False)
    flat = np.where(use.ravel(), component + 1, 0)
    values, labels = np.unique(flat, return_inverse=True)
    if values[0] != 0:
        labels = labels + 1
    return labels.reshape(height, width), int(labels.max())


def patches(image: Colours, colour: Colours, gradients: bool = True) -> Int[np.ndarray, "H W"]:
    """Patches 1..n, at most `MOST` and of at least `LEAST` pixels; 0 where a pixel belongs to none yet.

    Args:
        image: sRGB, 0..255, in which anti-aliasing is linear.
        colour: the same in CIELAB, in which equal steps look equal.
        gradients: as `mixtures` takes it.
    """
    labels, _ = linked(colour, ~mixtures(image, gradients), LINK)
    sizes = np.bincount(labels.ravel())
    sizes[0] = 0
    least = max(LEAST, int(np.sort(sizes)[-MOST]) if len(sizes) > MOST else 0)
    keep = sizes >= least
    keep &= np.cumsum(keep) <= MOST  # several may have just the least size
    number = np.cumsum(keep) * keep
    return np.asarray(number[labels])


def absorb(
    labels: Int[np.ndarray, "H W"], image: Shaped[np.ndarray, "H W 3"]
) -> tuple[Int[np.ndarray, "H W"], Int[np.ndarray, "H W"]]:
    """Give every unlabelled pixel to the adjacent patch whose colour is nearest to its own, layer by layer.

    Returns:
        the labels without zeros, and for every pixel the (flat) index of the patch pixel it goes back to, which
        has the patch's colour unmixed. Without any label, both are as they came.
    """
    height, width = labels.shape
    out, source = labels.copy(), np.arange(labels.size).reshape(labels.shape)
    flat = image.reshape(-1, 3)
    while True:
        rows, cols = np.nonzero(out == 0)
        if not len(rows) or len(rows) == out.size:
            return out, source
        own = image[rows, cols].astype(np.float32)
        best = np.full(len(rows), np.inf)
        pick, origin = np.zeros(len(rows), out.dtype), np.zeros(len(rows), source.dtype)
        for dy in (-1, 0, 1):
            for dx in (-1, 0, 1):
                r, c = np.clip(rows + dy, 0, height - 1), np.clip(cols + dx, 0, width - 1)
                near, root = out[r, c], source[r, c]
                slant = 0.01 * (dx != 0 and dy != 0)
                away = np.where(near > 0, _norm(own - flat[root].astype(np.float32)) + slant, np.inf)
                better = away < best
                best, pick = np.where(better, away, best), np.where(better, near, pick)
                origin = np.where(better, root, origin)
        out[rows, cols], source[rows, cols] = pick, np.where(pick > 0, origin, source[rows, cols])


def _norm(step: Float[np.ndarray, "*n 3"]) -> Float[np.ndarray, "*n"]:
    return np.asarray(np.sqrt(np.einsum("...k,...k->...", step, step)))
