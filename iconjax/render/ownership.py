"""Who owns which pixel: the label map, completed by the anti-aliased pixels it leaves out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int32, Integer, UInt8
from scipy import ndimage

from iconjax.scene.types import Scene

RIM = 2  # how far, in pixels, anti-aliasing reaches to either side of an edge
REACH = 5  # how far pure colours are looked for
TRACE = 0.03  # a labelled pixel has at least twice this coverage, so that it is told from a gap
INDISTINCT = 24.0  # colours closer than this cannot be told apart in a mixture

Box = tuple[slice, slice]


def _disk(radius: int) -> Integer[np.ndarray, "k 2"]:
    grid = np.mgrid[-radius : radius + 1, -radius : radius + 1].reshape(2, -1).T
    length = np.hypot(grid[:, 0], grid[:, 1])
    grid = grid[np.argsort(length, kind="stable")]
    return grid[np.sort(length) <= radius]


OFFSETS = _disk(REACH)


@dataclass(frozen=True)
class Ownership:
    """Every pixel's owner.

    Attributes:
        label: (H, W) position of the segment whose mask holds the pixel, -1 for none.
        owner: the same, and unlabelled anti-aliased pixels given to the nearest segment.
        plate: (H, W, 3) the picture with nothing on it: what a moved segment uncovers.
        boxes: for each segment, the window of its owned pixels, None where it has none.
    """

    label: Int32[np.ndarray, "H W"]
    owner: Int32[np.ndarray, "H W"]
    plate: UInt8[np.ndarray, "H W 3"]
    boxes: tuple[Box | None, ...]


def grown(box: Box, pad: int, shape: tuple[int, ...]) -> Box:
    """The window `box` with `pad` more pixels on every side, cut at the picture's border."""
    rows, cols = box
    return (
        slice(max(rows.start - pad, 0), min(rows.stop + pad, shape[0])),
        slice(max(cols.start - pad, 0), min(cols.stop + pad, shape[1])),
    )


def find_ownership(scene: Scene) -> Ownership:
    """Give every pixel its owner; thin unlabelled colour beside a segment is that segment's edge."""
    label = scene.position_map()
    empty = label < 0
    stray = empty & (scene.image != scene.background).any(axis=2)
    # Thick unlabelled shapes are drawings of their own and stay where they are.
    thin = stray & ~ndimage.binary_opening(stray, np.ones((2 * RIM + 1, 2 * RIM + 1), bool))
    owner = label.copy()
    if thin.any() and not empty.all():
        near = ndimage.binary_dilation(~empty, np.ones((3, 3), bool), iterations=RIM + 1)
        rows, cols = np.nonzero(thin & near)
        owner[rows, cols] = _likely_owner(scene, label, rows, cols)
    boxes = ndimage.find_objects(owner + 1, max_label=len(scene.segments))
    return Ownership(label, owner, _plate(scene, owner), tuple(boxes))


def _likely_owner(
    scene: Scene,
    label: Int32[np.ndarray, "H W"],
    rows: Integer[np.ndarray, " n"],
    cols: Integer[np.ndarray, " n"],
) -> Int32[np.ndarray, " n"]:
    """The near segment whose colour, thinned by the background, is the pixel's; the nearest of several."""
    near = OFFSETS[np.hypot(OFFSETS[:, 0], OFFSETS[:, 1]) <= RIM + 2]
    y, x = rows[:, None] + near[:, 0], cols[:, None] + near[:, 1]
    inside = (y >= 0) & (y < label.shape[0]) & (x >= 0) & (x < label.shape[1])
    y, x = np.clip(y, 0, label.shape[0] - 1), np.clip(x, 0, label.shape[1] - 1)
    around = np.where(inside, label[y, x], -1)
    colour = scene.image[rows, cols].astype(np.float32)[:, None]
    _, error = mix(colour, scene.image[y, x].astype(np.float32), scene.background.astype(np.float32))
    cost = np.where(around >= 0, error + 4.0 * np.hypot(near[:, 0], near[:, 1]), np.inf)
    return np.asarray(around[np.arange(len(rows)), cost.argmin(axis=1)])


def _plate(scene: Scene, owner: Int32[np.ndarray, "H W"]) -> UInt8[np.ndarray, "H W 3"]:
    plate = scene.image.copy()
    bare = owner < 0
    close = np.abs(plate[bare].astype(int) - scene.background.astype(int)).max(axis=-1) <= 8
    if close.size and close.mean() < 0.5:  # the background is no single colour: continue it
        index = ndimage.distance_transform_edt(~bare, return_distances=False, return_indices=True)
        return np.asarray(plate[tuple(index)])
    plate[~bare] = scene.background
    return plate


def mix(
    colour: Float[np.ndarray, "*n 3"], inner: Float[np.ndarray, "*n 3"], other: Float[np.ndarray, "*n 3"]
) -> tuple[Float[np.ndarray, "*n"], Float[np.ndarray, "*n"]]:
    """Share of `inner` in `colour`, and the length of what the mixture leaves unexplained."""
    span = inner - other
    power = (span**2).sum(axis=-1)
    share = np.clip(((colour - other) * span).sum(axis=-1) / np.maximum(power, 1e-6), 0.0, 1.0)
    share = np.where(power < INDISTINCT**2, 1.0, share)
    rest = colour - other - share[..., None] * span
    return share, np.sqrt((rest**2).sum(axis=-1))
