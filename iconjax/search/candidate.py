"""From discrete states to the arrays of a solve."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float

from iconjax.relations.detect import INTER_REACH
from iconjax.relations.types import Relation
from iconjax.search.facts import Facts
from iconjax.search.intent import Intent
from iconjax.search.state import State, scale_kind
from iconjax.search.weights import Forces
from iconjax.solve.arrays import Candidate
from iconjax.solve.pose import Bodies

UPRIGHT = 0.7
"""Least share of down in the direction across a contact that bears the weight of what is above it."""


@dataclass(frozen=True)
class Sizes:
    """Static sizes of a solve: everything is padded to these."""

    segments: int
    relations: int
    alignments: int
    bodies: int


@dataclass(frozen=True)
class Setting:
    """What all candidates of an edit are made from.

    Attributes:
        facts, relations, intent: of the scene and the program.
        forces: weights inside a solve.
        size: larger side of the picture, px.
        pieces: for each segment the number of the connected piece of its object that it belongs to.
    """

    facts: Facts
    relations: tuple[Relation, ...]
    intent: Intent
    forces: Forces
    size: float
    pieces: tuple[int, ...]

    def pair(self, r: Relation) -> tuple[int, int] | None:
        """The two things that a relation between objects connects, by number; None within one object."""
        if r.scope != "inter":
            return None
        a, b = sorted((self.pieces[r.a], self.pieces[r.b]))
        return a, b

    def hinged(self, r: Relation) -> bool:
        """Whether the program itself says where the two sides of a relation hold together."""
        for first, second in self.intent.hinged:
            hosts = second | {h for i in second if (h := self.facts.host[i]) is not None}
            if (r.a in first and r.b in hosts) or (r.b in first and r.a in hosts):
                return True
        return False

    @cached_property
    def companions(self) -> tuple[int, ...]:
        """For each relation, how many connect the same two things; 1 within one object."""
        pairs = [self.pair(r) for r in self.relations]
        counts = Counter(pairs)
        return tuple(counts[p] if p else 1 for p in pairs)

    @cached_property
    def bearers(self) -> dict[int, dict[int, set[int]]]:
        """For each piece the pieces that bear it, with the relations that say so: it rests on them from above, and
        they stand on the ground or on something that does. (What hangs below a thing does not bear it.)"""
        below: dict[int, dict[int, set[int]]] = {}
        for e, r in enumerate(self.relations):
            down = float(r.contact.normal[1])
            if r.scope == "inter" and r.kind != "inside" and abs(down) > UPRIGHT:
                upper, lower = (r.a, r.b) if down > 0 else (r.b, r.a)
                below.setdefault(self.pieces[upper], {}).setdefault(self.pieces[lower], set()).add(e)
        firm = {self.pieces[i] for i in np.flatnonzero(self.facts.grounded)}
        while more := {p for p, stands in below.items() if stands.keys() & firm} - firm:
            firm |= more
        return {p: {q: es for q, es in stands.items() if q in firm} for p, stands in below.items()}

    def support(self, e: int) -> str:
        """What relation `e` is to gravity: "sole" where a thing would hang in the air without it, "beside" where both
        things rest on something else or only stand side by side across a gap, else ""."""
        contact, pieces = self.relations[e].contact, self.pair(self.relations[e])
        if pieces is None:
            return ""
        if contact.gap > INTER_REACH * self.size and abs(float(contact.normal[1])) < UPRIGHT:
            return "beside"
        grounded = {self.pieces[i] for i in np.flatnonzero(self.facts.grounded)}
        for piece in pieces:
            stands = self.bearers.get(piece, {})
            if piece not in grounded and len(stands) == 1 and e in next(iter(stands.values())):
                return "sole"
        return "beside" if all(self.bearers.get(p, {}).keys() - set(pieces) for p in pieces) else ""


def body_roots(state: State) -> tuple[int, ...]:
    """The segments whose motion is free, one for each body."""
    return tuple(i for i, m in enumerate(state.modes) if m != "N" and not m.startswith("W:"))


def build_candidate(
    setting: Setting, state: State, sizes: Sizes, start: Float[np.ndarray, "n 5"] | None = None
) -> Candidate:
    """The arrays for `state`; `start` gives parameters to begin with, by root segment."""
    roots = body_roots(state)
    where = {root: k for k, root in enumerate(roots)}
    n = len(state.modes)
    body = np.full(sizes.segments, sizes.bodies)
    for i in range(n):
        body[i] = where.get(state.root(i), sizes.bodies)
    bodies = _bodies(setting, state, roots, sizes.bodies, start)
    return Candidate(
        body=body,
        bodies=bodies,
        **_relation_arrays(setting, state, body, sizes),
        align=_alignment_weights(setting, state, sizes),
        canvas=np.array(setting.forces.canvas),
    )


def members_of(state: State, root: int) -> tuple[int, ...]:
    """All segments that move with `root`."""
    return tuple(i for i in range(len(state.modes)) if state.root(i) == root)


def _bodies(
    setting: Setting, state: State, roots: Sequence[int], count: int, start: Float[np.ndarray, "n 5"] | None
) -> Bodies:
    facts, forces = setting.facts, setting.forces
    centre, axis, radius = np.zeros((count, 2)), np.zeros(count), np.ones(count)
    free, uniform = np.zeros((count, 5)), np.zeros(count)
    inertia, sparsity, first = np.ones((count, 5)), np.zeros((count, 5)), np.zeros((count, 5))
    for k, root in enumerate(roots):
        members = [i for i in members_of(state, root) if facts.host[i] not in members_of(state, root)] or [root]
        box = facts.features[members]
        low, high = box[:, [0, 3]].min(0), box[:, [2, 5]].max(0)
        centre[k] = (low + high) / 2
        radius[k] = max(float(np.linalg.norm(high - low)) / 2, 0.02 * setting.size)
        mode = state.modes[root]
        free[k], uniform[k] = _freedom(mode)
        if scale_kind(mode) in ("Sl", "Ss"):
            axis[k] = np.arctan2(facts.long_dir[root, 1], facts.long_dir[root, 0])
        asked = {kind for t in setting.intent.things_of(root) for kind in t.kinds}
        spins = asked == {"rotate"} and _disc(facts, members)
        inertia[k], sparsity[k] = forces.body(asked, float(facts.area[members].sum()), spins)
        if start is not None:
            first[k] = start[root]
    return Bodies(centre, axis, radius, free, uniform, inertia, sparsity, first)


def _disc(facts: Facts, members: Sequence[int]) -> bool:
    """Whether a body as a whole is a disc: its largest round segment fills its box."""
    box = facts.features[list(members)]
    extent = box[:, [2, 5]].max(0) - box[:, [0, 3]].min(0)
    own = box[:, [2, 5]] - box[:, [0, 3]]
    return bool((facts.round[list(members)] & (own >= 0.9 * extent).all(1)).any())


def _freedom(mode: str) -> tuple[Float[np.ndarray, "5"], float]:
    """Free degrees, and whether scaling is uniform; "Sl" and "Ss" scale in a frame along the long axis."""
    kind = scale_kind(mode)
    along_first, along_second = kind in ("Sx", "Sxy", "Su", "Sl"), kind in ("Sy", "Sxy", "Ss")
    return np.array([1.0, 1.0, "R" in mode, along_first, along_second]), float(kind == "Su")


def _relation_arrays(
    setting: Setting, state: State, body: Float[np.ndarray, " n"], sizes: Sizes
) -> dict[str, Float[np.ndarray, " e"]]:
    hold, ends, slide = np.zeros(sizes.relations), np.zeros(sizes.relations), np.zeros(sizes.relations)
    for e, r in enumerate(setting.relations):
        status = state.relations.get(e, "ST")
        if body[r.a] == body[r.b] or status == "N" or setting.hinged(r):
            continue
        share = 1 / setting.companions[e]
        hold[e] = share * setting.forces.hold(r, setting.size)
        ends[e] = 0.0 if _hinged(setting, body, r, sizes.bodies) else share * setting.forces.ends(r, setting.size)
        slide[e] = status == "WK"
    return {"hold": hold, "ends": ends, "slide": slide}


def _hinged(setting: Setting, body: Float[np.ndarray, " n"], r: Relation, still: int) -> bool:
    """Whether one side was asked to turn while the other stays: then only the middle of their contact is to hold."""
    return any(
        body[other] == still and any("rotate" in t.kinds for t in setting.intent.things_of(one))
        for one, other in ((r.a, r.b), (r.b, r.a))
    )


def _alignment_weights(setting: Setting, state: State, sizes: Sizes) -> Float[np.ndarray, " f"]:
    weights = np.zeros(sizes.alignments)
    loose = {(setting.relations[e].a, setting.relations[e].b) for e in state.relations}
    for f, a in enumerate(setting.facts.alignments[: sizes.alignments]):
        asked = {kind for t in setting.intent.things_of(a.a) for kind in t.kinds}
        other = {kind for t in setting.intent.things_of(a.b) for kind in t.kinds} if a.b is not None else set()
        if "rotate" in asked | other:
            continue
        if a.reason in ("touching", "overhang") and "translate" in asked ^ other:
            continue
        if a.reason in ("touching", "overhang") and ((a.a, a.b) in loose or (a.b, a.a) in loose):
            continue
        weights[f] = setting.forces.align[a.reason]
        if a.reason == "ground" and "translate" in asked:
            weights[f] *= setting.forces.asked_ground
    return weights
