"""The copy of a picture that is segmented: small ones enlarged, large ones shrunk, the traces of JPEG smoothed."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int, UInt8
from PIL import Image

from iconjax.errors import InputError
from iconjax.scene.segment.core import absorb

SMALLEST, LARGEST = 256, 768
"""Range of the larger side, in pixels, in which a picture is segmented as it is."""
NOISY, SMOOTHING = 0.02, 0.06
"""Share of pixels a little off their neighbours from which a picture is smoothed, and how much (total variation)."""
MOST_PIXELS = 17_000_000
"""Largest picture that is segmented: a little more than 4096 x 4096."""


def working_copy(image: UInt8[np.ndarray, "H W 3"]) -> Float[np.ndarray, "h w 3"]:
    """`image` at a size at which strokes are a few pixels wide; edges stay linear mixtures.

    Raises:
        InputError: the picture is too large.
    """
    height, width = image.shape[:2]
    if height * width > MOST_PIXELS:
        raise InputError(
            f"the image is too large to segment ({width}x{height} pixels): scale it down, 1024x1024 is enough"
        )
    larger = max(height, width)
    if SMALLEST <= larger <= LARGEST:
        return _quiet(image.astype(np.float32))
    factor = LARGEST / larger if larger > LARGEST else float(-(-SMALLEST // larger))
    size = max(1, round(width * factor)), max(1, round(height * factor))
    how = Image.Resampling.BOX if factor < 1 else Image.Resampling.BILINEAR
    copy = np.asarray(Image.fromarray(image).resize(size, how), np.float32)
    return _quiet(copy) if factor < 1 else copy


def _quiet(image: Float[np.ndarray, "h w 3"]) -> Float[np.ndarray, "h w 3"]:
    """`image` without the faint ripples that JPEG leaves, or as it is where it has none."""
    ripple = np.abs(image[:, :-2] - 2 * image[:, 1:-1] + image[:, 2:]).max(2)
    if ripple.size == 0 or ((ripple >= 3) & (ripple < 16)).mean() < NOISY:
        return image
    from skimage.restoration import denoise_tv_chambolle

    smooth = denoise_tv_chambolle(image / 255, weight=SMOOTHING, max_num_iter=60, channel_axis=2)
    return np.asarray(smooth * 255, np.float32)


def at_full_size(labels: Int[np.ndarray, "h w"], image: UInt8[np.ndarray, "H W 3"]) -> Int[np.ndarray, "H W"]:
    """Labels of the working copy for every pixel of `image`; where it was shrunk, its own pixels decide at edges."""
    height, width = image.shape[:2]
    if labels.shape == (height, width):
        return labels
    rows = ((np.arange(height) + 0.5) * labels.shape[0] / height).astype(int)
    cols = ((np.arange(width) + 0.5) * labels.shape[1] / width).astype(int)
    full = labels[rows][:, cols]
    if max(height, width) <= LARGEST:
        return np.asarray(full)
    from scipy.ndimage import maximum_filter, minimum_filter

    reach = 2 * -(-max(height, width) // LARGEST) + 1
    edge = maximum_filter(full, reach) != minimum_filter(full, reach)
    redone, _ = absorb(np.where(edge, 0, full + 1), image)
    return np.where(redone > 0, redone - 1, full)
