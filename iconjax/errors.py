"""Every error that iconjax raises on purpose.

Each message is one line that says what is wrong and what to do about it; the command line prints it as it is.
"""

from __future__ import annotations


class IconjaxError(ValueError):
    """Base class: catch this to catch everything iconjax raises on purpose."""


class InputError(IconjaxError):
    """An image, segmentation, label table or file that cannot be used; always one printable line."""

    def __init__(self, message: str) -> None:
        # File names and labels from outside may hold line breaks or undecodable bytes.
        super().__init__("".join(c if c.isprintable() else ascii(c)[1:-1] for c in message))


class ProgramError(IconjaxError):
    """A constraint program that does not parse or type-check; lists all its errors."""


class TranslationError(IconjaxError):
    """A request that no translator could turn into constraints."""


class ConfigError(IconjaxError):
    """A setting outside its allowed values."""
