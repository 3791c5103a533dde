"""From a picture and its label map to a scene."""

from __future__ import annotations

from typing import Any

import numpy as np
from jaxtyping import Bool, Integer, UInt8
from scipy.ndimage import find_objects

from iconjax.scene.labels import number_names, split_name
from iconjax.scene.load import check_sizes, load_image, load_segmentation
from iconjax.scene.outline import drop_specks, fill, trace
from iconjax.scene.types import Scene, Segment


def build_scene(image: Any, seg: Any, labels: Any = None) -> Scene:
    """The picture cut into named segments with their outer outlines.

    Args:
        image: anything `load_image` takes.
        seg: anything `load_segmentation` takes.
        labels: names by segment id, as for `load_segmentation`.

    Raises:
        InputError: either cannot be used, or their sizes differ.
    """
    picture = load_image(image)
    segmentation = load_segmentation(seg, labels)
    check_sizes(picture, segmentation)
    mask = np.asarray(segmentation.mask)
    crops = find_objects(mask)
    windows = {i: crops[i - 1] for i in segmentation.labels}
    centres = {i: ((w[1].start + w[1].stop) / 2, (w[0].start + w[0].stop) / 2) for i, w in windows.items()}
    names = number_names(segmentation.labels, centres, picture.shape[1])
    segments = tuple(_segment(i, names[i], mask, windows[i]) for i in sorted(names))
    return Scene(picture, segments, background_colour(picture, mask))


def background_colour(image: UInt8[np.ndarray, "H W 3"], mask: Integer[np.ndarray, "H W"]) -> UInt8[np.ndarray, " 3"]:
    """The most common colour of the unlabelled pixels on the rim, else of all unlabelled ones, else white."""
    free = mask == 0
    rim = np.ones_like(free)
    rim[1:-1, 1:-1] = False
    for where in (free & rim, free):
        pixels = image[where].astype(np.int64)
        if len(pixels):
            codes, counts = np.unique(pixels @ np.array([65536, 256, 1]), return_counts=True)
            code = int(codes[counts.argmax()])
            return np.array([code >> 16, code >> 8 & 255, code & 255], dtype=np.uint8)
    return np.full(3, 255, dtype=np.uint8)


def _segment(number: int, name: str, labels: Integer[np.ndarray, "H W"], window: tuple[slice, slice]) -> Segment:
    crop: Bool[np.ndarray, "h w"] = labels[window] == number
    mask = np.zeros(labels.shape, dtype=bool)
    mask[window] = crop
    solid = fill(drop_specks(crop))
    corner = np.array([window[1].start, window[0].start], dtype=float)
    loops = tuple(loop + corner for loop in trace(solid))
    every = np.concatenate(loops)
    (x0, y0), (x1, y1) = every.min(0), every.max(0)
    thing, part = split_name(name)
    box = (float(x0), float(y0), float(x1), float(y1))
    return Segment(number, name, thing, part, mask, loops, float(solid.sum()), box)
