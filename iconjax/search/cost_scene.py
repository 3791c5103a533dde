"""Costs of the picture as a whole: alignments and symmetries lost, things off the canvas, new overlaps."""

from __future__ import annotations

import numpy as np

from iconjax.search.evidence import Evidence, Terms
from iconjax.search.facts import Alignment, Mirror
from iconjax.search.motion import same_motion


def surrounding_costs(e: Evidence) -> Terms:
    """Cost of everything that is no matter of one part or one relation."""
    case, costs = e.case, e.case.costs
    lost = sum(_misaligned(e, a) for a in case.facts.alignments)
    yield "misaligned", min(lost, costs.misaligned_most)
    bent = sum(_asymmetric(e, m) for m in case.facts.mirrors)
    yield "asymmetric", min(bent, costs.asymmetric_most)
    yield "off canvas", costs.off_canvas * case.shapes.off_canvas(e.features)
    moved = np.array([i for i in range(len(e.matrices)) if e.moved(i)], int)
    yield "collision", costs.collision * case.shapes.collisions(e.matrices, e.features, moved)


def _misaligned(e: Evidence, a: Alignment) -> float:
    case = e.case
    if (
        a.b is not None
        and a.reason == "siblings"
        and ("translate" in case.asked[a.a]) != ("translate" in case.asked[a.b])
    ):
        return 0.0  # one of a row is asked to leave it
    still = not e.moved(a.a) if a.b is None else same_motion(e.matrices[a.a], e.matrices[a.b])
    if still:
        return 0.0
    before, after = (
        f[a.a, a.feature] - (0.0 if a.b is None else f[a.b, a.feature]) for f in (case.facts.features, e.features)
    )
    off = a.off(float(before), float(after)) / case.unit
    return case.costs.misaligned[a.reason] * min(1.0, off / 15) if off > 1.5 else 0.0


def _asymmetric(e: Evidence, m: Mirror) -> float:
    """A pair that turned, that mirrors about what turned, or of which one was asked to move, is meant to be uneven.

    Where what is between them changes size, both sides of it are to move and not one.
    """
    case = e.case
    turned = any(abs(e.motion.turn[i]) > 0.5 for i in (m.a, m.b, m.about))
    if turned or case.asked[m.a] != case.asked[m.b]:
        return 0.0
    if e.motion.stretch(m.about) > 0.02 and e.moved(m.a) != e.moved(m.b):
        return case.costs.asymmetric
    off = (m.off(e.features) - m.off(case.facts.features)) / case.unit
    return case.costs.asymmetric * min(1.0, off / 15) if off > 2 else 0.0
