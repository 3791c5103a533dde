"""What a segmenter and a label suggester are."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

import numpy as np
from jaxtyping import UInt8

from iconjax.scene.types import Segmentation


class Segmenter(Protocol):
    """Finds the segments of a picture (paper, "Segmentation Tool"); names may be provisional."""

    name: str

    def segment(self, image: UInt8[np.ndarray, "H W 3"]) -> Segmentation:
        """The label map of `image`, ids 1 to n in reading order, with a name for each.

        Raises:
            InputError: there is nothing to segment, or far more than an icon has; the message says what to do.
        """
        ...


class LabelSuggester(Protocol):
    """Names segments by what they show, for example a vision LLM."""

    @property
    def name(self) -> str:
        """What the user writes to choose it."""
        ...

    def suggest(self, image: UInt8[np.ndarray, "H W 3"], segmentation: Segmentation) -> Mapping[int, str]:
        """An `"Object:Part"` name by segment id; what is left out keeps the name it has.

        Raises:
            IconjaxError: no names could be had; the message says why and what to do.
        """
        ...
