"""Registries of segmenters and label suggesters, and the rule that picks one when the caller does not."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from importlib import import_module
from typing import Any

from iconjax.errors import ConfigError
from iconjax.scene.segment.base import LabelSuggester, Segmenter


def _builtin(kind: str) -> Callable[[], Segmenter]:
    def make() -> Segmenter:
        segmenter: Segmenter = getattr(import_module("iconjax.scene.segment.builtin"), kind)()
        return segmenter

    return make


_SEGMENTERS: dict[str, Callable[[], Segmenter]] = {
    "auto": _builtin("AutoSegmenter"),
    "colour": _builtin("ColourSegmenter"),
    "glyph": _builtin("GlyphSegmenter"),
}


@dataclass(frozen=True)
class _Suggester:
    factory: Callable[[], LabelSuggester]
    available: Callable[[], bool]


_SUGGESTERS: dict[str, _Suggester] = {}


def register_segmenter(name: str, factory: Callable[[], Segmenter]) -> None:
    """Make a segmenter selectable by `name`, also on the command line.

    Args:
        name: what the user writes; "auto" replaces the automatic choice.
        factory: makes the segmenter when it is first needed.
    """
    if not name:
        raise ConfigError("a segmenter needs a name")
    _SEGMENTERS[name] = factory


def segmenter_names() -> tuple[str, ...]:
    """Names of the registered segmenters, in order of registration."""
    return tuple(_SEGMENTERS)


def choose_segmenter(wanted: Segmenter | str | None = None) -> Segmenter:
    """The segmenter to use: an object with `.segment`, a registered name, or None for "auto".

    Raises:
        ConfigError: no segmenter of that name, or an object that cannot segment.
    """
    if wanted is None or isinstance(wanted, str):
        name = wanted or "auto"
        make: Callable[[], Segmenter] = _known(name, _SEGMENTERS, "segmenter")
        return make()
    if not callable(getattr(wanted, "segment", None)):
        raise ConfigError(f"segmenter is a {type(wanted).__name__}, which has no method segment(image)")
    return wanted


def register_suggester(
    name: str, factory: Callable[[], LabelSuggester], available: Callable[[], bool] = lambda: True
) -> None:
    """Make a label suggester selectable by `name`, also on the command line.

    Args:
        name: what the user writes.
        factory: makes the suggester when it is first needed.
        available: whether it may be chosen when nobody asks for it, for example because credentials are set; the
            first registered suggester that may is the automatic choice.
    """
    if not name or name in ("auto", "none"):
        raise ConfigError(f"{name!r} cannot name a label suggester")
    _SUGGESTERS[name] = _Suggester(factory, available)


def suggester_names() -> tuple[str, ...]:
    """Names of the registered label suggesters, in order of registration."""
    return tuple(_SUGGESTERS)


def choose_suggester(wanted: LabelSuggester | str | None = None) -> LabelSuggester | None:
    """The label suggester to use, or None where segments keep their provisional names.

    Args:
        wanted: an object with `.suggest`, a registered name, "none", or None or "auto" for the first registered
            one that is available.

    Raises:
        ConfigError: no suggester of that name, or an object that cannot suggest.
    """
    if wanted is None or wanted == "auto":
        return next((s.factory() for s in _SUGGESTERS.values() if s.available()), None)
    if wanted == "none":
        return None
    if isinstance(wanted, str):
        suggester: _Suggester = _known(wanted, _SUGGESTERS, "label suggester")
        return suggester.factory()
    if not callable(getattr(wanted, "suggest", None)):
        raise ConfigError(f"suggester is a {type(wanted).__name__}, which has no method suggest(image, segmentation)")
    return wanted


def _known(name: str, table: Mapping[str, Any], what: str) -> Any:
    if name in table:
        return table[name]
    close = get_close_matches(name, table, 1)
    hint = f"did you mean {close[0]!r}?" if close else f"it can be {', '.join(map(repr, table))}"
    raise ConfigError(f"there is no {what} {name!r}; {hint if table else 'none is registered'}")
