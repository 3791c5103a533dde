"""Numbers that compare an edit with one possible solution, and whether its reference constraints hold."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np
from jaxtyping import UInt8
from scipy.spatial import KDTree

from iconjax.errors import InputError
from iconjax.evaluation.affine import Transforms, apply, read_transforms
from iconjax.evaluation.cases import EvalCase
from iconjax.evaluation.outlines import sample
from iconjax.search.types import ConstraintReport

POINTS = 256
"""Points on the outline of each segment for the Chamfer distance."""

PIXEL_SHARE = 0.01
"""A length holds within this share of the larger side of the picture; a bare ratio within this much."""

DEGREES = 2.0
"""An angle holds within so many degrees."""

Measure = Callable[[EvalCase, Transforms], Iterable[ConstraintReport]]
"""Measures the reference program of a case on an edit: one report for each constraint."""


def chamfer(case: EvalCase, transforms: Transforms, truth: Transforms | None = None) -> float:
    """Relative Chamfer distance (CD) of an edit to the possible solution of a case; 0 is equal.

    The mean over all segments of the two mean nearest distances between their outlines, divided by the root
    of the area of the solution's box. Both outlines are the same 256 material points, spread evenly by arc
    length before the edit.

    Args:
        case: the case.
        transforms: the edit; a segment left out stays.
        truth: what to compare with, the solution of the case by default.
    """
    ids = sorted(case.labels)
    edit = read_transforms(transforms, ids)
    solution = read_transforms(case.truth if truth is None else truth, ids)
    distances = []
    for key in ids:
        points = sample(case.outlines[key], POINTS)
        p, q = apply(edit[key], points), apply(solution[key], points)
        there, back = KDTree(q).query(p)[0].mean(), KDTree(p).query(q)[0].mean()
        # A solution that flattens a segment has no area to compare with; one pixel keeps the number finite.
        distances.append((there + back) / np.sqrt(np.prod(np.maximum(np.ptp(q, axis=0), 1.0))))
    return float(np.mean(distances))


def mse(image: UInt8[np.ndarray, "H W 3"], truth: UInt8[np.ndarray, "H W 3"]) -> float:
    """Mean squared difference of two pictures over pixels and channels, values 0..255.

    Raises:
        InputError: the pictures differ in size.
    """
    if image.shape != truth.shape:
        raise InputError(f"the edited picture has shape {image.shape}, the solution {truth.shape}")
    return float(np.mean((image.astype(np.float64) - truth.astype(np.float64)) ** 2))


def holds(report: ConstraintReport, size: int) -> bool:
    """Whether a constraint holds well enough, in a picture whose larger side is `size`."""
    return report.violation <= allowed(report.unit, size)


def allowed(unit: str, size: int) -> float:
    """How far a constraint may be off, in its own unit.

    Of an area, as much as a length may be off times a quarter of the side.
    """
    lengths = {"px": PIXEL_SHARE * size, "px2": PIXEL_SHARE * size * size / 4, "deg": DEGREES}
    return lengths.get(unit, PIXEL_SHARE)


def satisfied(reports: Iterable[ConstraintReport], size: int) -> bool:
    """Whether all constraints hold within the tolerance of the metric."""
    return all(holds(report, size) for report in reports)
