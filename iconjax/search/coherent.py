"""The default strategy: least change first, an explicit coherence cost, freedom that spreads where relations break."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from jaxtyping import Float

from iconjax.dsl.nodes import Call, segment_names, walk
from iconjax.search.candidate import body_roots, build_candidate, members_of
from iconjax.search.config import SearchConfig
from iconjax.search.cost import Judge, Judgement
from iconjax.search.flips import flips
from iconjax.search.hints import BEGUN, TIE, TIE_SHARE, distance, hinted_start, hinted_state
from iconjax.search.motion import STILL_PX, measure_motion
from iconjax.search.setup import BODIES, Setup, static_size
from iconjax.search.starts import initial_states
from iconjax.search.state import Mode, State
from iconjax.search.types import TraceEntry
from iconjax.solve.engine import Engine

KICK_DEG = 15.0
"""Where a rotation is asked but not said which way, candidates also begin turned by this much, either way."""
GAIN = 0.02
"""Least fall of the cost that counts as progress."""


@dataclass(frozen=True)
class Trial:
    """A solved and judged candidate.

    Attributes:
        state: its discrete states.
        z: (n, 5) parameters by root segment (zero where there is none).
        matrices: (n, 6) transform of each segment.
        primary: (c,) residuals of the primary constraints, px.
        judgement: its cost.
    """

    state: State
    z: Float[np.ndarray, "n 5"]
    matrices: Float[np.ndarray, "n 6"]
    primary: Float[np.ndarray, " c"]
    judgement: Judgement

    @property
    def cost(self) -> float:
        """Total cost."""
        return self.judgement.total


class CoherentSearch:
    """One search; `run` gives the best trial and the record of all."""

    def __init__(self, setup: Setup, config: SearchConfig, guess: Float[np.ndarray, "n 6"] | None = None) -> None:
        self.setup, self.config, self.guess = setup, config, guess
        self.engine: Engine = setup.engine(config.solver or "irls")
        self.judge = Judge(setup.setting, setup.shapes, config.costs)
        self.seen: set[object] = set()
        self.entries: list[TraceEntry] = []
        self.round = 0

    def run(self) -> Trial:
        """Search until no flip lowers the cost."""
        states = initial_states(self.setup.setting)
        if not self.config.motion_search:
            states = states[:2]
        best = self._solve([*((s, z) for s in states for z in self._starts(s)), *self._guessed(states)])
        if not best:
            raise AssertionError("no candidate")
        for _ in range(self.config.rounds):
            parents = best[: self.config.beam]
            children = self._solve(self._children(parents))
            ranked = sorted([*parents, *children], key=lambda t: t.cost)
            progress = parents[0].cost - ranked[0].cost
            best = ranked
            if progress < GAIN:
                break
        return self._settle(self._preferred(best))

    def _guessed(self, states: Sequence[State]) -> Iterable[tuple[State, Float[np.ndarray, "n 5"]]]:
        """Likely states, and the one that the guess amounts to, each begun at the guess."""
        if self.guess is None:
            return
        setting, sizes = self.setup.setting, self.setup.sizes
        for state in (*states[:BEGUN], hinted_state(setting, states[0], self.guess)):
            roomy = replace(sizes, bodies=static_size(len(body_roots(state)), BODIES, "moving parts"))
            yield state, hinted_start(state, build_candidate(setting, state, roomy).bodies, self.guess)

    def _preferred(self, ranked: Sequence[Trial]) -> Trial:
        """The cheapest trial; among equals the one nearest to the guess where there is one."""
        guess = self.guess
        if guess is None:
            return ranked[0]
        equal = [t for t in ranked if t.cost <= (1 + TIE_SHARE) * ranked[0].cost + TIE]
        features = self.setup.setting.facts.features
        return min(equal, key=lambda t: distance(t.matrices, guess, features))

    def _starts(self, state: State) -> Iterable[Float[np.ndarray, "n 5"]]:
        """Parameters to begin a fresh state with: identity, and turned either way where a direction is open."""
        n = len(state.modes)
        yield np.zeros((n, 5))
        roots = {
            state.root(i)
            for t in self.setup.setting.intent.things
            if "rotate" in t.kinds and not self._signed(t.members)
            for i in t.members
        }
        turning = [r for r in roots if "R" in state.modes[r]]
        if turning:
            features = self.setup.setting.facts.features
            for signs in product((1.0, -1.0), repeat=min(len(turning), 3)):
                z = np.zeros((n, 5))
                for k, r in enumerate(turning):
                    sign = signs[k % len(signs)]
                    members = list(members_of(state, r))
                    low, high = features[members][:, [0, 3]].min(0), features[members][:, [2, 5]].max(0)
                    z[r, 2] = sign * np.radians(KICK_DEG) * np.linalg.norm(high - low) / 2
                yield z

    def _signed(self, members: Sequence[int]) -> bool:
        """Whether the program says by how much these segments turn, and which way."""
        names = {self.setup.scene.segments[i].name for i in members} | {
            self.setup.scene.segments[i].object for i in members
        }
        return any(
            isinstance(node, Call) and node.name == "rotation" and set(segment_names(node)) & names
            for call in self.setup.program.calls
            for node in walk(call)
        )

    def _children(self, parents: Sequence[Trial]) -> list[tuple[State, Float[np.ndarray, "n 5"]]]:
        jobs: list[tuple[State, Float[np.ndarray, "n 5"]]] = []
        room = self.config.batch
        for rank, parent in enumerate(parents):
            # A child begins turned as its parent is, but otherwise afresh: freed of a relation, a solve that begins
            # where the relation held it tends to stay there.
            start = parent.z * np.array([0.0, 0.0, 1.0, 0.0, 0.0])
            share = room if rank == len(parents) - 1 else max(room // 2, 1)
            found = [s for s in flips(self.setup.setting, parent.state, parent.judgement) if s.key not in self.seen]
            if not self.config.relation_search:
                found = [s for s in found if s.relations == parent.state.relations]
            if not self.config.motion_search:
                found = [s for s in found if s.modes == parent.state.modes]
            for s in found[:share]:
                self.seen.add(s.key)
                jobs.append((s, start))
            room -= min(share, len(found))
            if room <= 0:
                break
        return jobs

    def _solve(self, jobs: Sequence[tuple[State, Float[np.ndarray, "n 5"]]]) -> list[Trial]:
        """Solve and judge, cheapest first."""
        if not jobs:
            return []
        count = max(len(body_roots(s)) for s, _ in jobs)
        sizes = replace(self.setup.sizes, bodies=static_size(count, BODIES, "moving parts"))
        setting = self.setup.setting
        solution = self.engine.solve([build_candidate(setting, s, sizes, z) for s, z in jobs])
        n, used = len(setting.facts.area), len(self.setup.compiled.owner)
        trials = []
        for k, (state, _) in enumerate(jobs):
            self.seen.add(state.key)
            z = np.zeros((n, 5))
            for slot, root in enumerate(body_roots(state)):
                z[root] = solution.z[k, slot]
            matrices = solution.matrices[k, :n]
            primary = solution.primary[k, :used]
            trials.append(Trial(state, z, matrices, primary, self.judge.judge(state, matrices, primary)))
        trials.sort(key=lambda t: t.cost)
        self._record(trials)
        return trials

    def _record(self, trials: Sequence[Trial]) -> None:
        names = self.setup.scene.names
        relations = self.setup.setting.relations
        for rank, t in enumerate(trials):
            kept = rank < self.config.beam
            motion = {names[i]: _shown(names, m) for i, m in enumerate(t.state.modes)}
            loose = tuple((names[relations[e].a], names[relations[e].b], s) for e, s in t.state.relations.items())
            reason = "among the cheapest of its round" if kept else "dearer than what was kept"
            self.entries.append(
                TraceEntry(self.round, t.state.origin, motion, loose, t.cost, t.judgement.terms, kept, reason)
            )
        self.round += 1

    def _settle(self, trial: Trial) -> Trial:
        """Give exact identity to what hardly moved, where the cost allows."""
        motion = measure_motion(trial.matrices, self.setup.setting.facts.features)
        idle = {
            r: "N"
            for r in body_roots(trial.state)
            if motion.shift[list(members_of(trial.state, r))].max() < 2 * STILL_PX * self.setup.setting.size / 512
        }
        if not idle:
            return trial
        state = trial.state.with_modes(idle, "what hardly moved stays")
        again = self._solve([(state, trial.z)])
        return again[0] if again and again[0].cost <= trial.cost + 0.3 else trial


def _shown(names: Sequence[str], mode: Mode) -> str:
    return f"F:{names[int(mode[2:])]}" if mode.startswith("W:") else mode
