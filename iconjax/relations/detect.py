"""Detecting relations in the unedited picture (paper, "Relation Detection for Secondary Constraints")."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np
from jaxtyping import Bool
from scipy.ndimage import binary_fill_holes

from iconjax.relations.contact import Border, find_contact
from iconjax.relations.crucial import assign_scopes, bridge_components, bridge_objects
from iconjax.relations.types import Contact, Kind, Relation
from iconjax.scene.types import Scene

INTRA_REACH = 0.05
"""Widest white gap that still connects two parts of one object, as a share of the picture's larger side: glyph icons
separate connected parts by 17 to 23 px of 512."""
INTER_REACH = 0.012
"""The same between objects, which are separate things unless they (nearly) touch."""
ALIKE = 6
"""Largest difference of mean colours (0..255, any channel) in a picture whose segments are all of one colour."""
GAP_SPREAD = 1.3
"""How much wider than a picture's usual gap one may be that still is a contact between objects of one colour."""
SLACK = 0.008
"""How much further than the nearest points of two outlines a pair may be and still belong to their contact."""
INSIDE_SHARE = 0.9
"""Share of a segment that has to lie within the other's filled outline to be inside it (the paper's proxy ratio)."""
EMBEDDED_CONTACT = 0.6
"""Share of a segment's outline along its host from which on it counts as lying in or on it."""


def detect_relations(scene: Scene, crucial: frozenset[frozenset[str]] | None = None) -> tuple[Relation, ...]:
    """All candidate secondary relations of `scene`, each pair at most once, in order of the pair.

    Thin white gaps between parts of one object are bridged in proportion to the picture. An object whose parts have no
    contact gets "near" relations that hold it together.

    Args:
        scene: the unedited picture.
        crucial: pairs of segment names whose relation holds their object together, as somebody who looked at the
            picture says (paper: a vision LLM); None leaves it to the rule of `assign_scopes`.
    """
    filled = [binary_fill_holes(s.mask) for s in scene.segments]
    borders = [Border(m) for m in filled]
    reach = inter_reach(scene, borders)
    found: list[Relation] = []
    for a, b in combinations(range(len(scene.segments)), 2):
        relation = _relate(scene, a, b, filled, borders, reach)
        if relation is not None:
            found.append(relation)
    found = assign_scopes(scene, found, crucial)
    found += bridge_components(scene, found, borders)
    return tuple(found + bridge_objects(scene, found, borders))


def inter_reach(scene: Scene, borders: Sequence[Border]) -> float:
    """Widest gap that connects segments of different objects, px.

    Where everything is of one colour (a glyph), things that meet cannot be drawn touching: they would run into one
    another. Such a picture separates them by a gap of its own usual width, which counts as a contact.
    """
    least = INTER_REACH * scene.size
    colours = np.array([scene.image[s.mask].mean(0) for s in scene.segments])
    if np.ptp(colours, axis=0).max() > ALIKE:
        return least
    most = INTRA_REACH * scene.size
    nearest = np.full(len(borders), np.inf)
    for a, b in combinations(range(len(borders)), 2):
        if not borders[a].far_from(borders[b], most):
            nearest[[a, b]] = np.minimum(nearest[[a, b]], borders[a].distance(borders[b]))
    usual = nearest[nearest <= most]
    return min(max(least, GAP_SPREAD * float(np.median(usual))), most) if len(usual) else least


def _relate(
    scene: Scene, a: int, b: int, filled: list[Bool[np.ndarray, "H W"]], borders: list[Border], inter: float
) -> Relation | None:
    same_object = scene.segments[a].object == scene.segments[b].object
    kind, inner, outer = _containment(scene, a, b, filled)
    reach = scene.size * INTRA_REACH if same_object or kind == "inside" else inter
    if kind == "inside":
        contact = find_contact(borders[inner], borders[outer], scene.size, scene.size * SLACK)
        assert contact is not None
        return Relation(inner, outer, "inside", "inter", _centred(scene, inner, contact), embedded=True)
    contact = find_contact(borders[a], borders[b], reach, scene.size * SLACK)
    if contact is None or _blocked(scene, a, b, contact):
        return None
    if _embedded(scene, a, b, contact.share):
        return Relation(a, b, "inside", "inter", contact, embedded=True)
    if _embedded(scene, b, a, contact.share_b):
        return Relation(b, a, "inside", "inter", _swap(contact), embedded=True)
    return Relation(a, b, "overlap", "inter", contact)


def _containment(scene: Scene, a: int, b: int, filled: list[Bool[np.ndarray, "H W"]]) -> tuple[Kind, int, int]:
    for inner, outer in ((a, b), (b, a)):
        mask = scene.segments[inner].mask
        if scene.segments[inner].area < scene.segments[outer].area:
            inside = np.count_nonzero(mask & filled[outer])
            if inside >= INSIDE_SHARE * np.count_nonzero(mask):
                return "inside", inner, outer
    return "overlap", a, b


def _embedded(scene: Scene, inner: int, outer: int, share: float) -> bool:
    small, large = scene.segments[inner], scene.segments[outer]
    if share < EMBEDDED_CONTACT or small.area > 0.6 * large.area:
        return False
    slack = 0.03 * scene.size
    return all(small.box[k] >= large.box[k] - slack for k in (0, 1)) and all(
        small.box[k] <= large.box[k] + slack for k in (2, 3)
    )


def _centred(scene: Scene, inner: int, contact: Contact) -> Contact:
    """A contained segment is joined to its host at its own centre: it has no one place where the two meet."""
    x0, y0, x1, y1 = scene.segments[inner].box
    centre = np.array([(x0 + x1) / 2, (y0 + y1) / 2])
    left, right = np.array([x0, centre[1]]), np.array([x1, centre[1]])
    return Contact(
        contact.gap, x1 - x0, contact.share, contact.share_b,
        np.stack([centre, centre]), np.stack([left, left]), np.stack([right, right]), contact.normal,
    )  # fmt: skip


def _swap(contact: Contact) -> Contact:
    return Contact(
        contact.gap, contact.length, contact.share_b, contact.share,
        contact.middle[::-1], contact.first[::-1], contact.second[::-1], -contact.normal,
    )  # fmt: skip


def _blocked(scene: Scene, a: int, b: int, contact: Contact) -> bool:
    """Whether a third segment lies across the gap."""
    if contact.gap < 2:
        return False
    start, stop = contact.middle
    line = start + (stop - start) * np.linspace(0, 1, 16)[:, None]
    cols = np.clip(line[:, 0].astype(int), 0, scene.width - 1)
    rows = np.clip(line[:, 1].astype(int), 0, scene.height - 1)
    return any(s.mask[rows, cols].sum() >= 4 for k, s in enumerate(scene.segments) if k not in (a, b))
