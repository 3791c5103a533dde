"""Errors of a constraint program: where, what, and what was probably meant."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from iconjax.errors import ProgramError

_SHOWN = 20


@dataclass(frozen=True, order=True)
class Problem:
    """One error: 1-based line and column, and a message without full stop."""

    line: int
    column: int
    message: str

    def __str__(self) -> str:
        return f"line {self.line}, column {self.column}: {self.message}"


class InvalidProgramError(ProgramError):
    """A program with errors; the message lists them, `problems` holds them one by one."""

    def __init__(self, problems: Iterable[Problem]) -> None:
        self.problems: tuple[Problem, ...] = tuple(sorted(set(problems)))
        super().__init__(_summary(self.problems))


def nearest(word: str, known: Sequence[str]) -> str:
    """The hint `; did you mean "..."?`, or the empty string when nothing comes near."""
    by_lower = {k.lower(): k for k in reversed(known)}
    hits = difflib.get_close_matches(word.lower()[:200], list(by_lower), n=1, cutoff=0.6)
    if not hits:
        # A part named without its object ("Shade" for "Lamp:Shade") is no close match by letters.
        hits = [k for k in by_lower if word and word.lower() in k.split(":")][:1]
    return f'; did you mean "{by_lower[hits[0]]}"?' if hits else ""


def _summary(problems: Sequence[Problem]) -> str:
    if len(problems) == 1:
        return f"the program has an error: {problems[0]}"
    shown = "; ".join(map(str, problems[:_SHOWN]))
    rest = f"; and {len(problems) - _SHOWN} more" if len(problems) > _SHOWN else ""
    return f"the program has {len(problems)} errors: {shown}{rest}"
