"""Cheap geometry on moved segments, for judging many candidates."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float, Int

from iconjax.relations.types import Relation
from iconjax.scene.sampling import resample, support_points
from iconjax.scene.types import Scene

OUTLINE = 48


def apply(matrix: Float[np.ndarray, "6"], points: Float[np.ndarray, "m 2"]) -> Float[np.ndarray, "m 2"]:
    """Points under a transform."""
    m = matrix.reshape(2, 3)
    return np.asarray(points @ m[:, :2].T + m[:, 2])


class Shapes:
    """Outlines of all segments, coarse enough to compare hundreds of candidates in a moment."""

    def __init__(self, scene: Scene, relations: tuple[Relation, ...]) -> None:
        self.size, self.width, self.height = scene.size, scene.width, scene.height
        self.hulls = np.stack([support_points(s.loops, 32) for s in scene.segments])
        samples = [resample(s.loops, OUTLINE) for s in scene.segments]
        self.points = np.stack([p for p, _, _ in samples])
        self.ends = np.stack([e for _, e, _ in samples])
        self.start = self.features(np.tile([1.0, 0, 0, 0, 1, 0], (len(self.hulls), 1)))
        met = [r for r in relations if r.kind != "near"]  # what is only near stands apart
        linked = {(r.a, r.b) for r in met} | {(r.b, r.a) for r in met}
        self.apart = [
            (a, b)
            for a in range(len(self.hulls))
            for b in range(a + 1, len(self.hulls))
            if (a, b) not in linked and not self._boxes_meet(self.start, a, b)
        ]
        self.gaps = {(r.a, r.b): self.distance(r.a, r.b, None) for r in relations if r.kind != "inside"}
        self.contained = {(r.a, r.b): self.share_inside(r.a, r.b, None) for r in relations if r.kind == "inside"}

    def features(self, matrices: Float[np.ndarray, "n 6"]) -> Float[np.ndarray, "n 6"]:
        """Box features (min, centre, max of x, then of y) of the moved segments."""
        m = matrices.reshape(-1, 2, 3)
        hull = np.einsum("nij,nkj->nki", m[:, :, :2], self.hulls) + m[:, None, :, 2]
        (x0, y0), (x1, y1) = hull.min(1).T, hull.max(1).T
        return np.stack([x0, (x0 + x1) / 2, x1, y0, (y0 + y1) / 2, y1], 1)

    def slip(
        self,
        r: Relation,
        matrices: Float[np.ndarray, "n 6"],
        turn: Float[np.ndarray, " n"],
        ends: float = 0.5,
    ) -> tuple[float, float]:
        """How far the two sides of a relation's contact have come apart along and across it, px: the worse of its
        middle and, counted by `ends`, of its ends."""
        angle = np.radians((turn[r.a] + turn[r.b]) / 2)
        rotation = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        pairs = np.stack([r.contact.middle, r.contact.first, r.contact.second])
        a, b = apply(matrices[r.a], pairs[:, 0]), apply(matrices[r.b], pairs[:, 1])
        apart = b - a - (pairs[:, 1] - pairs[:, 0]) @ rotation.T
        normal = rotation @ r.contact.normal
        across = np.abs(apart @ normal)
        along = np.abs(apart @ np.array([-normal[1], normal[0]]))
        return float(max(along[0], ends * along[1:].max())), float(max(across[0], ends * across[1:].max()))

    def loss(self, r: Relation, matrices: Float[np.ndarray, "n 6"]) -> float:
        """How far a relation is lost, from 0 (still holds) to 1 (gone)."""
        if r.kind == "inside":
            before, now = self.contained[r.a, r.b], self.share_inside(r.a, r.b, matrices)
            return float(np.clip((before - now - 0.06) / 0.2, 0, 1))
        gap, now = self.gaps[r.a, r.b], self.distance(r.a, r.b, matrices)
        if r.kind == "near" and now < gap / 2:  # what stood apart runs into each other
            return float(np.clip((gap / 2 - now - 0.004 * self.size) / (gap / 2), 0, 1))
        wider = now - gap - 0.004 * self.size
        return float(np.clip(wider / (0.016 * self.size), 0, 1))

    def distance(self, a: int, b: int, matrices: Float[np.ndarray, "n 6"] | None) -> float:
        """Least distance between two outlines, 0 where they overlap, px."""
        pa, ea, pb, eb = self.points[a], self.ends[a], self.points[b], self.ends[b]
        if matrices is not None:
            pa, ea = apply(matrices[a], pa), apply(matrices[a], ea)
            pb, eb = apply(matrices[b], pb), apply(matrices[b], eb)
        if _inside(pa, pb, eb).any() or _inside(pb, pa, ea).any():
            return 0.0
        return float(min(_to_edges(pa, pb, eb).min(), _to_edges(pb, pa, ea).min()))

    def share_inside(self, a: int, b: int, matrices: Float[np.ndarray, "n 6"] | None) -> float:
        """Share of the outline of `a` that lies within the filled outline of `b`, or within 1 % of it."""
        pa, pb, eb = self.points[a], self.points[b], self.ends[b]
        if matrices is not None:
            pa, pb, eb = apply(matrices[a], pa), apply(matrices[b], pb), apply(matrices[b], eb)
        near = _to_edges(pa, pb, eb).min(1) < 0.01 * self.size
        return float((_inside(pa, pb, eb) | near).mean())

    def off_canvas(self, features: Float[np.ndarray, "n 6"]) -> float:
        """Sum over segments of the share of their box that left the picture."""
        total = 0.0
        for low, high, limit in ((0, 2, self.width), (3, 5, self.height)):
            extent = np.maximum(features[:, high] - features[:, low], 1e-6)
            out = np.maximum(0, -features[:, low]) + np.maximum(0, features[:, high] - limit)
            was = np.maximum(0, -self.start[:, low]) + np.maximum(0, self.start[:, high] - limit)
            total += float(np.clip((out - was - 0.002 * self.size) / extent, 0, 1).sum())
        return total

    def _boxes_meet(self, features: Float[np.ndarray, "n 6"], a: int, b: int) -> bool:
        f, g = features[a], features[b]
        return bool(f[0] < g[2] and g[0] < f[2] and f[3] < g[5] and g[3] < f[5])

    def collisions(
        self,
        matrices: Float[np.ndarray, "n 6"],
        features: Float[np.ndarray, "n 6"],
        moved: Int[np.ndarray, " m"],
    ) -> float:
        """How much segments that were apart now overlap: shares of the outline of one inside the other, summed."""
        some = set(moved.tolist())
        total = 0.0
        for a, b in self.apart:
            if (a in some or b in some) and self._boxes_meet(features, a, b):
                pa, ea = apply(matrices[a], self.points[a]), apply(matrices[a], self.ends[a])
                pb, eb = apply(matrices[b], self.points[b]), apply(matrices[b], self.ends[b])
                total += max(float(_inside(pa, pb, eb).mean()), float(_inside(pb, pa, ea).mean()))
        return total


def _to_edges(
    points: Float[np.ndarray, "m 2"], starts: Float[np.ndarray, "k 2"], ends: Float[np.ndarray, "k 2"]
) -> Float[np.ndarray, "m k"]:
    along = ends - starts
    length = (along**2).sum(1) + 1e-12
    t = np.clip(((points[:, None] - starts) * along).sum(-1) / length, 0, 1)
    return np.linalg.norm(points[:, None] - starts - t[..., None] * along, axis=-1)  # type: ignore[no-any-return]


def _inside(
    points: Float[np.ndarray, "m 2"], starts: Float[np.ndarray, "k 2"], ends: Float[np.ndarray, "k 2"]
) -> Bool[np.ndarray, " m"]:
    """Non-zero winding of closed outlines around points."""
    y = points[:, None, 1]
    up = (starts[:, 1] <= y) & (ends[:, 1] > y)
    down = (starts[:, 1] > y) & (ends[:, 1] <= y)
    along = ends - starts
    side = along[:, 0] * (y - starts[:, 1]) - (points[:, None, 0] - starts[:, 0]) * along[:, 1]
    return ((up & (side > 0)).sum(1) - (down & (side < 0)).sum(1)) != 0  # type: ignore[no-any-return]
