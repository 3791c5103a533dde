"""Choosing the translator: a small registry, and the rule that picks one when the caller does not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from difflib import get_close_matches
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from iconjax.errors import ConfigError
from iconjax.language.base import Translator
from iconjax.language.llm.secrets import VARIABLES, configured
from iconjax.language.llm.settings import LlmSettings
from iconjax.scene.types import Scene

if TYPE_CHECKING:
    from iconjax.language.llm.exchange import Client
    from iconjax.language.llm.translator import AnthropicTranslator

CREDENTIALS = VARIABLES
"""Environment variables that configure Anthropic; only whether one is set is looked at here."""
LLM = ("anthropic", "llm-replay")
"""Translators that are a language model, or its recorded replies."""


def _offline() -> Translator:
    translator: Translator = import_module("iconjax.language.offline").OfflineTranslator()
    return translator


_FACTORIES: dict[str, Callable[[], Translator]] = {
    "offline": _offline,
    "anthropic": lambda: make_translator("anthropic", LlmSettings.from_environment()),
    "llm-replay": lambda: make_translator("llm-replay", LlmSettings.from_environment()),
}


def register_translator(name: str, factory: Callable[[], Translator]) -> None:
    """Make a translator selectable by `name` in `edit` and on the command line.

    Args:
        name: what the user writes; a name that is taken is replaced.
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
        wanted: an object with `.translate`, a registered name, or None or "auto": Anthropic where its SDK is
            installed and credentials are set, else the offline translator.

    Raises:
        ConfigError: no translator of that name, one without credentials, or an object that cannot translate.
    """
    if wanted is None or wanted == "auto":
        return _FACTORIES["anthropic" if has_credentials() and find_spec("anthropic") else "offline"]()
    if isinstance(wanted, str):
        return _by_name(wanted)
    if not callable(getattr(wanted, "translate", None)):
        raise ConfigError(f"translator is a {type(wanted).__name__}, which has no method translate(request, scene)")
    return wanted


def llm_options(
    wanted: str | None, *, model: str | None = None, record: str | None = None, replay: str | None = None, **more: Any
) -> Translator | str | None:
    """The translator for options that only a language model has; `wanted` itself where none is given.

    Args:
        wanted: name of the translator, or None to let the options decide: "llm-replay" for `replay`, else "anthropic".
        model: name of the model.
        record: folder to record exchanges in.
        replay: folder of recordings to answer from.
        more: further fields of `LlmSettings`.

    Raises:
        ConfigError: they do not fit each other or the translator.
    """
    options = {"model": model, "record": record, "replay": replay, **more}
    given = [name for name, value in options.items() if value is not None]
    if not given:
        return wanted
    name = wanted if wanted not in (None, "auto") else "llm-replay" if replay is not None else "anthropic"
    if name not in LLM:
        raise ConfigError(f"{', '.join(given)}: only for a language model, not for translator {name!r}")
    if name == "anthropic" and replay is not None:
        raise ConfigError("replay: answers come from recordings, so the translator is 'llm-replay', not 'anthropic'")
    return make_translator(str(name), LlmSettings.from_environment(**options))


def make_translator(
    name: str, settings: LlmSettings, wrap: Callable[[Client], Client] | None = None
) -> AnthropicTranslator:
    """The LLM translator "anthropic", or "llm-replay", which answers from recordings.

    Args:
        name: which.
        settings: of the model, or of the recordings.
        wrap: puts something between the translator and who answers, for example to count tokens.

    Raises:
        ConfigError: no credentials, no SDK, or no folder of recordings.
    """
    from iconjax.language.llm.record import Replayer
    from iconjax.language.llm.translator import AnthropicTranslator

    client = make_client(name, settings)
    if name == "llm-replay":  # advice that nobody recorded is not asked for
        settings = replace(settings, crucial=settings.crucial and Replayer(settings.replay).holds("crucial"))
    return AnthropicTranslator(wrap(client) if wrap else client, settings, scene_connections, name)


def make_client(name: str, settings: LlmSettings) -> Client:
    """Who answers the translator `name`: the model, or recordings; recorded where the settings say so.

    Raises:
        ConfigError: as `make_translator`.
    """
    from iconjax.language.llm.record import Recorder, Replayer

    client: Client
    if name == "llm-replay":
        if not settings.replay:
            raise ConfigError("'llm-replay' needs a folder of recordings: give --replay or ICONJAX_REPLAY")
        client = Replayer(settings.replay)
    else:
        if not has_credentials() and not settings.base_url:
            raise ConfigError(f"'anthropic' needs credentials: set {' or '.join(CREDENTIALS)}")
        from iconjax.language.llm.client import AnthropicClient

        client = AnthropicClient(settings)
    return Recorder(client, settings.record) if settings.record else client


def scene_connections(scene: Scene) -> list[tuple[str, str, str]]:
    """Which segments of a scene are connected, in words for a prompt."""
    from iconjax.relations.detect import detect_relations

    words = {"overlap": "touches", "inside": "lies in", "contain": "contains"}
    names = scene.names
    return [(names[r.a], words[r.kind], names[r.b]) for r in detect_relations(scene) if r.kind in words]


def has_credentials() -> bool:
    """Whether credentials for Anthropic are configured in the environment."""
    return configured()


def _by_name(name: str) -> Translator:
    if name not in _FACTORIES:
        close = get_close_matches(name, _FACTORIES, 1)
        hint = f"did you mean {close[0]!r}?" if close else f"it can be 'auto' or {', '.join(map(repr, _FACTORIES))}"
        raise ConfigError(f"there is no translator {name!r}; {hint}")
    return _FACTORIES[name]()
