"""Facts about a scene that the search weighs: sizes, details, what stands on the ground, what is aligned."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from iconjax.relations.types import Relation
from iconjax.scene.sampling import elongation, principal_axis, support_points
from iconjax.scene.types import Scene, Segment

ALIGNED = 0.005
"""Box features that differ by less than this share of the picture's larger side count as aligned."""
GROUND = 0.03
"""A segment stands on the ground when its lower edge is within this share of the picture's lowest one."""

LODGED = 0.7
"""Share of its outline along the parts of one other object from which on a small segment is a detail of that object."""
FLAT = 0.3
"""Share of a segment's width that its lowest slice has at least where it stands on it."""
SYMMETRIC = 0.9
"""Overlap of a picture with itself upside down from which on it counts as seen from above."""


@dataclass(frozen=True)
class Alignment:
    """Two box features that coincide; `b` None: a feature that should keep its place.

    Attributes:
        a, b: segments.
        feature: 0..5 for min x, centre x, max x, min y, centre y, max y.
        reason: "touching", "siblings", "ground", "support" for what is put on top of something, "overhang" for what
            does not stick out beyond what it rests on, "floor" for what does not sink into the ground.
        low, high: how much less or more than before the difference of the two features may be, px.
        wanted: difference of the two features to aim at where it is not the one before, px.
    """

    a: int
    b: int | None
    feature: int
    reason: str
    low: float = 0.0
    high: float = 0.0
    wanted: float | None = None

    def off(self, before: float, after: float) -> float:
        """How far a difference of features is outside what is allowed, px."""
        change = after - (before if self.wanted is None else self.wanted)
        return max(0.0, change - self.high, -self.low - change)


@dataclass(frozen=True)
class Mirror:
    """Segments `a` and `b` lie on both sides of the middle of `about`, equally far and equally large.

    Attributes:
        axis: 0 where they mirror each other from left to right, 1 from top to bottom.
    """

    a: int
    b: int
    about: int
    axis: int

    def off(self, features: Float[np.ndarray, "n 6"]) -> float:
        """How far the two are from mirroring each other, px."""
        low, mid, high = 3 * self.axis, 3 * self.axis + 1, 3 * self.axis + 2
        centre = 2 * features[self.about, mid]
        outer = abs(centre - features[self.a, low] - features[self.b, high])
        return float(max(outer, abs(centre - features[self.a, high] - features[self.b, low])))


@dataclass(frozen=True)
class Facts:
    """What the search needs to know about the unedited scene, by position of the segment.

    Attributes:
        features: (n, 6) box features, px.
        area: (n,) share of each segment in the area of all.
        round: segments that look like discs, for which a change of proportions shows most.
        elongated: ratio of the principal extents.
        long_dir: (n, 2) principal axis of each, unit vectors.
        host: the segment that each detail lies in or on, None where it is no detail.
        grounded: segments that stand on the ground.
        alignments: features that coincide.
        mirrors: pairs of segments that mirror each other about a third.
        hung: segments that hang from another object by their top: gravity keeps them upright.
    """

    features: Float[np.ndarray, "n 6"]
    area: Float[np.ndarray, " n"]
    round: Bool[np.ndarray, " n"]
    elongated: Float[np.ndarray, " n"]
    long_dir: Float[np.ndarray, "n 2"]
    host: tuple[int | None, ...]
    grounded: Bool[np.ndarray, " n"]
    alignments: tuple[Alignment, ...]
    mirrors: tuple[Mirror, ...]
    hung: Bool[np.ndarray, " n"]


