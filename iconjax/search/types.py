"""What a search returns: the edit, the final states, and a record of everything that was tried."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float


@dataclass(frozen=True)
class RelationReport:
    """One secondary constraint with its final state.

    Attributes:
        a, b: names of the two segments.
        kind: "overlap", "inside", "contain" or "near" (parts of one object that only lie close to each other).
        scope: "inter", "intra-crucial" or "intra".
        state: "ST" (held, with its meeting point), "WK" (held, sliding), "N" (given up), "F" (fused).
    """

    a: str
    b: str
    kind: str
    scope: str
    state: str


@dataclass(frozen=True)
class ConstraintReport:
    """One primary constraint with its violation in the result.

    Attributes:
        text: the DSL call.
        role: "primary".
        violation: how far it is from holding, in `unit`.
        unit: "px", "deg" or "" (a bare ratio).
        satisfied: violation within tolerance.
    """

    text: str
    role: str
    violation: float
    unit: str
    satisfied: bool


@dataclass(frozen=True)
class TraceEntry:
    """One candidate that the search solved.

    Attributes:
        round: number of the batch it was solved in.
        origin: how the candidate came about, in words.
        motion: segment name -> motion state ("N", "T", "TR", "TS", "TRS", or "F:<host>").
        relations: (a, b, state) of every relation that is not "ST".
        cost: total cost; infinite where a primary constraint fails.
        terms: cost by term.
        kept: whether it survived its round.
        reason: why it was kept or dropped.
    """

    round: int
    origin: str
    motion: Mapping[str, str]
    relations: tuple[tuple[str, str, str], ...]
    cost: float
    terms: Mapping[str, float]
    kept: bool
    reason: str


@dataclass(frozen=True)
class SearchOutcome:
    """The result of a search.

    Attributes:
        matrices: (n, 2, 3) affine transform of each segment, in scene order; exact identity for what was not touched.
        motion_states: segment id -> final motion state, "N", "T", "TR", "TS" or "TRS".
        relations: every detected relation with its final state.
        constraints: every primary constraint with its violation.
        score: total cost of the chosen candidate.
        trace: every candidate, in the order in which they were solved.
        timings: seconds by stage: "compile", "search".
        notes: what the user should know (a bounded front, an unreachable constraint).
    """

    matrices: Float[np.ndarray, "n 2 3"]
    motion_states: Mapping[int, str]
    relations: tuple[RelationReport, ...]
    constraints: tuple[ConstraintReport, ...]
    score: float
    trace: tuple[TraceEntry, ...]
    timings: Mapping[str, float] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
