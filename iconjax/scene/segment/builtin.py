"""Segmenters without a model: flat colours, glyphs, and the automatic choice between them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int, UInt8
from scipy import ndimage

from iconjax.errors import InputError
from iconjax.scene.colours import lab
from iconjax.scene.segment import merge
from iconjax.scene.segment.core import absorb, patches
from iconjax.scene.segment.names import provisional_names
from iconjax.scene.segment.necks import cut_necks
from iconjax.scene.segment.regions import measure, renumber
from iconjax.scene.segment.resize import at_full_size, working_copy
from iconjax.scene.types import Segmentation

MOST = 24
"""Segments that a person can still name; of more, the most similar neighbours are united."""
TOO_MANY = 80
"""More loose pieces than this are noise, not an icon."""
EMPTY = "the picture has one colour, or nothing on its background: there is nothing to segment"
FLAT = 0.4
"""An icon has at least this share of its pixels in patches of one colour; a photograph or noise has less."""
ONE_COLOUR, INK = 14.0, 0.97
"""A glyph has this share of what is drawn within this CIELAB distance of one colour."""
WHITE, RIM = 250, 0.1
"""White is the background where this share of the picture's rim is at least so bright in all channels."""

Labels = Int[np.ndarray, "h w"]
Pixels = Float[np.ndarray, "h w 3"]


@dataclass(frozen=True)
class AutoSegmenter:
    """Flat colours, and for a picture in one colour also necks.

    Attributes:
        holes: whether what has the background's colour inside a shape is a segment, not a hole.
        most: largest number of segments.
    """

    holes: bool = False
    most: int = MOST
    name: str = "auto"

    def segment(self, image: UInt8[np.ndarray, "H W 3"]) -> Segmentation:
        """See `Segmenter`."""
        pixels = working_copy(image)
        labels, glyph = _colour_regions(pixels, self.holes, self.most, len(pixels) <= len(image))
        return _named(_cut(labels) if glyph else labels, image, colours=not glyph)


@dataclass(frozen=True)
class ColourSegmenter:
    """Patches of flat or smoothly changing colour, however many colours there are; attributes as `AutoSegmenter`."""

    holes: bool = False
    most: int = MOST
    name: str = "colour"

    def segment(self, image: UInt8[np.ndarray, "H W 3"]) -> Segmentation:
        """See `Segmenter`."""
        pixels = working_copy(image)
        labels, _ = _colour_regions(pixels, self.holes, self.most, len(pixels) <= len(image))
        return _named(labels, image, colours=True)


@dataclass(frozen=True)
class GlyphSegmenter:
    """Connected pieces of ink, which is every colour but the background's, cut at necks; as `AutoSegmenter`."""

    holes: bool = False
    most: int = MOST
    name: str = "glyph"

    def segment(self, image: UInt8[np.ndarray, "H W 3"]) -> Segmentation:
        """See `Segmenter`."""
        pixels = working_copy(image)
        away = np.linalg.norm(lab(pixels) - lab(background(pixels)[None, None]), axis=2)
        ink = np.clip(255 * (1.5 - 2 * away / max(float(np.percentile(away, 99)), 1.0)), 0, 255)
        grey = np.repeat(ink[..., None], 3, 2).astype(np.float32)
        labels, _ = _colour_regions(grey, self.holes, self.most, gradients=False)
        return _named(_cut(labels), image, colours=False)


def background(pixels: Pixels) -> Float[np.ndarray, " 3"]:
    """The colour behind a picture: white where its rim has some, else the most common on the rim."""
    rim = np.concatenate([pixels[0], pixels[-1], pixels[1:-1, 0], pixels[1:-1, -1]])
    if (rim.min(1) >= WHITE).mean() >= RIM:
        return np.full(3, 255.0, np.float32)
    colours, counts = np.unique(np.rint(rim), axis=0, return_counts=True)
    return np.asarray(colours[counts.argmax()], np.float32)


def _colour_regions(pixels: Pixels, holes: bool, most: int, gradients: bool) -> tuple[Labels, bool]:
    """Segments 1..n over the background 0, and whether they have one colour; `gradients` as in `mixtures`."""
    colour = lab(pixels)
    ground = lab(background(pixels)[None, None])[0, 0]
    found = patches(pixels, colour, gradients)
    if (found > 0).mean() < FLAT:
        raise InputError(
            "the picture has hardly any flat colours: it looks like a photograph or noise, not an icon; "
            "draw its segmentation by hand, or flatten its colours first"
        )
    labels, source = absorb(found, pixels)
    clean = colour.reshape(-1, 3)[source]
    labels = merge.join_smooth(labels, clean)
    labels = merge.join_small(labels, clean, ground)
    labels = merge.join_patterns(labels, clean, ground)
    labels = merge.join_highlights(labels, clean, ground)
    labels = merge.join_cheapest(labels, clean, ground, most)
    regions = measure(labels, clean)
    behind = merge.background_of(regions, ground)
    if holes:
        behind &= regions.rim > 0
    shown = ~behind[1:]
    weight, colours = regions.area[1:][shown], regions.colour[1:][shown]
    if not len(weight):
        raise InputError(EMPTY)
    if len(weight) > TOO_MANY:
        raise InputError(
            f"the picture falls into {len(weight)} loose pieces, at most {TOO_MANY} are segmented: remove noise and "
            "specks, or draw its segmentation by hand"
        )
    alike = np.linalg.norm(colours - colours[weight.argmax()], axis=1) < ONE_COLOUR
    return renumber(np.where(behind[labels], 0, labels)), bool(weight[alike].sum() > INK * weight.sum())


def _cut(labels: Labels) -> Labels:
    """Every connected segment cut at its necks."""
    out = np.zeros_like(labels)
    count = 0
    for k, window in enumerate(ndimage.find_objects(labels), 1):
        mask = labels[window] == k
        pieces = ndimage.label(mask, np.ones((3, 3)))[1]
        bodies = cut_necks(mask) if pieces == 1 else mask.astype(labels.dtype)
        out[window][mask] = bodies[mask] + count
        count += int(bodies.max())
    return out


def _named(labels: Labels, image: UInt8[np.ndarray, "H W 3"], colours: bool) -> Segmentation:
    """The label map at the picture's size, numbered in reading order, with provisional names."""
    mask = renumber(at_full_size(labels, image))
    if not mask.any():
        raise InputError(EMPTY)
    n = int(mask.max())
    middle = np.array(ndimage.center_of_mass(np.ones_like(mask), mask, range(1, n + 1)))
    row = np.floor(middle[:, 0] * 8 / mask.shape[0])
    number = np.zeros(n + 1, dtype=np.int32)
    number[1 + np.lexsort((middle[:, 1], row))] = np.arange(1, n + 1)
    mask = number[mask]
    return Segmentation(mask, provisional_names(mask, image, colours))
