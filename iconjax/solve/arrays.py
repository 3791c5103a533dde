"""The arrays a solve works on: pytrees with static shapes, so that no edit of the same size compiles anything anew."""

from __future__ import annotations

from typing import NamedTuple

from jaxtyping import Float, Int

from iconjax.solve.pose import Array, Bodies


class Regions(NamedTuple):
    """Material regions that a program speaks of, before the edit. R regions; segment N stands for "does not move".

    Attributes:
        hull, hull_segment, hull_mask: support points, the segment that carries each, and 0 for padding.
        points, ends, segment, weight: outline vertices, ends of their edges, carrying segment, share of the length.
        share: (R, N+1) share of each segment in the region's area: its transform is the mean with these weights.
        long_dir, frame: principal axis and own x axis, unit vectors.
        second: index of the other region when this one is `inter(first, second)` of regions `first` and `second`; -1
            where it is a plain region. `first` likewise.
    """

    hull: Float[Array, "R Q 2"]
    hull_segment: Int[Array, "R Q"]
    hull_mask: Float[Array, "R Q"]
    points: Float[Array, "R P 2"]
    ends: Float[Array, "R P 2"]
    segment: Int[Array, "R P"]
    weight: Float[Array, "R P"]
    share: Float[Array, "R N1"]
    long_dir: Float[Array, "R 2"]
    frame: Float[Array, "R 2"]
    first: Int[Array, " R"]
    second: Int[Array, " R"]


class Code(NamedTuple):
    """A constraint program as data. L leaves, which measure regions, fill registers 0..L-1; T steps, which compute with
    values, fill registers L..L+T-1.

    Attributes:
        leaf_op: (L,) number of each leaf's operator.
        region_a, region_b: (L,) its regions.
        extra: (L, 4) its material points (x, y, u, v).
        leaves: () how many leaves are in use.
        step_op: (T,) number of each step's operator.
        value_a, value_b: (T,) registers it reads.
        literal: (T,) the literal it stands for where it is one.
        steps: () how many steps are in use.
        out: (C,) registers that hold a residual; `scale` (C,) brings each to pixels and is 0 for padding.
    """

    leaf_op: Int[Array, " L"]
    region_a: Int[Array, " L"]
    region_b: Int[Array, " L"]
    extra: Float[Array, "L 4"]
    leaves: Int[Array, ""]
    step_op: Int[Array, " T"]
    value_a: Int[Array, " T"]
    value_b: Int[Array, " T"]
    literal: Float[Array, " T"]
    steps: Int[Array, ""]
    out: Int[Array, " C"]
    scale: Float[Array, " C"]


class Joints(NamedTuple):
    """Where segments meet. E relations; padding has weight 0 in every candidate.

    Attributes:
        a, b: (E,) segments.
        points_a, points_b: (E, 3, 2) the middle and the two ends of the contact as material points of each.
        tangent: (E, 2) direction along the contact.
    """

    a: Int[Array, " E"]
    b: Int[Array, " E"]
    points_a: Float[Array, "E 3 2"]
    points_b: Float[Array, "E 3 2"]
    tangent: Float[Array, "E 2"]


class Alignments(NamedTuple):
    """Features of boxes that coincided before the edit. F rows; `b` = N means: with its own old value.

    Attributes:
        a, b: (F,) segments.
        feature: (F,) 0..5 for min x, centre x, max x, min y, centre y, max y.
        offset: (F,) wanted value of a minus value of b.
        slack: (F,) how far off it may be.
    """

    a: Int[Array, " F"]
    b: Int[Array, " F"]
    feature: Int[Array, " F"]
    offset: Float[Array, " F"]
    slack: Float[Array, " F"]


class Problem(NamedTuple):
    """Everything about an edit that all candidates share."""

    code: Code
    regions: Regions
    joints: Joints
    alignments: Alignments
    hull: Float[Array, "N H 2"]
    canvas: Float[Array, "4"]


class Candidate(NamedTuple):
    """One setting of the discrete states, as arrays.

    Attributes:
        body: (N,) the body that carries each segment; K = stays.
        bodies: the bodies with their motion masks.
        hold: (E,) weight of each relation's meeting point.
        ends: (E,) weight of the two ends of its contact.
        slide: (E,) 1 where the two may slide along the contact (weak state), else 0.
        align: (F,) weight of each alignment.
        canvas: () weight of staying in the picture.
    """

    body: Int[Array, " N"]
    bodies: Bodies
    hold: Float[Array, " E"]
    ends: Float[Array, " E"]
    slide: Float[Array, " E"]
    align: Float[Array, " F"]
    canvas: Float[Array, ""]


class Solution(NamedTuple):
    """Result of one solve.

    Attributes:
        z: (K, 5) parameters of the bodies.
        matrices: (N, 6) transform of every segment.
        primary: (C,) residuals of the primary constraints, px.
        loss: () value of the minimised loss.
    """

    z: Float[Array, "K 5"]
    matrices: Float[Array, "N 6"]
    primary: Float[Array, " C"]
    loss: Float[Array, ""]
