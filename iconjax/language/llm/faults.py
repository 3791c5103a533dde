"""What can go wrong with a language model, each as one line that says what to do."""

from __future__ import annotations

from iconjax.errors import TranslationError

LONGEST = 400


class LlmError(TranslationError):
    """The model could not be asked, or its answer cannot be used."""

    def __init__(self, message: str) -> None:
        super().__init__(one_line(message, LONGEST))


def one_line(text: str, at_most: int) -> str:
    """`text` without line breaks and control characters (escape sequences drive terminals), cut to a length."""
    flat = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return flat if len(flat) <= at_most else flat[: at_most - 3].rstrip() + "..."
