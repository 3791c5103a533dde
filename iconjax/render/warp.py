"""Resampling of a premultiplied sprite under an affine transform."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy import ndimage
from scipy.sparse import csr_matrix

TURNED = 1.45  # how much interpolation between slanted rows widens an edge


@dataclass(frozen=True)
class Sprite:
    """A piece of picture.

    Attributes:
        data: (h, w, 4) premultiplied red, green, blue (0..255) and coverage (0..1).
        top: row of its first row in the picture.
        left: column of its first column.
    """

    data: Float[np.ndarray, "h w 4"]
    top: int
    left: int


def warp(sprite: Sprite, matrix: Float[np.ndarray, "2 3"], shape: tuple[int, int]) -> Sprite | None:
    """Move a sprite by a 2x3 matrix (contract coordinates); None when nothing lands on the (H, W) canvas.

    Whole-pixel translations move the values untouched. A shrinking axis is averaged over each new pixel's
    footprint, a growing one interpolated, with its edges kept as sharp as the new size allows.
    """
    linear = matrix[:, :2]
    if abs(np.linalg.det(linear)) < 1e-9:
        return None
    shift = matrix[:, 2]
    whole = np.rint(shift)
    if np.abs(linear - np.eye(2)).max() < 1e-9 and np.abs(shift - whole).max() < 1e-6:
        return _crop(Sprite(sprite.data, sprite.top + int(whole[1]), sprite.left + int(whole[0])), shape)
    span = _landing(sprite, matrix, shape)
    if span is None:
        return None
    top, bottom, left, right = span
    gain = math.sqrt(abs(np.linalg.det(linear)))
    if abs(linear[0, 1]) < 1e-9 and abs(linear[1, 0]) < 1e-9:
        rows = _axis_weights(np.arange(top, bottom), linear[1, 1], shift[1], sprite.top, sprite.data.shape[0])
        cols = _axis_weights(np.arange(left, right), linear[0, 0], shift[0], sprite.left, sprite.data.shape[1])
        data = _weigh(cols, _weigh(rows, sprite.data).swapaxes(0, 1)).swapaxes(0, 1)
    else:
        data = _sample(sprite, matrix, span)
        gain = max(gain, TURNED)
    return Sprite(_sharpen(data, gain), top, left)


def _landing(
    sprite: Sprite, matrix: Float[np.ndarray, "2 3"], shape: tuple[int, int]
) -> tuple[int, int, int, int] | None:
    h, w = sprite.data.shape[:2]
    x0, y0 = sprite.left - 0.5, sprite.top - 0.5
    corners = np.array([[x0, y0], [x0 + w + 1, y0], [x0, y0 + h + 1], [x0 + w + 1, y0 + h + 1]])
    moved = corners @ matrix[:, :2].T + matrix[:, 2]
    low = np.clip(np.floor(moved.min(axis=0)), 0, (shape[1], shape[0])).astype(int)
    high = np.clip(np.ceil(moved.max(axis=0)), 0, (shape[1], shape[0])).astype(int)
    if (high <= low).any():
        return None
    return int(low[1]), int(high[1]), int(low[0]), int(high[0])


def _crop(sprite: Sprite, shape: tuple[int, int]) -> Sprite | None:
    h, w = sprite.data.shape[:2]
    top, left = max(sprite.top, 0), max(sprite.left, 0)
    bottom, right = min(sprite.top + h, shape[0]), min(sprite.left + w, shape[1])
    if top >= bottom or left >= right:
        return None
    data = sprite.data[top - sprite.top : bottom - sprite.top, left - sprite.left : right - sprite.left]
    return Sprite(data, top, left)


def _weigh(weights: Float[np.ndarray, "n m"], data: Float[np.ndarray, "m k 4"]) -> Float[np.ndarray, "n k 4"]:
    mixed = csr_matrix(weights) @ data.reshape(len(data), -1)
    return np.asarray(mixed).reshape(len(weights), *data.shape[1:])


def _axis_weights(pixels: np.ndarray, factor: float, shift: float, start: int, count: int) -> Float[np.ndarray, "n m"]:
    """Weights of `count` source pixels in each target pixel along one axis."""
    source = np.arange(count) + start + 0.5
    if abs(factor) >= 1.0:
        centre = (pixels + 0.5 - shift) / factor
        return np.asarray(np.maximum(0.0, 1.0 - np.abs(centre[:, None] - source)), np.float32)
    ends = np.stack([pixels - shift, pixels + 1.0 - shift]) / factor
    low, high = ends.min(axis=0)[:, None], ends.max(axis=0)[:, None]
    overlap = np.minimum(high, source + 0.5) - np.maximum(low, source - 0.5)
    return np.asarray(np.maximum(0.0, overlap) * abs(factor), np.float32)


def _sample(
    sprite: Sprite, matrix: Float[np.ndarray, "2 3"], span: tuple[int, int, int, int]
) -> Float[np.ndarray, "h w 4"]:
    inverse = np.linalg.inv(matrix[:, :2])
    least = np.linalg.svd(matrix[:, :2], compute_uv=False)[-1]
    count = 1 if least >= 0.9 else min(math.ceil(1.25 / least), 6)
    top, bottom, left, right = span
    sub = (np.arange(count) + 0.5) / count
    y = (np.arange(top, bottom)[:, None] + sub).ravel()[:, None] - matrix[1, 2]
    x = (np.arange(left, right)[:, None] + sub).ravel()[None, :] - matrix[0, 2]
    place = np.stack(
        [
            inverse[1, 0] * x + inverse[1, 1] * y - sprite.top - 0.5,
            inverse[0, 0] * x + inverse[0, 1] * y - sprite.left - 0.5,
        ]
    ).astype(np.float32)
    planes = [ndimage.map_coordinates(sprite.data[..., c], place, order=1, mode="constant") for c in range(4)]
    data = np.stack(planes, axis=-1)
    return np.asarray(data.reshape(bottom - top, count, right - left, count, 4).mean(axis=(1, 3)))


def _sharpen(data: Float[np.ndarray, "h w 4"], gain: float) -> Float[np.ndarray, "h w 4"]:
    """Narrow, by a factor, the edges that resampling has widened, about the line of half coverage."""
    if gain < 1.1:
        return data
    cover = data[..., 3:]
    sharp = np.clip((cover - 0.5) * gain + 0.5, 0.0, 1.0)
    return data * np.where(cover > 1e-4, sharp / np.maximum(cover, 1e-4), 0.0)
