"""The segments of a case before and after an edit, and what a name in a check speaks of.

All lengths are brought to a picture whose larger side is 512, which is what the checks are written for.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from jaxtyping import Float
from shapely.geometry import MultiPolygon

from iconjax.errors import InputError
from iconjax.evaluation.affine import Matrix, Motion, Transforms, apply, motion_of, read_transforms
from iconjax.evaluation.outlines import moved, principal_axis
from iconjax.scene.labels import number_names

GRID = 512.0
"""The larger side of the picture that pixel numbers in checks refer to."""

ATTRIBUTES = ("width", "height", "area", "long", "short", "cx", "cy", "minx", "maxx", "miny", "maxy")

Reference = str | Sequence[str]


@dataclass(frozen=True)
class Part:
    """One segment before and after the edit.

    Attributes:
        name: unique label.
        before, after: outer outlines on the 512 grid.
        matrix: transform on the 512 grid.
    """

    name: str
    before: MultiPolygon
    after: shapely.Geometry
    matrix: Matrix

    @cached_property
    def motion(self) -> Motion:
        """Turn and scale of the transform."""
        return motion_of(self.matrix)

    @cached_property
    def travel(self) -> float:
        """Largest distance that a point of the segment moved (reached at a vertex, as the map is affine)."""
        points = shapely.get_coordinates(self.before)
        return float(np.linalg.norm(apply(self.matrix, points) - points, axis=1).max())


@dataclass(frozen=True)
class Shape:
    """One part, or several taken as one thing.

    Attributes:
        parts: the parts.
        name: how a check calls it.
    """

    parts: tuple[Part, ...]
    name: str

    @cached_property
    def before(self) -> shapely.Geometry:
        """Union of the outlines before the edit."""
        return shapely.union_all([p.before for p in self.parts])

    @cached_property
    def after(self) -> shapely.Geometry:
        """Union of the outlines after the edit."""
        return shapely.union_all([p.after for p in self.parts])

    def attribute(self, name: str, old: bool = False) -> float:
        """Value of one of `ATTRIBUTES`, before or after the edit.

        `long` and `short` are the extents of the outline along its two principal axes. The axes are found
        before the edit and carried by the transform (of several parts: by the mean of theirs, by area).
        """
        shape = self.before if old else self.after
        if name == "area":
            return float(shape.area)
        if name in ("long", "short"):
            axis = self._axes(old)[0 if name == "long" else 1]
            along = shapely.get_coordinates(shape) @ axis
            return float(np.ptp(along))
        left, top, right, bottom = shape.bounds
        values = {"minx": left, "maxx": right, "miny": top, "maxy": bottom, "width": right - left}
        values |= {"height": bottom - top, "cx": (left + right) / 2, "cy": (top + bottom) / 2}
        if name not in values:
            raise InputError(f"unknown attribute {name!r}; there are {', '.join(ATTRIBUTES)}")
        return float(values[name])

    def centre(self, old: bool = False) -> Float[np.ndarray, " 2"]:
        """Centre of the bounding box."""
        return np.array([self.attribute("cx", old), self.attribute("cy", old)])

    def _axes(self, old: bool) -> Float[np.ndarray, "2 2"]:
        long = principal_axis(MultiPolygon([g for p in self.parts for g in p.before.geoms]))
        axes = np.array([long, (-long[1], long[0])])
        if old:
            return axes
        areas = [p.before.area for p in self.parts]
        linear = np.average([p.matrix[:, :2] for p in self.parts], axis=0, weights=areas)
        carried = axes @ linear.T
        lengths = np.linalg.norm(carried, axis=1, keepdims=True)
        return np.asarray(carried / np.where(lengths > 0, lengths, 1.0))


class Stage:
    """All parts of a case under one edit.

    Args:
        size: width and height of the picture in pixels.
        outlines: segment id -> outer outline in pixels.
        labels: segment id -> label.
        transforms: segment id -> 2x3 matrix in pixels of the picture; a segment left out stays.

    Raises:
        InputError: transforms that cannot be used.
    """

    def __init__(
        self,
        size: tuple[int, int],
        outlines: Mapping[int, MultiPolygon],
        labels: Mapping[int, str],
        transforms: Transforms,
    ):
        unit = GRID / max(size)
        self.canvas = shapely.box(0.0, 0.0, size[0] * unit, size[1] * unit)
        matrices = read_transforms(transforms, sorted(labels))
        self.parts = tuple(
            Part(
                name=name,
                before=shapely.transform(outlines[key], lambda p: p * unit),
                after=moved(outlines[key], matrices[key], unit),
                matrix=matrices[key] * (1.0, 1.0, unit),
            )
            for key, name in unique_names(outlines, labels, size[0]).items()
        )
        self._labels = tuple(labels[key] for key in sorted(labels))

    def shape(self, reference: Reference) -> Shape:
        """What a label, an object name, or a list of them speaks of.

        Raises:
            InputError: an unknown name.
        """
        names = (reference,) if isinstance(reference, str) else tuple(reference)
        found: dict[str, Part] = {}
        for name in names:
            found |= {part.name: part for part in self._members(name)}
        return Shape(tuple(found.values()), " + ".join(names))

    def _members(self, name: str) -> list[Part]:
        pairs = list(zip(self.parts, self._labels, strict=True))
        for match in (
            [p for p, _ in pairs if p.name == name],
            [p for p, label in pairs if label == name],
            [p for p, label in pairs if label.partition(":")[0] == name],
        ):
            if match:
                return match
        raise InputError(f"unknown name {name!r}; the segments are {', '.join(p.name for p in self.parts)}")


def unique_names(outlines: Mapping[int, MultiPolygon], labels: Mapping[int, str], width: float) -> dict[int, str]:
    """Segment id -> unique name, ids ascending; labels that repeat are numbered as in a scene."""
    bounds = {key: outlines[key].bounds for key in sorted(labels)}
    centres = {key: ((b[0] + b[2]) / 2, (b[1] + b[3]) / 2) for key, b in bounds.items()}
    return number_names({key: labels[key] for key in bounds}, centres, width)
