"""How much of a rim pixel is its owner's: undoes the anti-aliasing at the seams."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int32, Integer
from scipy import ndimage

from iconjax.render.ownership import OFFSETS, REACH, RIM, TRACE, Box, Ownership, grown, mix
from iconjax.scene.types import Scene

SLIP = 0.75  # neighbours whose common pixels are carried to within this distance move as one


@dataclass(frozen=True)
class Matte:
    """Each pixel as a mixture: colour = alpha x owner's colour + (1 - alpha) x other.

    Attributes:
        alpha: (H, W) share of the owner; 1 away from rims.
        partner: (H, W) position of the segment that has the rest, -1 for the plate.
        other: (H, W, 3) the colour of the rest.
    """

    alpha: Float[np.ndarray, "H W"]
    partner: Int32[np.ndarray, "H W"]
    other: Float[np.ndarray, "H W 3"]


def together(own: Ownership, i: int, window: Box, matrices: Float[np.ndarray, "n 2 3"]) -> Bool[np.ndarray, "h w"]:
    """Pixels of a window owned by segment i or by a neighbour that is carried along with it there."""
    owner = own.owner[window]
    result = owner == i
    for j in np.unique(owner):
        if j < 0 or j == i:
            continue
        gap = matrices[j] - matrices[i]
        if not gap.any():
            result |= owner == j
            continue
        y = np.arange(window[0].start, window[0].stop)[:, None] + 0.5
        x = np.arange(window[1].start, window[1].stop)[None, :] + 0.5
        slip = np.hypot(gap[0, 0] * x + gap[0, 1] * y + gap[0, 2], gap[1, 0] * x + gap[1, 1] * y + gap[1, 2])
        result |= (owner == j) & (slip < SLIP)
    return np.asarray(result)


def solve_matte(scene: Scene, own: Ownership, matrices: Float[np.ndarray, "n 2 3"]) -> Matte:
    """Estimate, along every edge at which the picture may come apart, how the pixels are mixed."""
    shape = own.owner.shape
    matte = Matte(np.ones(shape, np.float32), np.full(shape, -1, np.int32), own.plate.astype(np.float32))
    image = scene.image.astype(np.float32)
    pure = _pure(own.label)
    for i, box in enumerate(own.boxes):
        if box is None:
            continue
        window = grown(box, REACH, shape)
        joined = together(own, i, window, matrices)
        solid = joined & (own.label[window] >= 0)
        size = 2 * RIM + 1
        # Beyond the picture's border the segment goes on: a cut there is no rim.
        core = ndimage.minimum_filter(solid.view(np.uint8), size, mode="nearest").view(bool)
        rim = (own.owner[window] == i) & ~core
        core |= _thin_core(solid, rim, core)
        _solve_segment(image, own, matte, window, np.nonzero(rim), core, pure[window] & ~joined)
    return matte


def _pure(label: Int32[np.ndarray, "H W"]) -> Bool[np.ndarray, "H W"]:
    low, high = (f(label, 3, mode="nearest") for f in (ndimage.minimum_filter, ndimage.maximum_filter))
    return np.asarray((low == high) & (label >= 0))


def _thin_core(
    solid: Bool[np.ndarray, "h w"], rim: Bool[np.ndarray, "h w"], core: Bool[np.ndarray, "h w"]
) -> Bool[np.ndarray, "h w"]:
    """Stand-ins for interior pixels where a segment is too thin to have any: its middle line."""
    reached = ndimage.maximum_filter(core.view(np.uint8), 2 * REACH - 1).view(bool)
    if not (rim & ~reached).any():
        return np.zeros_like(core)
    depth = ndimage.distance_transform_cdt(np.pad(solid, 1, mode="edge"), "chessboard")[1:-1, 1:-1]
    ridge = solid & (depth == ndimage.maximum_filter(depth, 5))
    return np.asarray(ridge & ~reached)


def _solve_segment(
    image: Float[np.ndarray, "H W 3"],
    own: Ownership,
    matte: Matte,
    window: Box,
    rim: tuple[Integer[np.ndarray, " n"], ...],
    core: Bool[np.ndarray, "h w"],
    foreign: Bool[np.ndarray, "h w"],
) -> None:
    """Solve one segment's rim pixels and write them into `matte`."""
    if not len(rim[0]):
        return
    corner = np.array([window[0].start, window[1].start])
    rows, cols = rim[0] + corner[0], rim[1] + corner[1]
    colour = image[rows, cols]
    inner, has_inner = _pick(image, core, rim, corner)
    # A pixel whose colour is the interior's needs no solving.
    same = has_inner & (np.abs(colour - inner).max(axis=1) <= 4)
    todo = np.nonzero(has_inner & ~same)[0]
    rim = (rim[0][todo], rim[1][todo])
    rows, cols, colour, inner = rows[todo], cols[todo], colour[todo], inner[todo]
    labelled = own.label[rows, cols] >= 0

    beyond, has_beyond = _pick(image, foreign, rim, corner)
    behind = own.plate[rows, cols].astype(np.float32)
    bare = ndimage.maximum_filter((own.owner[window] < 0).view(np.uint8), 2 * RIM + 1).view(bool)[rim]

    share_a, error_a = _best_mix(image, core, rim, corner, colour, inner, behind)
    share_b, error_b = _best_mix(image, core, rim, corner, colour, inner, beyond)
    error_a = np.where(bare, error_a, np.inf)
    error_b = np.where(has_beyond, error_b + 6, np.inf)
    use_b = error_b < error_a
    share, error = np.where(use_b, share_b, share_a), np.where(use_b, error_b, error_a)
    other = np.where(use_b[:, None], beyond, behind)
    three = (error > 24) & bare & has_beyond
    share[three], other[three] = _mix_of_three(colour[three], inner[three], beyond[three], behind[three])
    error[three] = 0.0
    # What no mixture explains is a detail of the segment itself.
    share = np.where((error > 48) & labelled | ~np.isfinite(error), 1.0, share)
    share = np.where(share > 0.985, 1.0, np.where(labelled, np.maximum(share, 2 * TRACE), share))
    _, nearest_foreign = _pick_index(foreign, rim)
    matte.alpha[rows, cols] = share
    partner = own.owner[nearest_foreign[0] + corner[0], nearest_foreign[1] + corner[1]]
    matte.partner[rows, cols] = np.where(use_b | three, partner, -1)
    matte.other[rows, cols] = other


