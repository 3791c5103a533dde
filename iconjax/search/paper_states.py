"""The discrete states of the paper's search, its fronts, and its flips."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, islice
from typing import Any

import numpy as np
from jaxtyping import Float

from iconjax.dsl.nodes import segment_names
from iconjax.relations.types import Relation
from iconjax.search.intent import Intent
from iconjax.search.setup import BODIES, Setup, static_size
from iconjax.solve.pose import Bodies
from iconjax.solve.violation import Choice

MOTIONS = ("TRS", "TR", "TS", "T", "N")
"""Motion states in the paper's order: the later, the simpler."""
FREEDOM = {
    "N": [0, 0, 0, 0, 0],
    "T": [1, 1, 0, 0, 0],
    "TR": [1, 1, 1, 0, 0],
    "TS": [1, 1, 0, 1, 1],
    "TRS": [1] * 5,
}
LEVER = 0.1
"""Least lever of a body's rotation and scaling as a share of the picture: the first step of 10 px turns by a
fifth of a radian at most."""


@dataclass(frozen=True)
class PaperState:
    """One setting of both state matrices.

    Attributes:
        motion: motion state of every segment.
        relations: state of every relation, "ST", "WK" or "N".
    """

    motion: tuple[str, ...]
    relations: tuple[str, ...]

    def with_relations(self, edges: Iterable[int], state: str) -> PaperState:
        """Some relations set to a state."""
        some = set(edges)
        return replace(self, relations=tuple(state if e in some else s for e, s in enumerate(self.relations)))

    def with_motion(self, node: int, state: str) -> PaperState:
        """One segment set to a motion state."""
        return replace(self, motion=(*self.motion[:node], state, *self.motion[node + 1 :]))


def initial_state(
    intent: Intent, edges: Collection[int], movable: Collection[int], relations: int, segments: int
) -> PaperState:
    """Every relation in `edges` strong; named segments free in the ways the program names, those told to stay
    fixed, all others in `movable` free in every way."""
    motion = []
    for i in range(segments):
        kinds = {kind for thing in intent.things_of(i) for kind in thing.kinds}
        asked = "T" + ("R" if "rotate" in kinds else "") + ("S" if "scale" in kinds else "")
        motion.append("N" if i in intent.fixed or i not in movable else asked if kinds else "TRS")
    return PaperState(tuple(motion), tuple("ST" if e in edges else "N" for e in range(relations)))


def primary_nodes(setup: Setup) -> list[int]:
    """Segments that the program mentions, in order."""
    names = [n for call in setup.program.calls for n in segment_names(call)]
    return list(dict.fromkeys(i for n in names for i in setup.scene.members(n)))


def candidate_edges(nodes: Collection[int], relations: Sequence[Relation]) -> list[int]:
    """Relations of the paper's kinds ("near" is beyond it), those nearest to `nodes` first."""
    edges = [e for e, r in enumerate(relations) if r.kind != "near"]
    front = [e for e in edges if {relations[e].a, relations[e].b} & set(nodes)]
    ordered: list[int] = []
    while front:
        ordered += front
        front = next_edges(front, set(ordered), relations, edges)
    return ordered + [e for e in edges if e not in set(ordered)]


def flip_relations(
    state: PaperState, chosen: Sequence[int], relations: Sequence[Relation]
) -> list[tuple[str, PaperState]]:
    """The paper's four steps on the chosen edges, each on top of the one before, with a word for each."""

    def of(scope: str, current: str) -> list[int]:
        return [e for e in chosen if relations[e].scope == scope and state.relations[e] == current]

    out = []
    for scope, start, end, words in (
        ("inter", "ST", "WK", "between objects to weak"),
        ("inter", "WK", "N", "between objects given up"),
        ("intra", "ST", "N", "not crucial given up"),
        ("intra-crucial", "ST", "WK", "crucial to weak"),
    ):
        state = state.with_relations(of(scope, start), end)
        out.append((words, state))
    return out


def flip_motion(state: PaperState, node: int) -> list[tuple[str, PaperState]]:
    """One segment in each motion state, in the paper's order."""
    return [(m, state.with_motion(node, m)) for m in MOTIONS]


def subsets(front: Sequence[int], most: int) -> tuple[list[tuple[int, ...]], int]:
    """Combinations of a front's edges, the smaller first, and how many there are. At most `most` are given,
    the whole front among them."""
    count = 2 ** len(front)
    ordered = (c for size in range(len(front) + 1) for c in combinations(front, size))
    chosen = list(islice(ordered, most))
    if count > most:
        chosen[-1] = tuple(front)
    return chosen, count


def next_edges(front: Iterable[int], seen: set[int], relations: Sequence[Relation], edges: Sequence[int]) -> list[int]:
    """Edges not seen yet that share a segment with the front."""
    nodes = {n for e in front for n in (relations[e].a, relations[e].b)}
    return [e for e in edges if e not in seen and {relations[e].a, relations[e].b} & nodes]


def next_nodes(front: Iterable[int], seen: set[int], relations: Sequence[Relation], edges: Sequence[int]) -> list[int]:
    """Segments not seen yet that are related to one of the front."""
    some = set(front)
    near = [n for e in edges for n in (relations[e].a, relations[e].b) if some & {relations[e].a, relations[e].b}]
    return [n for n in dict.fromkeys(near) if n not in seen]


def build_choice(state: PaperState, setup: Setup, movable: Sequence[int], active: Float[np.ndarray, " g"]) -> Choice:
    """The arrays for a state, segments numbered by their place in `movable`: each is a body of its own, its motion
    state a mask over its freedoms; scaling is along the picture's axes."""
    n, count = len(movable), static_size(len(movable), BODIES, "moving parts")
    centre, radius, free = np.zeros((count, 2)), np.ones(count), np.zeros((count, 5))
    features = setup.setting.facts.features[list(movable)]
    extent = features[:, [2, 5]] - features[:, [0, 3]]
    centre[:n] = features[:, [1, 4]]
    radius[:n] = np.maximum(np.linalg.norm(extent, axis=1) / 2, LEVER * setup.setting.size)
    free[:n] = [FREEDOM[state.motion[i]] for i in movable]
    body = np.where(np.arange(count) < n, np.arange(count), count)
    zero, flat = np.zeros((count, 5)), np.zeros(count)
    bodies: list[Any] = [centre, flat, radius, free, flat, zero, zero, zero]
    arrays: list[Any] = [body, Bodies(*bodies), active]
    return Choice(*arrays)
