"""The paper's search as it stands: a pass over relations, then one over motions, by flipping and solving.

How we read its algorithm is written down in `docs/solvers.md`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from iconjax.dsl.registry import Registry
from iconjax.search.config import SearchConfig
from iconjax.search.paper_program import build_program
from iconjax.search.paper_states import (
    MOTIONS,
    PaperState,
    build_choice,
    candidate_edges,
    flip_motion,
    flip_relations,
    initial_state,
    next_edges,
    next_nodes,
    primary_nodes,
    subsets,
)
from iconjax.search.setup import Setup
from iconjax.search.types import TraceEntry
from iconjax.solve.engine import Engine
from iconjax.solve.methods import FOR_MEAN_VIOLATION, method
from iconjax.solve.pose import IDENTITY
from iconjax.solve.violation import Choice

ENOUGH = 0.02
"""A mean violation of this many pixels (at 512 x 512) is low enough: scores below it are equal."""
COMBINATIONS = 24
"""Most subsets of one front that are tried."""
EDGES, NODES = 32, 24
"""Most relations that are constraints, and most segments whose motion is searched: those nearest to the request."""
BATCH = 4


@dataclass(frozen=True)
class Solved:
    """A solved state.

    Attributes:
        score: mean violation of the constraints that were switched on, px.
        matrices: (n, 6) transform of each segment.
        residuals: residuals of all constraints, the primary ones first.
    """

    score: float
    matrices: Float[np.ndarray, "n 6"]
    residuals: Float[np.ndarray, " c"]


class PaperSearch:
    """One search; `run` gives the state it ends in and its solution.

    Raises:
        ConfigError: a solver that cannot minimise the paper's loss.
    """

    def __init__(self, setup: Setup, registry: Registry, config: SearchConfig) -> None:
        solver = config.solver or "adam"
        method(solver, FOR_MEAN_VIOLATION)
        self.setup, self.config = setup, config
        self.relations = setup.setting.relations
        self.notes: list[str] = []
        self.nodes = primary_nodes(setup)
        edges = candidate_edges(self.nodes, self.relations)
        self.edges = self._bounded(edges, EDGES, "relations are constraints")
        ends = [i for e in self.edges for i in (self.relations[e].a, self.relations[e].b)]
        self.movable = sorted({*self.nodes, *ends} - setup.setting.intent.fixed)
        self.program = build_program(setup, registry, self.edges, self.movable)
        self.engine = Engine(self.program.violations, self.program.table, self.program.wide, solver, BATCH)
        self.enough = ENOUGH * setup.setting.size / 512
        self.solved: dict[PaperState, Solved] = {}
        self.entries: list[TraceEntry] = []
        self.round = 0

    def _bounded(self, items: list[int], most: int, what: str) -> list[int]:
        if len(items) > most:
            self.notes.append(f"paper strategy: {most} of {len(items)} {what}, those nearest to the request")
        return items[:most]

    def run(self) -> tuple[PaperState, Solved]:
        """Both passes."""
        self._measure()
        n = len(self.setup.scene.segments)
        state = initial_state(self.setup.setting.intent, self.edges, self.movable, len(self.relations), n)
        self._solve([state])
        self._record("initial state", state, True, "where the search begins")
        if self.config.relation_search:
            state = self._relation_pass(state)
        if self.config.motion_search:
            state = self._motion_pass(state)
        return state, self.solved[state]

    def _measure(self) -> None:
        """Measure the unedited picture: with nothing free, a solve does no more."""
        n = len(self.setup.scene.segments)
        still = PaperState(("N",) * n, ("N",) * len(self.relations))
        off = np.zeros(self.program.violations.allowed.shape)
        nothing = build_choice(still, self.setup, self.movable, off)
        self.program = self.program.allowing(np.asarray(self.engine.solve([nothing]).primary[0]))
        self.engine.problem = self.program.violations

    def _choice(self, state: PaperState) -> Choice:
        return build_choice(state, self.setup, self.movable, self.program.active(state.relations))

    def _score(self, state: PaperState) -> float:
        return max(self.solved[state].score, self.enough)

    def _solve(self, states: Sequence[PaperState]) -> None:
        """Solve what was not solved before, as one batch; every solve starts from the unedited picture."""
        fresh = [s for s in dict.fromkeys(states) if s not in self.solved]
        if not fresh:
            return
        found = self.engine.solve([self._choice(s) for s in fresh])
        residuals, moved = np.asarray(found.primary), len(self.movable)
        for k, state in enumerate(fresh):
            matrices = np.tile(IDENTITY, (len(self.setup.scene.segments), 1))
            matrices[self.movable] = found.matrices[k, :moved]
            self.solved[state] = Solved(float(found.loss[k]), matrices, residuals[k])
        self.round += 1

    def _relation_pass(self, best: PaperState) -> PaperState:
        front = [e for e in self.edges if {self.relations[e].a, self.relations[e].b} & set(self.nodes)]
        seen: set[int] = set()
        while front and self._score(best) > self.enough:
            seen |= set(front)
            best = self._relation_front(best, front)
            front = next_edges(front, seen, self.relations, self.edges)
        return best

    def _relation_front(self, best: PaperState, front: Sequence[int]) -> PaperState:
        chosen, count = subsets(front, COMBINATIONS)
        if count > len(chosen):
            self.notes.append(
                f"relation search: a front of {len(front)} relations has {count} subsets; "
                f"the {len(chosen) - 1} smallest and the whole front were tried"
            )
        k = 0
        while k < len(chosen) and self._score(best) > self.enough:
            # Solved ahead as if none of them were kept; after one that is, the rest is flipped anew.
            ahead = chosen[k : k + self._window(best, chosen[k:])]
            flips = [flip_relations(best, u, self.relations) for u in ahead]
            self._solve([s for four in flips for _, s in four])
            for u, four in zip(ahead, flips, strict=True):
                k += 1
                before = best
                best = self._keep_falling(best, f"{len(u)} of the front", four)
                if best is not before:
                    break
        return best

    def _window(self, state: PaperState, chosen: Sequence[tuple[int, ...]]) -> int:
        """How many subsets fill two batches with states that were not solved before."""
        fresh: set[PaperState] = set()
        for k, u in enumerate(chosen):
            fresh |= {s for _, s in flip_relations(state, u, self.relations) if s not in self.solved}
            if len(fresh) >= 2 * BATCH:
                return k + 1
        return len(chosen)

    def _keep_falling(self, best: PaperState, subject: str, flips: Sequence[tuple[str, PaperState]]) -> PaperState:
        """Keep each flip with which the score falls."""
        for words, state in flips:
            if state.relations == best.relations:
                continue
            falls = self._score(state) < self._score(best)
            reason = "the score falls" if falls else "the score does not fall"
            self._record(f"{subject}: {words}", state, falls, reason)
            best = state if falls else best
        return best

    def _motion_pass(self, best: PaperState) -> PaperState:
        front, order = list(self.nodes), []
        while front:
            order += front
            front = next_nodes(front, set(order), self.relations, self.edges)
        free = [node for node in order if node not in self.setup.setting.intent.fixed]
        for node in self._bounded(free, NODES, "segments had their motion searched"):
            best = self._simplify(best, node)
        return best

    def _simplify(self, best: PaperState, node: int) -> PaperState:
        """Keep a motion state with which the score falls, or a simpler one with which it does not rise."""
        flips = flip_motion(best, node)
        self._solve([s for _, s in flips])
        name = self.setup.scene.names[node]
        for motion, state in flips:
            if state == best:
                continue
            falls = self._score(state) < self._score(best)
            simpler = MOTIONS.index(motion) > MOTIONS.index(best.motion[node])
            kept = falls or (simpler and self._score(state) <= self._score(best))
            reason = "the score falls" if falls else "simpler, and the score does not rise" if kept else "no gain"
            self._record(f"{name}: {motion}", state, kept, reason)
            best = state if kept else best
        return best

    def _record(self, origin: str, state: PaperState, kept: bool, reason: str) -> None:
        names, solved = self.setup.scene.names, self.solved[state]
        loose = tuple(
            (names[self.relations[e].a], names[self.relations[e].b], state.relations[e])
            for e in self.edges
            if state.relations[e] != "ST"
        )
        active = self.program.active(state.relations)
        excess = active * self.program.excess(solved.residuals)
        count = max(float(active.sum()), 1.0)
        first = float(excess[: self.program.primary].sum()) / count
        terms = {"primary": first, "secondary": float(excess.sum()) / count - first}
        motion = dict(zip(names, state.motion, strict=True))
        self.entries.append(TraceEntry(self.round - 1, origin, motion, loose, solved.score, terms, kept, reason))
