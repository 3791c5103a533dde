"""What a translator is: a request and a scene in, primary constraints out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from iconjax.scene.types import Scene


@dataclass(frozen=True)
class Translation:
    """The primary constraints read out of a request.

    Attributes:
        program: DSL calls, one per entry, as text.
        translator: which translator wrote it, e.g. "offline".
        understood: the reading in plain words, one line per clause.
    """

    program: tuple[str, ...]
    translator: str
    understood: tuple[str, ...] = ()


class Translator(Protocol):
    """Turns a request into primary constraints (paper, "Large Language Model for Primary Constraints")."""

    name: str

    def translate(self, request: str, scene: Scene) -> Translation:
        """Read `request` against `scene`.

        Raises:
            TranslationError: the request is not understood; the message says what was, and which names exist.
        """
        ...