def gather_facts(scene: Scene, relations: Sequence[Relation]) -> Facts:
    """Measure `scene`."""
    boxes = np.array([s.box for s in scene.segments])
    x0, y0, x1, y1 = boxes.T
    features = np.stack([x0, (x0 + x1) / 2, x1, y0, (y0 + y1) / 2, y1], 1)
    area = np.array([s.area for s in scene.segments])
    disc = np.pi / 4 * (x1 - x0) * (y1 - y0)
    hull = np.array([_polygon_area(support_points(s.loops, 64)) for s in scene.segments])
    square = np.minimum(x1 - x0, y1 - y0) / np.maximum(np.maximum(x1 - x0, y1 - y0), 1e-9)
    hung = _hung(scene, relations, features)
    disc_like = (square > 0.88) & (np.abs(hull / np.maximum(disc, 1e-9) - 1) < 0.08)
    grounded = _grounded(scene, boxes) & ~(hung & disc_like)  # a disc that hangs may reach as low as anything
    host = _hosts(scene, relations)
    return Facts(
        features=features,
        area=area / area.sum(),
        round=disc_like,
        elongated=np.array([elongation(s.loops) for s in scene.segments]),
        long_dir=np.array([principal_axis(s.loops) for s in scene.segments]),
        host=host,
        grounded=grounded,
        alignments=_alignments(scene, relations, features, grounded),
        mirrors=_mirrors(scene, relations, features),
        hung=hung,
    )


def _hung(scene: Scene, relations: Sequence[Relation], features: Float[np.ndarray, "n 6"]) -> Bool[np.ndarray, " n"]:
    hung = np.zeros(len(features), bool)
    for name in scene.objects:
        members = list(scene.members(name))
        outside = [
            r for r in relations if r.scope == "inter" and r.kind == "overlap" and (r.a in members) != (r.b in members)
        ]
        if len(outside) != 1:
            continue
        contact = outside[0].contact
        x, y = contact.middle.mean(0)
        low, high = features[members][:, [0, 3]].min(0), features[members][:, [2, 5]].max(0)
        width, height = high - low
        at_top = y <= low[1] + 0.2 * height
        below = abs(x - (low[0] + high[0]) / 2) <= 0.2 * width
        hung[members] = at_top and below and contact.length <= 0.5 * width
    return hung


def _mirrors(scene: Scene, relations: Sequence[Relation], features: Float[np.ndarray, "n 6"]) -> tuple[Mirror, ...]:
    near: dict[int, list[int]] = {}
    for r in relations:
        near.setdefault(r.a, []).append(r.b)
        near.setdefault(r.b, []).append(r.a)
    found = []
    for about, others in near.items():
        for k, a in enumerate(others):
            for b in others[k + 1 :]:
                for axis in (0, 1):
                    mirror = Mirror(a, b, about, axis)
                    apart = abs(features[a, 3 * axis + 1] - features[b, 3 * axis + 1]) > 0.02 * scene.size
                    if apart and mirror.off(features) <= 0.012 * scene.size:
                        found.append(mirror)
    return tuple(found)


def _overhangs(
    scene: Scene, relations: Sequence[Relation], features: Float[np.ndarray, "n 6"], limit: float
) -> list[Alignment]:
    """Where one segment lies within the extent of another along their contact, it goes on doing so."""
    found = []
    for r in relations:
        if r.kind != "overlap":
            continue
        low, high = (0, 2) if abs(r.contact.normal[1]) > 0.9 else (3, 5)
        if max(abs(r.contact.normal)) <= 0.9:
            continue
        for a, b in ((r.a, r.b), (r.b, r.a)):
            if features[a, low] - features[b, low] >= limit and features[b, high] - features[a, high] >= limit:
                for one, other, feature in ((a, b, low), (b, a, high)):
                    room = float(features[one, feature] - features[other, feature])
                    found.append(Alignment(one, other, feature, "overhang", room, 4.0 * scene.size))
    return found


