"""The data of a scene: what the picture shows, cut into labelled segments."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Float, Int32, Integer, UInt8


@dataclass(frozen=True)
class Segmentation:
    """A label map and its names.

    Attributes:
        mask: (H, W) integer map; 0 is background, k is the segment `labels[k]`.
        labels: segment id -> `"Object:Part"` (a bare `"Object"` is allowed).
    """

    mask: Integer[np.ndarray, "H W"]
    labels: Mapping[int, str]


@dataclass(frozen=True)
class Segment:
    """One labelled piece of the picture.

    Attributes:
        id: its value in the label map.
        name: unique `"Object:Part"` name, numbered by the contract's rule where labels repeat.
        object: the part of the name before the colon (the whole name when there is none).
        part: the part after the colon, or None.
        mask: (H, W) the pixels it owns.
        loops: closed outer outlines, one per component, each (V, 2) vertices in pixels (x, y) with a
            positive shoelace area (clockwise on a screen with y down); inner holes and what lies in them are
            ignored.
        area: pixels inside the outer outlines.
        box: (min x, min y, max x, max y) of the outlines.
    """

    id: int
    name: str
    object: str
    part: str | None
    mask: Bool[np.ndarray, "H W"]
    loops: tuple[Float[np.ndarray, "_ 2"], ...]
    area: float
    box: tuple[float, float, float, float]


@dataclass(frozen=True)
class Layer:
    """Something a vector picture paints in one go, alone and whole: what others hide of it is there too.

    Attributes:
        segment: position of the segment it belongs to, None for what is part of the background.
        data: (h, w, 4) premultiplied red, green, blue and coverage, 0..255.
        top: row of its first row in the picture; may lie outside.
        left: column of its first column.
    """

    segment: int | None
    data: UInt8[np.ndarray, "h w 4"]
    top: int
    left: int


@dataclass(frozen=True)
class Scene:
    """A picture with its segments, in the order of their ids.

    Attributes:
        image: (H, W, 3) the picture.
        segments: the segments, ids ascending.
        background: (3,) colour that fills what a moved segment uncovers.
        layers: for a vector picture what it is painted of, back to front; the picture is their composition on
            white. Empty for a raster picture.
    """

    image: UInt8[np.ndarray, "H W 3"]
    segments: tuple[Segment, ...]
    background: UInt8[np.ndarray, " 3"]
    layers: tuple[Layer, ...] = ()

    @property
    def width(self) -> int:
        """Width of the picture in pixels."""
        return int(self.image.shape[1])

    @property
    def height(self) -> int:
        """Height of the picture in pixels."""
        return int(self.image.shape[0])

    @property
    def size(self) -> int:
        """The larger side, to which thresholds given for 512 x 512 scale."""
        return max(self.width, self.height)

    @property
    def names(self) -> tuple[str, ...]:
        """Unique names of the segments, in order."""
        return tuple(s.name for s in self.segments)

    @property
    def objects(self) -> tuple[str, ...]:
        """Object names in order of first appearance."""
        return tuple(dict.fromkeys(s.object for s in self.segments))

    def position_map(self) -> Int32[np.ndarray, "H W"]:
        """At each pixel the position of the segment that shows there, -1 where none does."""
        out = np.full(self.image.shape[:2], -1, dtype=np.int32)
        for i, segment in enumerate(self.segments):
            out[segment.mask] = i
        return out

    def members(self, name: str) -> tuple[int, ...]:
        """Positions of the segments a name speaks of: one segment, or all parts of an object; () if none."""
        exact = tuple(i for i, s in enumerate(self.segments) if s.name == name)
        return exact or tuple(i for i, s in enumerate(self.segments) if s.object == name)


@dataclass(frozen=True)
class Case:
    """One icon and one request, read from a case folder.

    Attributes:
        id: name of the case.
        request: the edit in words.
        image: (H, W, 3) the picture.
        segmentation: its label map.
        program: text of the reference program, or None.
        folder: where it was read from.
    """

    id: str
    request: str
    image: UInt8[np.ndarray, "H W 3"]
    segmentation: Segmentation
    program: str | None
    folder: Path