def _pick_index(
    where: Bool[np.ndarray, "h w"], at: tuple[Integer[np.ndarray, " n"], ...]
) -> tuple[Bool[np.ndarray, " n"], tuple[Integer[np.ndarray, " n"], Integer[np.ndarray, " n"]]]:
    """For each place, whether `where` holds within REACH, and the nearest place where it does."""
    padded = np.pad(where, REACH)
    hits = padded[at[0][:, None] + OFFSETS[:, 0] + REACH, at[1][:, None] + OFFSETS[:, 1] + REACH]
    first = hits.argmax(axis=1)
    found = hits[np.arange(len(first)), first]
    step = np.where(found[:, None], OFFSETS[first], 0)
    return found, (at[0] + step[:, 0], at[1] + step[:, 1])


def _pick(
    image: Float[np.ndarray, "H W 3"],
    where: Bool[np.ndarray, "h w"],
    at: tuple[Integer[np.ndarray, " n"], ...],
    corner: Integer[np.ndarray, " two"],
) -> tuple[Float[np.ndarray, "n 3"], Bool[np.ndarray, " n"]]:
    found, place = _pick_index(where, at)
    return image[place[0] + corner[0], place[1] + corner[1]], found


def _mix_of_three(
    colour: Float[np.ndarray, "n 3"],
    inner: Float[np.ndarray, "n 3"],
    beyond: Float[np.ndarray, "n 3"],
    behind: Float[np.ndarray, "n 3"],
) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, "n 3"]]:
    """Share of `inner` where two segments and the background meet, and the colour of the rest."""
    basis = np.stack([inner - behind, beyond - behind], axis=-1).astype(np.float64)
    normal = basis.swapaxes(1, 2) @ basis + np.eye(2)
    shares = np.linalg.solve(normal, basis.swapaxes(1, 2) @ (colour - behind)[..., None])
    share = np.clip(shares[:, 0, 0], 0.0, 1.0)
    rest = (colour - share[:, None] * inner) / np.maximum(1.0 - share, 1e-3)[:, None]
    return share, np.clip(rest, 0.0, 255.0)


def _best_mix(
    image: Float[np.ndarray, "H W 3"],
    core: Bool[np.ndarray, "h w"],
    rim: tuple[Integer[np.ndarray, " n"], ...],
    corner: Integer[np.ndarray, " two"],
    colour: Float[np.ndarray, "n 3"],
    inner: Float[np.ndarray, "n 3"],
    other: Float[np.ndarray, "n 3"],
) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """`mix` with the nearest interior colour; where that fails, with the best one around."""
    share, error = mix(colour, inner, other)
    bad = np.nonzero(error > 12)[0]
    if not len(bad):
        return share, error
    padded = np.pad(core, REACH)
    near = OFFSETS[::2]
    y, x = rim[0][bad, None] + near[:, 0], rim[1][bad, None] + near[:, 1]
    usable = padded[y + REACH, x + REACH]
    y, x = np.clip(y + corner[0], 0, image.shape[0] - 1), np.clip(x + corner[1], 0, image.shape[1] - 1)
    shares, errors = mix(colour[bad, None], image[y, x], other[bad, None])
    cost = np.where(usable, errors + np.hypot(near[:, 0], near[:, 1]), np.inf)
    best = cost.argmin(axis=1)
    pick = (np.arange(len(bad)), best)
    better = cost[pick] < error[bad]
    share[bad] = np.where(better, shares[pick], share[bad])
    error[bad] = np.where(better, errors[pick], error[bad])
    return share, error
