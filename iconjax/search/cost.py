"""The coherence cost of a solved candidate (contract, section 6): what following the request did to the picture."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np
from jaxtyping import Float

from iconjax.search.candidate import Setting
from iconjax.search.shapes import Shapes
from iconjax.search.state import State, scale_kind
from iconjax.search.weights import Costs, closeness
from iconjax.relations.types import Relation
from iconjax.search.facts import Mirror

STILL_PX = 0.35
"""Motion of less than this many pixels (at 512 x 512) is none."""
UNMET_PX = 0.4
"""A primary residual above this many pixels is a constraint not met, inside the search."""


@dataclass(frozen=True)
class Motion:
    """What transforms did to each segment.

    Attributes:
        shift: (n,) greatest displacement of a corner of its box, px.
        turn: (n,) rotation, degrees clockwise.
        scales: (n, 2) singular values of the linear part, larger first.
        skew: (n,) greatest displacement that is not the effect of its best rigid motion, px.
    """

    shift: Float[np.ndarray, " n"]
    turn: Float[np.ndarray, " n"]
    scales: Float[np.ndarray, "n 2"]


def measure_motion(matrices: Float[np.ndarray, "n 6"], features: Float[np.ndarray, "n 6"]) -> Motion:
    """Measure the motion of every segment."""
    m = matrices.reshape(-1, 2, 3)
    x0, _, x1, y0, _, y1 = features.T
    corners = np.stack([[x0, y0], [x1, y0], [x1, y1], [x0, y1]]).transpose(2, 0, 1)  # n 4 2
    moved = np.einsum("nij,nkj->nki", m[:, :, :2], corners) + m[:, None, :, 2]
    shift = np.linalg.norm(moved - corners, axis=-1).max(1)
    turn = np.degrees(np.arctan2(m[:, 1, 0] - m[:, 0, 1], m[:, 0, 0] + m[:, 1, 1]))
    scales = np.linalg.svd(m[:, :, :2], compute_uv=False)
    return Motion(shift, turn, scales)


@dataclass(frozen=True)
class Judgement:
    """Cost of a candidate by term, and what became of each relation.

    Attributes:
        terms: cost by term; terms of zero are left out.
        outcomes: for each relation "ST", "WK", "N" or "F" as the result has it.
        strained: relations that cost something.
        unmet: whether a primary constraint fails.
    """

    terms: dict[str, float]
    outcomes: tuple[str, ...]
    strained: tuple[int, ...]
    unmet: bool

    @property
    def total(self) -> float:
        """The cost."""
        return sum(self.terms.values())


class Judge:
    """Judges candidates of one edit."""

    def __init__(self, setting: Setting, shapes: Shapes, costs: Costs) -> None:
        self.setting, self.shapes, self.costs = setting, shapes, costs
        self.unit = setting.size / 512
        self.piece_area: dict[int, float] = {}
        for piece, area in zip(setting.pieces, setting.facts.area, strict=True):
            self.piece_area[piece] = self.piece_area.get(piece, 0.0) + float(area)
        self.asked = {
            i: frozenset(k for t in setting.intent.things_of(i) for k in t.kinds)
            for i in range(len(setting.facts.area))
        }

    def judge(
        self, state: State, matrices: Float[np.ndarray, "n 6"], primary: Float[np.ndarray, " c"]
    ) -> Judgement:
        """Cost of the transforms `matrices` that a solve of `state` led to."""
        terms: dict[str, float] = {}

        def add(name: str, cost: float) -> None:
            if cost > 0:
                terms[name] = terms.get(name, 0.0) + cost

        off = np.abs(primary)
        unmet = bool((off > UNMET_PX * self.unit).any())
        if unmet:
            add("unmet", self.costs.unmet + self.costs.unmet_px * float(off[off > UNMET_PX * self.unit].sum()) / self.unit)
        motion = measure_motion(matrices, self.setting.facts.features)
        outcomes = self._relations(matrices, motion, add)
        self._unasked(matrices, motion, add)
        self._asked_parts(state, matrices, motion, add)
        self._surroundings(matrices, motion, add)
        strained = tuple(e for e, (_, cost) in enumerate(outcomes) if cost > 0.05)
        return Judgement(terms, tuple(o for o, _ in outcomes), strained, unmet)

    def _relations(self, matrices, motion, add) -> list[tuple[str, float]]:  # type: ignore[no-untyped-def]
        """Outcome and cost of every relation. Two things that meet in several places are still connected while one
        of these holds: only the cheapest of their relations counts in full, the others hardly."""
        relations = self.setting.relations
        found = [self._relation(r, matrices, motion) for r in relations]
        best: dict[tuple[int, int], float] = {}
        pairs = [self.setting.pair(r) for r in relations]
        for pair, (_, cost, _) in zip(pairs, found, strict=True):
            if pair:
                best[pair] = min(best.get(pair, np.inf), cost)
        out = []
        for pair, (outcome, cost, term) in zip(pairs, found, strict=True):
            if pair and cost > best[pair]:
                cost = 0.1 * cost
            elif pair:
                best[pair] = -1.0  # the cheapest one counts once
            add(term, cost)
            out.append((outcome, cost))
        return out

    def _relation(self, r: Relation, matrices, motion) -> tuple[str, float, str]:  # type: ignore[no-untyped-def]
        if np.allclose(matrices[r.a], matrices[r.b], atol=1e-6):
            return "F" if motion.shift[r.a] > STILL_PX * self.unit else "ST", 0.0, ""
        if r.kind == "near" and self.asked[r.a] and self.asked[r.b]:
            return "N", 0.0, ""
        ends = self.costs.bearing * 0.5 if r.scope == "inter" and self._bears(r, motion) else 0.5
        along, across = (x / self.unit for x in self.shapes.slip(r, matrices, motion.turn, ends))
        slip = max(along, across)
        kind = "near" if r.kind == "near" else "inside" if r.kind == "inside" else r.scope.replace("intra-crucial", "crucial")
        if slip < 1.0:
            return "ST", 0.0, ""
        loss = self.shapes.loss(r, matrices)
        stretched = np.abs(np.log(motion.scales[r.a] / np.maximum(motion.scales[r.b], 1e-6))).max() > 0.02
        if stretched:  # a part that changes size cannot but slide along one that does not
            along *= self.costs.stretched_slide
        slide = self.costs.slid[kind] * min(1.0, along / self.costs.slide_scale)
        slide += self.costs.pulled[kind] * min(1.0, across / self.costs.pull_scale)
        if r.scope == "inter":
            slide *= 1 + self.costs.carrier * self._carried(r, motion)
        if {"rotate"} in (self.asked[r.a], self.asked[r.b]):
            slide *= self.costs.pivot  # what is to turn and nothing else does not wander off
        if self.setting.hinged(r):
            slide *= self.costs.bearing
        # A broad contact, along much of both outlines, binds the two more than a touch in passing.
        slide *= 1 + self.costs.broad * max(0.0, min(r.contact.share, r.contact.share_b) - 0.2)
        broken = self.costs.broken[kind]
        if kind == "near":
            close = closeness(r, self.setting.size)
            more = self.costs.broken["intra"] / self.costs.broken["near"]
            slide, broken = slide * (1 + (more - 1) * close), broken * (1 + (more - 1) * close)
        slide = min(slide, broken)
        cost = slide + (broken - slide) * loss if loss > 0 else slide
        return ("N" if loss > 0.5 else "WK" if slip > 4.0 else "ST"), cost, "broken" if loss > 0.5 else "slid"

    def _carried(self, r: Relation, motion: Motion) -> float:
        """How much larger the side that moves is than the one that stays behind, 0..1: the larger carries the smaller
        along, while a small thing may well slide along a large one."""
        behind = r.b if motion.shift[r.a] >= motion.shift[r.b] else r.a
        if self.setting.facts.hung[behind]:
            return 1.0
        if self.setting.facts.grounded[behind]:
            return 0.0  # what stands on the ground carries, and is not carried
        areas = [self.piece_area[self.setting.pieces[i]] for i in (r.a, r.b)]
        moving, staying = areas if motion.shift[r.a] >= motion.shift[r.b] else areas[::-1]
        return max(0.0, 2 * moving / (moving + staying) - 1)

    def _bears(self, r: Relation, motion: Motion) -> bool:
        """Whether one side turns and the other, which stands on the ground, stays: a stand bears what spins on it."""
        for turning, standing in ((r.a, r.b), (r.b, r.a)):
            spins = "rotate" in self.asked[turning] and abs(motion.turn[turning]) > 1.0
            pieces = [i for i, p in enumerate(self.setting.pieces) if p == self.setting.pieces[standing]]
            grounded = self.setting.facts.grounded[pieces].any()
            if spins and grounded and motion.shift[standing] < STILL_PX * self.unit:
                return True
        return False

    def _unasked(self, matrices, motion, add) -> None:  # type: ignore[no-untyped-def]
        """Cost of every distinct motion that nobody asked for, once for all segments that share it."""
        facts, costs, features = self.setting.facts, self.costs, self.shapes.features(matrices)
        asked_motions = [matrices[i] for i, kinds in self.asked.items() if kinds]
        groups: list[tuple[Float[np.ndarray, "6"], list[int]]] = []
        for i in np.flatnonzero(motion.shift > STILL_PX * self.unit):
            if self.asked[int(i)]:
                continue
            for matrix, members in groups:
                if np.allclose(matrix, matrices[i], atol=1e-3, rtol=0):
                    members.append(int(i))
                    break
            else:
                groups.append((matrices[i], [int(i)]))
        for matrix, members in groups:
            along = any(np.allclose(matrix, m, atol=1e-3, rtol=0) for m in asked_motions)
            add("along" if along else "moved", costs.along if along else costs.moved)
            for i in members:
                if facts.host[i] in members:
                    self._distorted(i, motion, add)
                    continue
                share = costs.moved_area * float(facts.area[i])
                add("moved", share * (0.5 if along else 1.0) * min(1.0, motion.shift[i] / (20 * self.unit)))
                if abs(motion.turn[i]) > 0.3:
                    weight = costs.turned * (2 * float(facts.area[i]) if along else 1.0)
                    weight += costs.hung if facts.hung[i] else 0.0
                    add("turned", weight * min(1.0, abs(motion.turn[i]) / 10))
                self._distorted(i, motion, add)
                if facts.grounded[i]:
                    weight = costs.uprooted * (0.5 if along else 1.0) * (1 + min(1.0, abs(motion.turn[i]) / 10))
                    lifted = abs(features[i, 5] - facts.features[i, 5]) / self.unit
                    add("uprooted", weight * min(1.0, lifted / 20))

    def _distorted(self, i: int, motion: Motion, add) -> None:  # type: ignore[no-untyped-def]
        stretch = float(np.abs(np.log(np.maximum(motion.scales[i], 1e-3))).max())
        if stretch < 0.005:
            return
        detail = self.setting.facts.host[i] is not None
        weight = self.costs.stretched * (0.15 if detail else 1.0)
        add("stretched", weight * (0.3 + min(1.0, stretch)))
        if self.setting.facts.round[i]:
            ratio = float(motion.scales[i, 0] / max(motion.scales[i, 1], 1e-3))
            add("squashed", self.costs.squashed * min(1.0, 3 * np.log(ratio)))

    def _asked_parts(self, state: State, matrices, motion: Motion, add) -> None:  # type: ignore[no-untyped-def]
        """Unasked kinds of motion of asked parts, and asked kinds that did not happen."""
        facts, features = self.setting.facts, self.shapes.features(matrices)
        for thing in self.setting.intent.things:
            members = list(thing.members)
            turn = np.abs(motion.turn[members])
            stretch = np.abs(np.log(np.maximum(motion.scales[members], 1e-3))).max(1)
            if "rotate" in thing.kinds:
                add("idle", self.costs.idle_specifier * float((turn < 1.0).mean()))
            if "scale" in thing.kinds and stretch.max() < 0.01:
                add("idle", self.costs.idle_specifier)
            if "translate" in thing.kinds:
                idle = float((motion.shift[members] < STILL_PX * self.unit).mean())
                add("idle", self.costs.idle_specifier * (idle if 0 < idle < 1 else idle / 4))
        for first, second in self.setting.intent.hinged:
            if abs(motion.turn[min(first)] - motion.turn[min(second)]) < 0.5:
                add("idle", self.costs.idle_specifier)
        asked = [i for i, kinds in self.asked.items() if kinds]
        if asked:
            add("amount", self.costs.amount * float(motion.shift[asked].mean()) / self.unit)
        turning = [t.members for t in self.setting.intent.things if t.kinds == {"rotate"}]
        for first, second in combinations(turning, 2):
            apart = abs(abs(motion.turn[first[0]]) - abs(motion.turn[second[0]]))
            add("uneven", self.costs.uneven * min(1.0, apart / 10) if apart > 0.5 else 0.0)
        for i, kinds in self.asked.items():
            if not kinds:
                continue
            if facts.grounded[i] and not kinds & {"translate", "rotate"}:
                lifted = abs(features[i, 5] - facts.features[i, 5]) / self.unit
                add("uprooted", self.costs.uprooted * min(1.0, lifted / 20) if lifted > 1.5 else 0.0)
            if "rotate" not in kinds and abs(motion.turn[i]) > 0.3:
                add("extra", self.costs.extra * min(1.0, 0.3 + abs(motion.turn[i]) / 10))
            stretch_i = float(np.abs(np.log(np.maximum(motion.scales[i], 1e-3))).max())
            if "scale" not in kinds and stretch_i > 0.005:
                add("extra", self.costs.extra * min(1.0, 0.3 + stretch_i))
            elif scale_kind(state.mode(i)) and stretch_i > 1.2:
                add("extra", 0.5 * (stretch_i - 1.2))

    def _turned(self, m: Mirror, motion: Motion) -> bool:
        """Whether what a pair mirrors about, or one of the pair, turned or was asked to move by itself."""
        return any(abs(motion.turn[i]) > 0.5 for i in (m.a, m.b, m.about)) or bool(
            self.asked[m.a] ^ self.asked[m.b]
        )

    def _surroundings(self, matrices, motion, add) -> None:  # type: ignore[no-untyped-def]
        """Alignments lost, things pushed off the canvas, new overlaps."""
        facts = self.setting.facts
        features = self.shapes.features(matrices)
        lost = 0.0
        for a in facts.alignments:
            still = a.b is None or np.allclose(matrices[a.a], matrices[a.b])
            if still and (a.b is not None or motion.shift[a.a] < STILL_PX):
                continue
            before = facts.features[a.a, a.feature] - (0 if a.b is None else facts.features[a.b, a.feature])
            after = features[a.a, a.feature] - (0 if a.b is None else features[a.b, a.feature])
            off = a.off(before, after) / self.unit
            if off > 1.5:
                lost += self.costs.misaligned[a.reason] * min(1.0, off / 15)
        add("misaligned", min(lost, self.costs.misaligned_most))
        bent = [m.off(features) - m.off(facts.features) for m in facts.mirrors if not self._turned(m, motion)]
        add("asymmetric", min(self.costs.asymmetric_most, sum(self.costs.asymmetric * min(1.0, d / self.unit / 15) for d in bent if d > 2)))
        add("off canvas", self.costs.off_canvas * self.shapes.off_canvas(features))
        moved = np.flatnonzero(motion.shift > STILL_PX * self.unit)
        add("collision", self.costs.collision * self.shapes.collisions(matrices, features, moved))
