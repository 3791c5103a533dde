"""Regions of a label map and the borders between them, as arrays to decide merges on."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy import ndimage

Labels = Int[np.ndarray, "H W"]


@dataclass(frozen=True)
class Regions:
    """Regions 1..n of a label map without zeros; row 0 of every array is unused.

    Attributes:
        area: in pixels.
        colour: mean CIELAB colour.
        rim: pixels on the rim of the picture.
        length: (n+1, n+1) pixel sides that two regions share.
        contrast: (n+1, n+1) mean colour difference across them, 0 where they share none.
    """

    area: Int[np.ndarray, " n"]
    colour: Float[np.ndarray, "n 3"]
    rim: Int[np.ndarray, " n"]
    length: Float[np.ndarray, "n n"]
    contrast: Float[np.ndarray, "n n"]

    @property
    def ids(self) -> range:
        """The region numbers."""
        return range(1, len(self.area))


def measure(labels: Labels, clean: Float[np.ndarray, "H W 3"]) -> Regions:
    """Measure the regions of `labels`.

    Args:
        labels: numbers 1..n, all in use.
        clean: CIELAB colours in which edge pixels have their region's colour unmixed.
    """
    n = int(labels.max()) + 1
    area = np.bincount(labels.ravel(), minlength=n)
    total = [np.bincount(labels.ravel(), clean[..., k].ravel(), n) for k in range(3)]
    colour = np.stack(total, 1) / np.maximum(area, 1)[:, None]
    rim = np.concatenate([labels[0], labels[-1], labels[1:-1, 0], labels[1:-1, -1]])
    length, step = np.zeros((n, n)), np.zeros((n, n))
    for first, second in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])):
        a, b = labels[first], labels[second]
        at = a != b
        pair = a[at] * n + b[at]
        away = np.linalg.norm(clean[first][at] - clean[second][at], axis=1)
        length += np.bincount(pair, minlength=n * n).reshape(n, n)
        step += np.bincount(pair, away, n * n).reshape(n, n)
    length, step = length + length.T, step + step.T
    return Regions(area, colour, np.bincount(rim, minlength=n), length, step / np.maximum(length, 1.0))


def depths(labels: Labels) -> Float[np.ndarray, " n"]:
    """Radius of the largest disc inside each region 0..n, in pixels; the rim of the picture bounds them, too."""
    padded = np.pad(labels, 1, constant_values=-1)
    edge = np.zeros(padded.shape, dtype=bool)
    for axis in (0, 1):
        step = np.diff(padded, axis=axis) != 0
        edge |= np.pad(step, [(1, 0) if k == axis else (0, 0) for k in (0, 1)])
        edge |= np.pad(step, [(0, 1) if k == axis else (0, 0) for k in (0, 1)])
    far = ndimage.distance_transform_edt(~edge)[1:-1, 1:-1] + 0.5
    deepest = np.zeros(int(labels.max()) + 1)
    np.maximum.at(deepest, labels.ravel(), far.ravel())
    return deepest


def join(labels: Labels, pairs: Iterable[tuple[int, int]]) -> Labels:
    """The label map with regions united, renumbered 1..m (0 stays 0)."""
    parent = np.arange(int(labels.max()) + 1)

    def root(k: int) -> int:
        while parent[k] != k:
            parent[k] = parent[parent[k]]
            k = int(parent[k])
        return k

    for a, b in pairs:
        a, b = root(a), root(b)
        parent[max(a, b)] = min(a, b)
    return renumber(np.array([root(k) for k in range(len(parent))])[labels])


def renumber(labels: Labels) -> Labels:
    """The same map with its positive numbers made 1..m in their order; 0 stays 0."""
    used = np.bincount(labels.ravel()) > 0
    used[0] = False
    return np.asarray((np.cumsum(used) * used)[labels])
