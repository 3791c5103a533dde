"""Methods that a benchmark compares, by name."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from iconjax.errors import ConfigError

STRATEGIES = {"ours": "coherent", "paper": "paper"}
"""First word of a method -> strategy of the search."""

DIRECT = {"dm": "a language model gives the transforms", "dc": "it gives all constraints, which are solved once"}
"""The paper's baselines."""

BASELINES = ("unedited", "truth")
"""Rows that every table has: the picture as it was, and the possible solution of the case."""

ABLATIONS = {"-MS": "without motion search", "-RS": "without relation search"}
"""Words that may follow a strategy."""

TRANSLATORS = {
    "program": "the case's reference program is given",
    "offline": "the built-in translator",
    "llm-replay": "a language model's recorded replies",
    "llm": "a language model, recorded",
}
"""Who may read the request; with a plus sign in front, words that may follow a strategy too."""

ASKING = ("llm", "llm-replay")
"""Translators that ask a language model, or its recordings."""

IMAGE = "+image"
"""May follow a baseline of the paper's: the model also sees the coloured segments."""


@dataclass(frozen=True)
class Method:
    """A named way to edit, see `parse_method`.

    Attributes:
        name: the name in tables.
        strategy: strategy of the search; None where there is none.
        motion_search, relation_search: whether the two searches are on (the paper's ablation).
        translator: who reads the request, by name; None means automatic where there is a strategy.
        image: whether the model sees the picture.
    """

    name: str
    strategy: str | None = None
    motion_search: bool = True
    relation_search: bool = True
    translator: str | None = None
    image: bool = False

    @property
    def base(self) -> str:
        """First word of the name."""
        return self.name.split()[0]

    @property
    def folder(self) -> str:
        """Name of the folder that holds its results."""
        return folder_name(self.name)

    def describe(self) -> dict[str, Any]:
        """Its settings as plain data."""
        return asdict(self)


def folder_name(method: str) -> str:
    """Name of the folder for a method's results."""
    return method.replace(" ", "")


def parse_method(name: str, translator: str | None = None) -> Method:
    """Read the name of a method.

    Args:
        name: a baseline ("unedited", "truth"); "dm" or "dc", with "+image" or without; or a strategy followed by
            any of `ABLATIONS` and one translator, e.g. "ours -MS +program".
        translator: who reads requests where the name does not say.

    Raises:
        ConfigError: there is no such method; the message says what there is.
    """
    base, *flags = name.split() or [""]
    if base in BASELINES and not flags:
        return Method(base)
    if base in DIRECT and set(flags) <= {IMAGE}:
        answered = translator if translator == "llm" else "llm-replay"
        return Method(" ".join((base, *flags)), translator=answered, image=bool(flags))
    readers = [flag for flag in flags if flag[:1] == "+" and flag[1:] in TRANSLATORS]
    off = [flag for flag in ABLATIONS if flag in flags]
    if base not in STRATEGIES or len(readers) > 1 or set(flags) - set(readers) - set(off):
        raise ConfigError(f"unknown method {name!r}; there are {_known()}")
    return Method(
        name=" ".join((base, *off, *readers)),
        strategy=STRATEGIES[base],
        motion_search="-MS" not in off,
        relation_search="-RS" not in off,
        translator=readers[0][1:] if readers else translator,
    )


def _known() -> str:
    words = ", ".join(f"{flag} ({meaning})" for flag, meaning in ABLATIONS.items())
    readers = ", ".join(f"+{name} ({meaning})" for name, meaning in TRANSLATORS.items())
    return (
        f"{', '.join(BASELINES)}; {', '.join(DIRECT)}, each also with {IMAGE}; "
        f"{', '.join(STRATEGIES)}, followed by any of {words} and one of {readers}"
    )
