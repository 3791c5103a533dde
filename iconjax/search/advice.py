"""What somebody who has looked at the picture, such as a vision LLM, tells the search."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float


@dataclass(frozen=True)
class Advice:
    """Advice that the search may use and never has to.

    Attributes:
        guesses: guessed transforms by segment id: a further place for the default strategy to begin, and its choice
            between equally good solutions.
        crucial: pairs of segment names whose relation holds their object together (paper, relation types); None leaves
            it to the stated rule.
    """

    guesses: Mapping[int, Float[np.ndarray, "2 3"]] = field(default_factory=dict)
    crucial: frozenset[frozenset[str]] | None = None
