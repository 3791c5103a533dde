"""Outer outlines of labelled regions as exact polygons, made without the solver's own geometry.

An outline follows the half-way line between pixels inside and outside (marching squares), so boxes fall on
pixel edges and only the corners of single pixels are cut. Inner holes are ignored.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import shapely
from jaxtyping import Bool, Float, Integer
from shapely.geometry import MultiPolygon, Polygon
from skimage import measure

from iconjax.errors import InputError
from iconjax.evaluation.affine import Matrix


def outer_outline(mask: Bool[np.ndarray, "H W"]) -> MultiPolygon:
    """Outer outline of a region in pixels (x, y), one polygon for each component; empty for an empty mask."""
    components = measure.label(mask, connectivity=2)
    pieces = []
    for region in measure.regionprops(components):
        top, left = region.bbox[:2]
        padded = np.pad(region.image_filled.astype(np.float64), 1)
        contours = measure.find_contours(padded, 0.5, fully_connected="high")
        for contour in contours:
            # The centre of pixel (i, j) of the crop is at (j + 0.5, i + 0.5); the padding is one pixel wide.
            points = contour[:, ::-1] + (left - 0.5, top - 0.5)
            pieces.append(Polygon(points).buffer(0.0))
    return as_multipolygon(shapely.simplify(shapely.union_all(pieces), 0.0))


def outlines_of(mask: Integer[np.ndarray, "H W"], labels: Mapping[int, str]) -> dict[int, MultiPolygon]:
    """Outer outline of every labelled segment in pixels, ids ascending.

    Raises:
        InputError: a label without pixels.
    """
    outlines = {key: outer_outline(mask == key) for key in sorted(labels)}
    for key, outline in outlines.items():
        if outline.is_empty:
            raise InputError(f"segment {key} ({labels[key]!r}) has no pixels in the segmentation")
    return outlines


def as_multipolygon(geometry: shapely.Geometry) -> MultiPolygon:
    """The areas of any geometry, holes filled."""
    polygons = [p for p in shapely.get_parts(geometry) if isinstance(p, Polygon) and not p.is_empty]
    merged = shapely.union_all([Polygon(p.exterior) for p in polygons])
    return MultiPolygon([p for p in shapely.get_parts(merged) if isinstance(p, Polygon)])


def moved(outline: shapely.Geometry, matrix: Matrix, unit: float = 1.0) -> shapely.Geometry:
    """An outline carried by a transform, then scaled by `unit`; valid even where that is singular."""
    result = shapely.transform(outline, lambda p: (p @ matrix[:, :2].T + matrix[:, 2]) * unit)
    return result if result.is_valid else shapely.make_valid(result)


def overlap_share(a: shapely.Geometry, b: shapely.Geometry) -> float:
    """Common area as a share of the smaller one's; 0 where one has no area."""
    smaller = min(a.area, b.area)
    return float(shapely.intersection(a, b).area / smaller) if smaller > 0 else 0.0


def share_inside(shape: shapely.Geometry, region: shapely.Geometry) -> float:
    """Share of a shape's area that lies in a region; 0 where it has no area."""
    return float(shapely.intersection(shape, region).area / shape.area) if shape.area > 0 else 0.0


def sample(outline: MultiPolygon, count: int) -> Float[np.ndarray, "count 2"]:
    """`count` points spread evenly by arc length over all loops of an outline."""
    loops = [shapely.get_coordinates(p.exterior) for p in outline.geoms]
    starts = np.concatenate([loop[:-1] for loop in loops])
    steps = np.concatenate([np.diff(loop, axis=0) for loop in loops])
    ends = np.cumsum(np.linalg.norm(steps, axis=1))
    places = (np.arange(count) + 0.5) * ends[-1] / count
    edge = np.minimum(np.searchsorted(ends, places), len(ends) - 1)
    length = np.linalg.norm(steps[edge], axis=1)
    share = 1.0 - (ends[edge] - places) / np.where(length > 0, length, 1.0)
    return np.asarray(starts[edge] + share[:, None] * steps[edge])


def principal_axis(outline: MultiPolygon) -> Float[np.ndarray, " 2"]:
    """Unit vector of the longer principal axis of an area (second moments by Green's theorem)."""
    total, first, second = 0.0, np.zeros(2), np.zeros((2, 2))
    for polygon in outline.geoms:
        p = shapely.get_coordinates(polygon.exterior)
        a, b = p[:-1], p[1:]
        cross = a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1]
        sign = np.sign(cross.sum()) or 1.0
        total += sign * cross.sum() / 2
        first += sign * ((a + b) * cross[:, None]).sum(axis=0) / 6
        outer = np.einsum("ni,nj->nij", a, a) + np.einsum("ni,nj->nij", b, b)
        mixed = np.einsum("ni,nj->nij", a + b, a + b)
        second += sign * ((outer + mixed) * cross[:, None, None]).sum(axis=0) / 24
    centre = first / total
    _, vectors = np.linalg.eigh(second / total - np.outer(centre, centre))
    return np.asarray(vectors[:, 1])
