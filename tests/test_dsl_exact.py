"""Distances and overlaps of random outlines against exact geometry (shapely)."""

from __future__ import annotations

import dsl_helpers as shapes
import numpy as np
import pytest
import shapely

RANDOM = np.random.default_rng(7)


def star(count=7):
    """A random star-shaped polygon, convex or not, somewhere in a picture."""
    turn = (np.arange(count) + RANDOM.uniform(-0.4, 0.4, count)) * 2 * np.pi / count
    radius = RANDOM.uniform(30, 110, count)
    corners = RANDOM.uniform(150, 360, 2) + np.stack([radius * np.cos(turn), radius * np.sin(turn)], axis=1)
    return shapes.polygon(corners)


PAIRS = [(star(), star()) for _ in range(60)]


@pytest.mark.parametrize(("first", "second"), PAIRS, ids=range(len(PAIRS)))
def test_random_outlines(first, second):
    s, t = shapes.region(first), shapes.region(second)
    p, q = shapely.Polygon(first), shapely.Polygon(second)
    assert shapes.value("min_dist", s, t) == pytest.approx(p.exterior.distance(q.exterior), abs=1e-2)

    clearance = float(shapes.residual("touch", s, t))
    if p.disjoint(q):
        assert clearance == pytest.approx(p.distance(q), abs=1e-2)
    else:
        assert clearance <= 1e-2
    if clearance < -1:
        assert p.intersection(q).area > 1

    out = max(q.distance(shapely.Point(v)) for v in first)
    assert out - 1e-2 <= shapes.value("inside", s, t) <= 2 * out + 1e-2

    shared = shapes.jitted("inter")(s, t)
    if p.intersection(q).area > 1 and p.intersection(q).geom_type == "Polygon":
        box = [shapes.value(name, shared) for name in ("min_x", "min_y", "max_x", "max_y")]
        # An edge that leaves the other outline and comes back is kept whole: the box may be a little large.
        assert box == pytest.approx(p.intersection(q).bounds, abs=3)