def _grounded(scene: Scene, boxes: Float[np.ndarray, "n 4"]) -> Bool[np.ndarray, " n"]:
    """Segments that the picture stands on: at its lower edge, and flat there or level with another one.

    A picture that looks the same upside down has no ground.
    """
    whole = np.any([s.mask for s in scene.segments], axis=0)
    rows, cols = np.flatnonzero(whole.any(1)), np.flatnonzero(whole.any(0))
    crop = whole[rows[0] : rows[-1] + 1, cols[0] : cols[-1] + 1]
    if (crop & crop[::-1]).sum() > SYMMETRIC * (crop | crop[::-1]).sum():
        return np.zeros(len(boxes), bool)
    bottom = boxes[:, 3]
    low = bottom >= bottom.max() - GROUND * scene.size
    level = np.abs(bottom[:, None] - bottom) <= 2 + ALIGNED * scene.size
    apart = (boxes[:, None, 0] > boxes[:, 2]) | (boxes[:, None, 2] < boxes[:, 0])
    paired = (level & apart & low & low[:, None]).any(1)
    return np.asarray(low & (paired | np.array([_flat(s) for s in scene.segments])))


def _flat(segment: Segment) -> bool:
    """Whether the lowest slice of a segment is broad."""
    rows, cols = np.nonzero(segment.mask)
    slice_ = cols[rows >= rows.max() - max(2, 0.04 * np.ptp(rows))]
    return bool(np.ptp(slice_) + 1 >= FLAT * (np.ptp(cols) + 1))


def _lodged(scene: Scene, relations: Sequence[Relation]) -> dict[int, int]:
    """Small segments most of whose outline lies along several parts of one object, with the part they touch most."""
    along: dict[tuple[int, str], list[tuple[float, int]]] = {}
    for r in relations:
        if r.kind != "overlap" or r.contact.gap > 2:
            continue
        for small, large, share in ((r.a, r.b, r.contact.share), (r.b, r.a, r.contact.share_b)):
            if scene.segments[small].area < 0.5 * scene.segments[large].area:
                along.setdefault((small, scene.segments[large].object), []).append((share, large))
    return {
        small: max(parts)[1]
        for (small, object_name), parts in along.items()
        if len(parts) > 1 and sum(s for s, _ in parts) >= LODGED and scene.segments[small].object != object_name
    }


def _polygon_area(loop: Float[np.ndarray, "v 2"]) -> float:
    x, y = loop[:, 0], loop[:, 1]
    return float(abs(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)) / 2)


def _hosts(scene: Scene, relations: Sequence[Relation]) -> tuple[int | None, ...]:
    host: list[int | None] = [None] * len(scene.segments)
    for r in relations:
        if r.kind == "inside" and r.embedded:
            best = host[r.a]
            if best is None or scene.segments[r.b].area < scene.segments[best].area:
                host[r.a] = r.b
    for small, large in _lodged(scene, relations).items():
        if host[small] is None:
            host[small] = large
    return tuple(host)


def _alignments(
    scene: Scene,
    relations: Sequence[Relation],
    features: Float[np.ndarray, "n 6"],
    grounded: Bool[np.ndarray, " n"],
) -> tuple[Alignment, ...]:
    limit = ALIGNED * scene.size
    found = [Alignment(int(i), None, 5, "ground") for i in np.flatnonzero(grounded)]
    if grounded.any():
        floor = features[:, 5].max()
        low = 8.0 * scene.size
        found += [Alignment(i, None, 5, "floor", low, float(floor - f[5])) for i, f in enumerate(features)]
    linked = {(r.a, r.b) for r in relations if r.kind != "near"}
    for a, b in sorted(linked):
        for f in np.flatnonzero(np.abs(features[a] - features[b]) <= limit).tolist():
            found.append(Alignment(a, b, int(f), "touching"))
    found += _overhangs(scene, relations, features, limit)
    size = features[:, [2, 5]] - features[:, [0, 3]]
    for a in range(len(features)):
        for b in range(a + 1, len(features)):
            alike = np.all(np.abs(size[a] - size[b]) <= 0.06 * np.maximum(size[a], size[b]) + 1)
            same = scene.segments[a].object == scene.segments[b].object
            if not (alike and same) or (a, b) in linked or (b, a) in linked:
                continue
            for f in (1, 4):
                if abs(features[a, f] - features[b, f]) <= limit:
                    found.append(Alignment(a, b, f, "siblings"))
    return tuple(found)
