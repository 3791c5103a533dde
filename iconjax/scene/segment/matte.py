"""What lies behind a picture with transparency: what is shown behind it, and what tells a segmenter where it ends."""

from __future__ import annotations

import os
from dataclasses import dataclass

import numpy as np
from jaxtyping import Integer, UInt8

from iconjax.scene.pixels import open_image, rgb_of_pil
from iconjax.scene.segment.base import Segmenter
from iconjax.scene.types import Segmentation

PALE = 235
"""White parts have at least this value in every channel."""
SOME, ALL = 0.002, 0.9
"""Shares of the opaque pixels: from the first, white parts have to be told from the matte; from the second, the
picture is shown on dark instead of white."""
DARK = (64, 64, 64)
KEYS = ((255, 0, 255), (0, 255, 0), (0, 128, 255), (255, 128, 0), (128, 0, 255))
MARGIN = 4
"""Pixels of matte added on every side, so that the rim is matte whatever touches it."""

Image8 = UInt8[np.ndarray, "H W 3"]


@dataclass(frozen=True)
class Picture:
    """A picture to segment.

    Attributes:
        shown: (H, W, 3) as it is kept and edited, on white (on dark where it is white itself).
        seen: (H, W, 3) the same on `matte`, a colour that it does not have; None where white does.
        matte: (3,) that colour.
    """

    shown: Image8
    seen: Image8 | None = None
    matte: tuple[int, ...] = (255, 255, 255)

    def segment(self, segmenter: Segmenter) -> Segmentation:
        """The segmentation of the picture; see `Segmenter`."""
        if self.seen is None:
            return segmenter.segment(self.shown)
        height, width = self.seen.shape[:2]
        framed = np.full((height + 2 * MARGIN, width + 2 * MARGIN, 3), self.matte, np.uint8)
        framed[MARGIN:-MARGIN, MARGIN:-MARGIN] = self.seen
        found = segmenter.segment(framed)
        return Segmentation(np.asarray(found.mask)[MARGIN:-MARGIN, MARGIN:-MARGIN], found.labels)


def open_picture(path: str | os.PathLike[str]) -> Picture:
    """Read an image file to segment.

    Raises:
        InputError: it cannot be read; the message says why and what to do.
    """
    image = open_image(path, "image")
    shown = rgb_of_pil(image, f"the image {os.fspath(path)}")
    if image.mode not in ("LA", "La", "PA", "RGBA", "RGBa") and "transparency" not in image.info:
        return Picture(shown)
    rgba = np.asarray(image.convert("RGBA"))
    opaque = rgba[rgba[..., 3] > 200][:, :3]
    if not len(opaque) or rgba[..., 3].min() > 200:
        return Picture(shown)
    pale = float((opaque.min(1) >= PALE).mean())
    if pale >= ALL:
        shown = _laid_on(rgba, np.array(DARK))
    if not SOME <= pale < ALL:
        return Picture(shown)
    key = _key(opaque)
    return Picture(shown, _laid_on(rgba, np.array(key)), key)


def _key(colours: UInt8[np.ndarray, "n 3"]) -> tuple[int, int, int]:
    """Of a few strong colours, the one that is furthest from all of the picture's."""
    used = np.unique(colours // 16, axis=0).astype(float) * 16 + 8
    keys = np.array(KEYS, float)
    return KEYS[int(np.linalg.norm(keys[:, None] - used[None], axis=2).min(1).argmax())]


def _laid_on(rgba: UInt8[np.ndarray, "H W 4"], colour: Integer[np.ndarray, " 3"]) -> Image8:
    alpha = rgba[..., 3:].astype(np.float32) / 255
    return np.rint(rgba[..., :3] * alpha + colour * (1 - alpha)).astype(np.uint8)
