"""Material regions: what the geometric operators of the DSL look at."""

from __future__ import annotations

from typing import NamedTuple

from jaxtyping import Array, Bool, Float


class Region(NamedTuple):
    """A set of material (one segment, a union, a side of one) in its current pose; a pytree with static shapes.

    Attributes:
        hull: (Q, 2) support points of the outlines, current pose; extremes of the region are extremes of these.
        hull0: (Q, 2) the same material points before the edit.
        hull_mask: (Q,) False marks padding.
        points: (P, 2) outline vertices, current pose, in order along each closed loop.
        ends: (P, 2) the end of the outline edge that starts at each of `points`; a padding edge has zero length.
        points0: (P, 2) `points` before the edit.
        weight: (P,) share of outline length each point stands for; sums to 1, 0 marks padding (which may sit anywhere).
        matrix: (2, 3) affine transform of the region as one thing (area-weighted mean over its segments).
        long_dir0: (2,) unit principal axis before the edit.
        frame0: (2,) unit vector of the region's own x axis before the edit (the scaling frame).
    """

    hull: Float[Array, "Q 2"]
    hull0: Float[Array, "Q 2"]
    hull_mask: Bool[Array, " Q"]
    points: Float[Array, "P 2"]
    ends: Float[Array, "P 2"]
    points0: Float[Array, "P 2"]
    weight: Float[Array, " P"]
    matrix: Float[Array, "2 3"]
    long_dir0: Float[Array, "2"]
    frame0: Float[Array, "2"]
