"""Provisional names for segments that nobody has named: what a person could call them by sight."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Int, UInt8
from scipy import ndimage

from iconjax.scene.colours import colour_word
from iconjax.scene.outline import fill

SOLID = 0.93
"""Least share of its convex hull that a segment fills to have a name, and of its smallest box to be a rectangle."""
ELLIPSE = 0.985
"""Least share of the ellipse with its moments that a round segment has in area."""
BAR = 2.5
"""A straight piece is a bar from this ratio of length to breadth."""
EQUAL = 1.12
"""Sides of a square, and axes of a circle, differ by less than this ratio."""
STAIRS = 0.35
"""Pixels that a slanting pair of sides lacks of its hull, for each pixel of length."""
PIXEL = 0.8
"""How much wider, on the mean over directions, a shape is than the box of its pixels' centres."""
RING = 0.12
"""Least share of a disc that a hole takes to make it a ring."""

KINDS = frozenset(["circle", "ring", "oval", "square", "rectangle", "bar", "triangle", "piece", "ellipse", "line"])
"""What provisional names call things, also in an SVG."""


def provisional_names(
    labels: Int[np.ndarray, "H W"], image: UInt8[np.ndarray, "H W 3"], colours: bool = True
) -> dict[int, str]:
    """Names such as "Red circle 1" or "Grey bar 2" for the segments 1..n, each with its own number.

    Args:
        labels: the label map.
        image: the picture.
        colours: False where all segments have one colour, so that it tells nothing.
    """
    names = {}
    for k, window in enumerate(ndimage.find_objects(labels), 1):
        if window is None:
            continue
        mask = labels[window] == k
        kind = shape_word(mask)
        middle = np.median(image[window][mask], axis=0).astype(float)
        names[k] = numbered_name(f"{colour_word(middle)} {kind}" if colours else kind.capitalize(), k)
    return names


def numbered_name(name: str, number: int) -> str:
    """A provisional name with its segment's number: unique, and one numbering with that on the sheet."""
    return f"{name} {number}"


def is_provisional(name: str, number: int) -> bool:
    """Whether a segment's name looks like one that `numbered_name` made for it."""
    words = name.rpartition(":")[2].casefold().split()
    return len(words) >= 2 and words[-1] == str(number) and words[-2] in KINDS


def shape_word(mask: Bool[np.ndarray, "h w"]) -> str:
    """What something is called: circle, ring, oval, square, rectangle, bar, triangle, else piece.

    The built-in translator has to understand these nouns; "shape" it reads as a word about proportions.
    """
    from skimage.measure import regionprops

    whole = fill(mask)
    (props,) = regionprops(whole.astype(np.uint8))
    area, long, short = float(props.area), props.axis_major_length, max(props.axis_minor_length, 1.0)
    stairs = STAIRS * long
    if area + stairs < SOLID * props.area_convex:
        return "piece"
    if area > ELLIPSE * np.pi / 4 * long * short:  # axes of the ellipse with the same moments
        hole = 1.0 - np.count_nonzero(mask) / area
        if long < EQUAL * short:
            return "ring" if hole > RING else "circle"
        return "oval" if long < BAR * short else "bar"
    side, other = _smallest_box(whole)
    if area + stairs > SOLID * side * other:
        return "bar" if side > BAR * other else "square" if side < EQUAL * other else "rectangle"
    return "triangle" if 0.45 < area / (side * other) < 0.55 else "piece"


def _smallest_box(mask: Bool[np.ndarray, "h w"]) -> tuple[float, float]:
    """Longer and shorter side of the smallest upright or turned box around a mask."""
    from shapely import MultiPoint, get_coordinates

    rows, cols = np.nonzero(mask ^ ndimage.binary_erosion(mask))
    corners = get_coordinates(MultiPoint(np.stack([cols, rows], 1)).minimum_rotated_rectangle)
    if len(corners) < 4:  # the pixels lie on a line
        return float(np.ptp(rows) + np.ptp(cols) + 1), 1.0
    sides = np.linalg.norm(np.diff(corners[:3], axis=0), axis=1) + PIXEL
    return float(sides.max()), float(sides.min())
