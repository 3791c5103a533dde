"""One reading of a request, solved: parse, search, and one more round where its constraints cannot hold together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from iconjax.dsl.nodes import Program
from iconjax.dsl.parse import parse
from iconjax.edit.explain import amount
from iconjax.errors import ProgramError, TranslationError
from iconjax.language.base import Hint, Miss, Reading, Repairer, SolveReport, Translation
from iconjax.language.llm.record import MissingRecordingError
from iconjax.scene.types import Scene
from iconjax.search.advice import Advice
from iconjax.search.api import search_edit
from iconjax.search.config import SearchConfig
from iconjax.search.types import SearchOutcome

SAME_PX = 1.0
"""Readings whose results differ by less than this at every corner of every segment are one reading."""


@dataclass(frozen=True)
class Attempt:
    """A reading and what the search made of it."""

    reading: Reading
    program: Program
    outcome: SearchOutcome

    @property
    def missed(self) -> int:
        """How many constraints are missed."""
        return sum(not c.satisfied for c in self.outcome.constraints)


def attempt(
    scene: Scene, reading: Reading, author: str | None, settings: SearchConfig, advice: Advice | None = None
) -> Attempt:
    """Parse a reading and search for its edit.

    Args:
        author: the translator that wrote it, None where the caller did.

    Raises:
        ProgramError: the caller's own program is not valid.
        TranslationError: the translator's is not.
    """
    program = parse_calls(reading.program, scene, author)
    advice = replace(advice or Advice(), guesses=guesses(scene, reading.hints))
    return Attempt(reading, program, search_edit(scene, program, settings, advice=advice))


def parse_calls(calls: str | Sequence[str], scene: Scene, author: str | None) -> Program:
    """`calls` as a program; an error names the translator that wrote them where one did."""
    try:
        return parse(calls, scene.names, scene.objects)
    except ProgramError as error:
        if author is None:  # the caller's own program
            raise
        raise TranslationError(f"translator {author!r} wrote constraints that are not valid: {error}") from error


def guesses(scene: Scene, hints: Sequence[Hint]) -> dict[int, np.ndarray]:
    """Hints as transforms by segment id; hints about names that the scene has not are left out."""
    from iconjax.language.llm.hints import hint_matrix  # only with an LLM

    boxes = {s.name: (s.id, s.box) for s in scene.segments}
    return {boxes[h.segment][0]: hint_matrix(h, boxes[h.segment][1]) for h in hints if h.segment in boxes}


def reconsider(
    scene: Scene, first: Attempt, translation: Translation, translator: object, settings: SearchConfig, advice: Advice
) -> tuple[Attempt, Translation]:
    """Where constraints cannot hold together, ask the translator once more; the better of both attempts counts."""
    if not first.missed or not isinstance(translator, Repairer):
        return first, translation
    try:
        again = translator.repair(translation, solve_report(scene, first.outcome))
    except MissingRecordingError:
        raise
    except TranslationError:  # what was found so far stands
        return first, translation
    if again.program == translation.program:
        return first, replace(translation, rounds=again.rounds, usage=again.usage)
    second = attempt(scene, main_reading(again), again.translator, settings, advice)
    if second.missed < first.missed:
        return second, again
    return first, replace(translation, rounds=again.rounds, usage=again.usage)


def solve_report(scene: Scene, outcome: SearchOutcome) -> SolveReport:
    """What a translator has to know to do better: what is missed by how much, and where everything ended up."""
    boxes = {}
    for segment, matrix in zip(scene.segments, outcome.matrices, strict=True):
        points = np.concatenate(segment.loops) @ matrix[:, :2].T + matrix[:, 2]
        low, high = points.min(0), points.max(0)
        boxes[segment.name] = (float(low[0]), float(low[1]), float(high[0]), float(high[1]))
    missed = tuple(Miss(c.text, amount(c)) for c in outcome.constraints if not c.satisfied)
    return SolveReport(missed, boxes)


def main_reading(translation: Translation) -> Reading:
    """The reading that a translation puts first."""
    gloss = translation.readings[0].gloss if translation.readings else "; ".join(translation.understood)
    return Reading(gloss, translation.program, translation.hints)


def distinct(scene: Scene, attempts: Sequence[Attempt]) -> list[Attempt]:
    """The attempts without those whose result is that of an earlier one, within a pixel."""
    kept: list[Attempt] = []
    for one in attempts:
        if all(displacement(scene, one.outcome, other.outcome) > SAME_PX for other in kept):
            kept.append(one)
    return kept


def displacement(scene: Scene, one: SearchOutcome, other: SearchOutcome) -> float:
    """The greatest distance between where two results put a corner of a segment's box, px."""
    worst = 0.0
    for segment, a, b in zip(scene.segments, one.matrices, other.matrices, strict=True):
        x0, y0, x1, y1 = segment.box
        corners = np.array([[x0, y0, 1], [x1, y0, 1], [x1, y1, 1], [x0, y1, 1]])
        worst = max(worst, float(np.linalg.norm(corners @ (a - b).T, axis=1).max()))
    return worst
