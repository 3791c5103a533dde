"""Choosing the translator: a small registry, and the rule that picks one when the caller does not."""

from __future__ import annotations

import os
from collections.abc import Callable
from difflib import get_close_matches
from importlib import import_module

from iconjax.errors import ConfigError
from iconjax.language.base import Translator

CREDENTIALS = ("ANTHROPIC_API_KEY", "ANTHROPIC_AUTH_TOKEN")
"""Environment variables that configure Anthropic; only whether one is set is looked at here."""

PLANNED = {"anthropic": "this version has no Anthropic translator yet; use 'offline', or an object with .translate"}
"""Names that documentation speaks of and that may not be registered, each with what to do instead."""


def _offline() -> Translator:
    translator: Translator = import_module("iconjax.language.offline").OfflineTranslator()
    return translator


_FACTORIES: dict[str, Callable[[], Translator]] = {"offline": _offline}


def register_translator(name: str, factory: Callable[[], Translator]) -> None:
    """Make a translator selectable by `name` in `edit` and on the command line.

    Args:
        name: what the user writes; once "anthropic" is registered, it is the automatic choice wherever
            credentials are set.
        factory: makes the translator when it is first needed.
    """
    if not name or name == "auto":
        raise ConfigError(f"{name!r} cannot name a translator")
    _FACTORIES[name] = factory


def translator_names() -> tuple[str, ...]:
    """Names of the registered translators, in order of registration."""
    return tuple(_FACTORIES)


def choose_translator(wanted: Translator | str | None = None) -> Translator:
    """The translator to use.

    Args:
        wanted: an object with `.translate`, a registered name, or None or "auto": Anthropic where it is
            registered and credentials are set, else the offline translator.

    Raises:
        ConfigError: no translator of that name, one without credentials, or an object that cannot translate.
    """
    if wanted is None or wanted == "auto":
        return _FACTORIES["anthropic" if "anthropic" in _FACTORIES and has_credentials() else "offline"]()
    if isinstance(wanted, str):
        return _by_name(wanted)
    if not callable(getattr(wanted, "translate", None)):
        raise ConfigError(f"translator is a {type(wanted).__name__}, which has no method translate(request, scene)")
    return wanted


def has_credentials() -> bool:
    """Whether credentials for Anthropic are configured in the environment."""
    return any(os.environ.get(name, "").strip() for name in CREDENTIALS)


def _by_name(name: str) -> Translator:
    if name not in _FACTORIES:
        if name in PLANNED:
            raise ConfigError(f"translator {name!r} is not available: {PLANNED[name]}")
        close = get_close_matches(name, _FACTORIES, 1)
        hint = f"did you mean {close[0]!r}?" if close else f"it can be 'auto' or {', '.join(map(repr, _FACTORIES))}"
        raise ConfigError(f"there is no translator {name!r}; {hint}")
    if name == "anthropic" and not has_credentials():
        raise ConfigError(f"translator 'anthropic' needs credentials: set {' or '.join(CREDENTIALS)}")
    return _FACTORIES[name]()
