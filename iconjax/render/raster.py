"""The picture after an edit: every segment's own pixels, moved, painted back to front."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Float, UInt8

from iconjax.errors import InputError
from iconjax.render.bridge import bridge
from iconjax.render.hidden import continue_colour, heal, hidden_region, rim_of
from iconjax.render.layers import render_layers
from iconjax.render.matting import Matte, solve_matte
from iconjax.render.ownership import Box, Ownership, find_ownership, grown
from iconjax.render.warp import Sprite, warp
from iconjax.scene.types import Scene

SNAP = 0.02  # a transform that moves no corner of the picture this far, in pixels, is the identity


def render(scene: Scene, matrices: Float[np.ndarray, "n 2 3"], order: Sequence[int]) -> UInt8[np.ndarray, "H W 3"]:
    """Draw the scene with every segment moved by its transform.

    Args:
        scene: the unedited picture and its n segments.
        matrices: (n, 2, 3) transforms, original to edited pixels, in the order of `scene.segments`.
        order: positions of the segments, back to front. A scene with layers is painted in their order.

    Returns:
        (H, W, 3) picture. With identity transforms it is the input bit for bit.

    Raises:
        InputError: a matrix is not finite, or `order` is not a permutation of the segments' positions.
    """
    matrices = checked(scene, matrices)
    if sorted(order) != list(range(len(scene.segments))):
        raise InputError(f"the painting order must name each of the {len(scene.segments)} segments once")
    if not len(scene.segments) or (matrices == np.eye(2, 3)).all():
        return scene.image.copy()
    if scene.layers:
        return render_layers(scene, matrices)
    own = find_ownership(scene)
    matte = solve_matte(scene, own, matrices)
    height, width = own.owner.shape
    canvas = np.zeros((height, width, 4), np.float32)
    for rank, i in enumerate(order):
        front = np.zeros(len(scene.segments), bool)
        front[list(order[rank + 1 :])] = True
        sprite = _lift(scene, own, matte, i, front, (matrices != matrices[i]).any(axis=(1, 2)))
        moved = warp(sprite, matrices[i], (height, width)) if sprite is not None else None
        if moved is not None:
            _paint(canvas, moved)
    canvas = heal(canvas, own, matrices)
    colour = canvas[..., :3] + (1.0 - canvas[..., 3:]) * own.plate
    return np.asarray(np.clip(np.rint(colour), 0, 255).astype(np.uint8))


def outlines_after(
    scene: Scene, matrices: Float[np.ndarray, "n 2 3"]
) -> tuple[tuple[Float[np.ndarray, "_ 2"], ...], ...]:
    """Each segment's outlines, moved by its transform."""
    return tuple(
        tuple(loop @ matrix[:, :2].T + matrix[:, 2] for loop in segment.loops)
        for segment, matrix in zip(scene.segments, np.asarray(matrices, float), strict=True)
    )


def checked(scene: Scene, matrices: Float[np.ndarray, "n 2 3"]) -> Float[np.ndarray, "n 2 3"]:
    """One finite transform for each segment; those that hardly move anything are the exact identity.

    Raises:
        InputError: not one for each, or one that is not finite.
    """
    count = len(scene.segments)
    matrices = np.array(matrices, np.float64).reshape(-1, 2, 3)
    if len(matrices) != count:
        raise InputError(f"the scene has {count} segments but {len(matrices)} transforms were given")
    if not np.isfinite(matrices).all():
        bad = int(np.nonzero(~np.isfinite(matrices).all(axis=(1, 2)))[0][0])
        raise InputError(f"the transform of segment {scene.segments[bad].name!r} is not finite")
    corners = np.array([[x, y, 1.0] for x in (0, scene.width) for y in (0, scene.height)])
    still = np.eye(2, 3)
    drift = np.abs((matrices - still) @ corners.T).max(axis=(1, 2)) if count else np.zeros(0)
    matrices[drift < SNAP] = still
    return matrices


def _lift(
    scene: Scene,
    own: Ownership,
    matte: Matte,
    i: int,
    front: Bool[np.ndarray, " n"],
    apart: Bool[np.ndarray, " n"],
) -> Sprite | None:
    """Segment i cut from the picture: its pixels, its share of the pixels at its rim, what it hides."""
    box = own.boxes[i]
    if box is None:
        return None
    window = grown(box, 2, own.owner.shape)
    colour = scene.image[window].astype(np.float32)
    alpha, other = matte.alpha[window], matte.other[window]
    mine = own.owner[window] == i
    lent = ~mine & (matte.partner[window] == i)
    # Written so that putting it back on what it was mixed with gives the very same pixel.
    rest = (1.0 - alpha)[..., None] * other
    data = np.zeros((*mine.shape, 4), np.float32)
    data[mine, :3] = (colour - rest)[mine]
    data[mine, 3] = alpha[mine]
    data[lent, :3] = rest[lent]
    data[lent, 3] = 1.0 - alpha[lent]
    # What moves with a segment goes on hiding the same of it.
    if np.append(front & apart, False)[own.owner[window]].any():
        data = _with_hidden(data, colour, own, matte, i, front, window)
    data = np.pad(data, ((1, 1), (1, 1), (0, 0)))
    return Sprite(data, window[0].start - 1, window[1].start - 1)


def _with_hidden(
    data: Float[np.ndarray, "h w 4"],
    colour: Float[np.ndarray, "h w 3"],
    own: Ownership,
    matte: Matte,
    i: int,
    front: Bool[np.ndarray, " n"],
    window: Box,
) -> Float[np.ndarray, "h w 4"]:
    """`data` with the segment continued under what lies on it."""
    owner = own.owner[window]
    mine = owner == i
    mixed = mine & (matte.alpha[window] < 1) & np.append(front, False)[matte.partner[window]]
    cover = mixed | np.append(front, False)[owner]
    bridge(data, mine & ~mixed, cover)
    found = hidden_region(own, i, front)
    if found is None:
        return data
    (rows, cols), part = found
    region = np.zeros(data.shape[:2], bool)
    top, left = rows.start - window[0].start, cols.start - window[1].start
    region[top : top + part.shape[0], left : left + part.shape[1]] = part
    mixed &= rim_of(region)
    known = mine & (own.label[window] >= 0) & ~rim_of(region)
    if not known.any():
        known = mine & ~mixed
    if not known.any():
        return data
    fill = region | mixed
    data[fill, :3] = continue_colour(colour, known, fill)[fill]
    data[fill, 3] = 1.0
    return data


def _paint(canvas: Float[np.ndarray, "H W 4"], sprite: Sprite) -> None:
    """Lay a sprite on the canvas.

    Coverages at an edge are taken as disjoint where there is room for both: segments are cut from one
    picture, so edges that meet are complementary, and a plain "over" would let the background shine
    through the seam.
    """
    h, w = sprite.data.shape[:2]
    target = canvas[sprite.top : sprite.top + h, sprite.left : sprite.left + w]
    room = 1.0 - sprite.data[..., 3:]
    below = target[..., 3:]
    target *= np.where(below > room, room / np.maximum(below, 1e-6), 1.0)
    target += sprite.data
