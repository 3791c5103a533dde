"""What a translator is: a request and a scene in, primary constraints out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol, runtime_checkable

from iconjax.scene.types import Scene


@dataclass(frozen=True)
class Hint:
    """A guess of how a segment moves; never a constraint, only a place where a search may begin.

    Attributes:
        segment: its unique name.
        translate: displacement of the centre of its box, px, y down.
        rotate: degrees, clockwise on screen positive.
        scale: factors along the picture's x and y; scaled first, then turned, then moved, about the box's centre.
    """

    segment: str
    translate: tuple[float, float] = (0.0, 0.0)
    rotate: float = 0.0
    scale: tuple[float, float] = (1.0, 1.0)


@dataclass(frozen=True)
class Reading:
    """One way to understand a request.

    Attributes:
        gloss: the reading in one line of plain words.
        program: its primary constraints, DSL calls as text.
        hints: guesses of the motions, where the translator was asked for them.
    """

    gloss: str
    program: tuple[str, ...]
    hints: tuple[Hint, ...] = ()


@dataclass(frozen=True)
class Usage:
    """Tokens that a translation cost; input tokens count what was neither read from nor written to the cache."""

    input_tokens: int = 0
    output_tokens: int = 0
    cache_read_tokens: int = 0
    cache_write_tokens: int = 0

    def __add__(self, other: Usage) -> Usage:
        return Usage(
            self.input_tokens + other.input_tokens,
            self.output_tokens + other.output_tokens,
            self.cache_read_tokens + other.cache_read_tokens,
            self.cache_write_tokens + other.cache_write_tokens,
        )


NO_TOKENS = Usage()


@dataclass(frozen=True)
class Translation:
    """The primary constraints read out of a request.

    Attributes:
        program: DSL calls, one per entry, as text; those of the first reading.
        translator: which translator wrote it, e.g. "offline".
        understood: the reading in plain words, one line per clause.
        rounds: how many times it was sent back for repair; 0 when the first answer was valid.
        readings: the different ways to understand the request, best first; empty where the translator knows one.
        hints: guesses of the motions of the first reading.
        usage: tokens spent.
        memory: what the translator needs to go on from here; for nobody else.
    """

    program: tuple[str, ...]
    translator: str
    understood: tuple[str, ...] = ()
    rounds: int = 0
    readings: tuple[Reading, ...] = ()
    hints: tuple[Hint, ...] = ()
    usage: Usage = NO_TOKENS
    memory: Any = field(default=None, repr=False, compare=False)


@dataclass(frozen=True)
class Miss:
    """A primary constraint that could not be met: the call, and by how much it is missed, with its unit."""

    call: str
    amount: str


@dataclass(frozen=True)
class SolveReport:
    """What the search found out about a program whose constraints cannot hold together.

    Attributes:
        missed: the constraints that do not hold in the best result.
        boxes: segment name -> (min x, min y, max x, max y) in that result, px.
    """

    missed: tuple[Miss, ...]
    boxes: Mapping[str, tuple[float, float, float, float]]


class Translator(Protocol):
    """Turns a request into primary constraints (paper, "Large Language Model for Primary Constraints")."""

    name: str

    def translate(self, request: str, scene: Scene) -> Translation:
        """Read `request` against `scene`.

        Raises:
            TranslationError: the request is not understood; the message says what was, and which names exist.
        """
        ...


@runtime_checkable
class ManyReader(Protocol):
    """A translator that can be asked for several readings of a request."""

    def with_readings(self, count: int) -> Translator:
        """A translator like this one that gives up to `count` different readings."""
        ...


@runtime_checkable
class RelationJudge(Protocol):
    """A translator that can say which connections hold an object together (paper, relation types)."""

    def crucial(self, scene: Scene, pairs: Sequence[tuple[str, str]]) -> frozenset[frozenset[str]] | None:
        """The crucial ones of some pairs of segment names; None leaves it to the stated rule."""
        ...


@runtime_checkable
class Repairer(Protocol):
    """A translator that can think again when its constraints turn out not to hold together."""

    def repair(self, translation: Translation, report: SolveReport) -> Translation:
        """Another program for the same request; `translation` itself where it was repaired like this before."""
        ...
