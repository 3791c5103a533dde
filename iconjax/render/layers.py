"""Vector pictures after an edit: every layer moved and painted in its place in the order."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, UInt8
from scipy import ndimage

from iconjax.render.warp import Sprite, warp
from iconjax.scene.types import Layer, Scene

OPAQUE = 0.98
EDGE = 5  # pixels across which an anti-aliased edge rises to the coverage beside it
WHITE = 255.0


def render_layers(scene: Scene, matrices: Float[np.ndarray, "n 2 3"]) -> UInt8[np.ndarray, "H W 3"]:
    """Draw a scene that has layers with every segment moved by its transform.

    Nothing has to be guessed: a layer holds what others hide of it. Pixels that come out as they were keep
    the input's values bit for bit.

    Args:
        scene: the unedited picture with its layers.
        matrices: (n, 2, 3) transforms, original to edited pixels, in the order of `scene.segments`.
    """
    shape = (scene.height, scene.width)
    before = np.full((*shape, 3), WHITE, np.float32)
    after = before.copy()
    still = np.eye(2, 3)
    for layer in scene.layers:
        sprite = _sprite(layer)
        matrix = still if layer.segment is None else matrices[layer.segment]
        placed = warp(sprite, still, shape)
        _over(before, placed)
        _over(after, placed if (matrix == still).all() else _moved(sprite, matrix, shape))
    out = np.clip(np.rint(after), 0, 255).astype(np.uint8)
    same = (np.rint(before) == np.rint(after)).all(axis=-1)
    out[same] = scene.image[same]
    return np.asarray(out)


def _sprite(layer: Layer) -> Sprite:
    data = np.pad(layer.data.astype(np.float32), ((1, 1), (1, 1), (0, 0)))
    data[..., 3] /= 255
    return Sprite(data, layer.top - 1, layer.left - 1)


def _moved(sprite: Sprite, matrix: Float[np.ndarray, "2 3"], shape: tuple[int, int]) -> Sprite | None:
    """A sprite moved with its edges sharp and its translucency kept.

    Resampling sharpens edges about half coverage, so a translucent layer is moved as if it were opaque and
    thinned afterwards.
    """
    cover = sprite.data[..., 3]
    rise = ndimage.maximum_filter(cover, EDGE)
    if rise[cover > 0].min(initial=1.0) >= OPAQUE:
        return warp(sprite, matrix, shape)
    full = Sprite(sprite.data / np.maximum(rise, 1e-3)[..., None], sprite.top, sprite.left)
    moved = warp(full, matrix, shape)
    if moved is None:
        return None
    return Sprite(moved.data * _field(rise, sprite, matrix, moved)[..., None], moved.top, moved.left)


def _field(
    field: Float[np.ndarray, "h w"], sprite: Sprite, matrix: Float[np.ndarray, "2 3"], target: Sprite
) -> Float[np.ndarray, "k l"]:
    """A smooth quantity of a sprite, carried to the place of the moved one."""
    back = np.linalg.inv(matrix[:, :2])
    height, width = target.data.shape[:2]
    y, x = np.mgrid[:height, :width] + 0.5
    place = np.stack([x + target.left - matrix[0, 2], y + target.top - matrix[1, 2]], axis=-1) @ back.T
    rows, cols = place[..., 1] - sprite.top - 0.5, place[..., 0] - sprite.left - 0.5
    return np.asarray(ndimage.map_coordinates(field, [rows, cols], order=1, mode="nearest"), np.float32)


def _over(canvas: Float[np.ndarray, "H W 3"], sprite: Sprite | None) -> None:
    if sprite is None:
        return
    h, w = sprite.data.shape[:2]
    target = canvas[sprite.top : sprite.top + h, sprite.left : sprite.left + w]
    target *= 1.0 - sprite.data[..., 3:]
    target += sprite.data[..., :3]
