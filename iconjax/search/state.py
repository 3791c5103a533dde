"""Discrete states of a candidate: what each segment may do, and which relations are given up."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

Mode = str
"""How a segment may move: "N" (not at all), "W:<k>" (carried by segment k, whose whole transform it takes), or freedoms
of its own, "T" then optionally "R" and one of the scale kinds: "Sx", "Sy" (along the picture's axes), "Sl", "Ss" (along
its own long or short axis), "Sxy" (both), "Su" (uniform)."""
SCALES = ("Sxy", "Sx", "Sy", "Sl", "Ss", "Su")


@dataclass(frozen=True)
class State:
    """One setting of all discrete states.

    Attributes:
        modes: mode of every segment.
        relations: relation number -> "WK" or "N"; all others are held ("ST").
        origin: how the state came about, in words (for the trace; does not tell states apart).
    """

    modes: tuple[Mode, ...]
    relations: Mapping[int, str] = field(default_factory=dict)
    origin: str = ""

    @property
    def key(self) -> tuple[object, ...]:
        """What tells states apart."""
        return self.modes, tuple(sorted(self.relations.items()))

    def with_modes(self, changes: Mapping[int, Mode], origin: str) -> State:
        """The state with some modes changed."""
        return State(tuple(changes.get(i, m) for i, m in enumerate(self.modes)), self.relations, origin)

    def with_relations(self, changes: Mapping[int, str], origin: str) -> State:
        """The state with some relations changed."""
        return State(self.modes, {**self.relations, **changes}, origin)

    def root(self, segment: int) -> int:
        """The segment whose motion `segment` takes; itself where it is carried by none."""
        seen = {segment}
        while self.modes[segment].startswith("W:"):
            segment = int(self.modes[segment][2:])
            if segment in seen:
                return min(seen)  # carried in a circle: nobody moves on their own
            seen.add(segment)
        return segment

    def mode(self, segment: int) -> Mode:
        """Mode of the root of `segment`; "N" for a circle."""
        mode = self.modes[self.root(segment)]
        return "N" if mode.startswith("W:") else mode


def scale_kind(mode: Mode) -> str:
    """Which scaling a mode allows, "" for none."""
    return next((s for s in SCALES if mode.endswith(s)), "")
