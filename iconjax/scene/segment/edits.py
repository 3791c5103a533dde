"""Small corrections of a segmentation by hand."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from iconjax.errors import InputError
from iconjax.scene.types import Segmentation


def read_merges(text: str) -> tuple[int, ...]:
    """The segment numbers in text like "3,4".

    Raises:
        InputError: it is not that.
    """
    words = text.replace(",", " ").split()
    if len(words) < 2 or not all(word.isdecimal() and int(word) > 0 for word in words):
        raise InputError(f"cannot merge {text!r}: write the numbers of two segments or more, like 3,4")
    return tuple(int(word) for word in words)


def merge_segments(found: Segmentation, groups: Sequence[Sequence[int]]) -> Segmentation:
    """One segment of each group, under its first number and name; the other numbers stay what they are.

    Raises:
        InputError: a number that is no segment, or that is in two groups.
    """
    if not groups:
        return found
    every = [k for group in groups for k in group]
    unknown = next((k for k in every if k not in found.labels), None)
    if unknown is not None:
        raise InputError(f"cannot merge segment {unknown}: the segments are 1 to {max(found.labels)}")
    if len(set(every)) < len(every):
        raise InputError("cannot merge a segment twice: name each number once")
    table = np.arange(int(np.max(found.mask)) + 1)
    for first, *others in groups:
        table[others] = first
    gone = {k for _, *others in groups for k in others}
    mask = table[np.asarray(found.mask)].astype(np.int32)
    return Segmentation(mask, {k: name for k, name in found.labels.items() if k not in gone})
