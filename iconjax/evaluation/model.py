"""The language model that a method asks, or the recordings that answer in its place, and what it costs."""

from __future__ import annotations

import hashlib
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from iconjax.edit.choose import make_client, make_translator
from iconjax.errors import ConfigError
from iconjax.language.base import SolveReport, Translation, Translator, Usage
from iconjax.language.llm.exchange import Client, Exchange, Reply
from iconjax.language.llm.record import MissingRecordingError
from iconjax.language.llm.settings import LlmSettings
from iconjax.language.llm.translator import AnthropicTranslator


@dataclass
class Meter:
    """Passes exchanges on to a client and counts.

    Attributes:
        client: who answers.
        calls: exchanges so far.
        prompt_characters, reply_characters: text sent (with all that is sent again) and received; pictures not counted.
        usage: tokens, as far as the replies say.
    """

    client: Client
    calls: int = 0
    prompt_characters: int = 0
    reply_characters: int = 0
    usage: Usage = field(default_factory=Usage)

    def send(self, exchange: Exchange) -> Reply:
        """As the client."""
        return self._count(exchange, self.client.send(exchange))

    async def send_async(self, exchange: Exchange) -> Reply:
        """As the client."""
        return self._count(exchange, await self.client.send_async(exchange))

    def counts(self) -> dict[str, int]:
        """Everything counted, as plain numbers."""
        own = {"calls": self.calls, "prompt_characters": self.prompt_characters}
        return {**own, "reply_characters": self.reply_characters, **asdict(self.usage)}

    def _count(self, exchange: Exchange, reply: Reply) -> Reply:
        self.calls += 1
        self.prompt_characters += len(exchange.system) + sum(len(turn.text) for turn in exchange.turns)
        self.reply_characters += len(reply.text)
        self.usage += reply.usage
        return reply


def open_client(translator: str | None, settings: LlmSettings) -> Client:
    """Who answers: the model for "llm", else recordings.

    Raises:
        ConfigError: no folder of recordings is set or there; no credentials.
    """
    if translator != "llm" and not settings.replay:
        raise ConfigError("no recorded replies are given: say --replay FOLDER, or --translator llm to ask a model")
    return make_client(_maker(translator), settings)


def open_translator(name: str, settings: LlmSettings) -> tuple[Translator, Meter]:
    """The translator "llm" or "llm-replay", and the meter that counts what it asks.

    Raises:
        ConfigError: as `open_client`.
    """
    meters: list[Meter] = []

    def count(client: Client) -> Client:
        meters.append(Meter(client))
        return meters[0]

    return _Lenient(make_translator(_maker(name), settings, count)), meters[0]


class _Lenient:
    """A translator that leaves a program as it is where no further round was recorded."""

    def __init__(self, translator: AnthropicTranslator) -> None:
        self.name = translator.name
        self.translate, self.crucial = translator.translate, translator.crucial
        self._repair = translator.repair

    def repair(self, translation: Translation, report: SolveReport) -> Translation:
        """As the translator's own."""
        try:
            return self._repair(translation, report)
        except MissingRecordingError:
            return translation


def _maker(translator: str | None) -> str:
    """What the translator is called where it is made."""
    return "anthropic" if translator == "llm" else "llm-replay"


def describe_model(translator: str | None, settings: LlmSettings) -> dict[str, Any]:
    """What the answers depend on, as plain data: the recordings' digest, or the model's settings."""
    if translator == "llm-replay":
        return {"replies": folder_digest(settings.replay)}
    if translator == "llm":
        return {"llm": {k: v for k, v in asdict(settings).items() if k not in ("record", "replay")}}
    return {}


def folder_digest(folder: str | Path) -> str:
    """Digest of the recordings in a folder; "" where there is none."""
    if not folder or not Path(folder).is_dir():
        return ""
    digest = hashlib.sha256()
    for path in sorted(Path(folder).glob("*.json")):
        digest.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:16]
