"""Exchanges kept in a folder as readable JSON, and played back without any network."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

from iconjax.errors import ConfigError, InputError
from iconjax.files import describe, write_text
from iconjax.language.base import Usage
from iconjax.language.llm.exchange import Client, Exchange, Reply
from iconjax.language.llm.faults import LlmError, one_line
from iconjax.language.llm.secrets import redact

LARGEST = 1 << 22
"""Bytes; no recording is as long."""


class MissingRecordingError(LlmError):
    """Nothing was recorded for an exchange; `exchange` is the one."""

    def __init__(self, message: str, exchange: Exchange) -> None:
        super().__init__(message)
        self.exchange = exchange


class Recorder:
    """Passes exchanges on to a client and writes down each with its reply."""

    def __init__(self, client: Client, folder: str | Path) -> None:
        self.client, self.folder = client, Path(folder)

    def send(self, exchange: Exchange) -> Reply:
        """As the client, and record it."""
        reply = self.client.send(exchange)
        write_recording(self.folder, exchange, reply)
        return reply

    async def send_async(self, exchange: Exchange) -> Reply:
        """As the client, and record it."""
        reply = await self.client.send_async(exchange)
        write_recording(self.folder, exchange, reply)
        return reply


class Replayer:
    """Answers from a folder of recordings."""

    def __init__(self, folder: str | Path) -> None:
        """Raises ConfigError where there is no such folder."""
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise ConfigError(f"there is no folder {folder} with recorded replies")

    def holds(self, purpose: str) -> bool:
        """Whether anything was recorded for a purpose."""
        return any(self.folder.glob(f"{purpose}-*.json"))

    def send(self, exchange: Exchange) -> Reply:
        """The recorded reply.

        Raises:
            MissingRecordingError: there is none; the message names the request and the key.
        """
        return read_recording(self.folder, exchange)

    async def send_async(self, exchange: Exchange) -> Reply:
        """As `send`."""
        return self.send(exchange)


def recording_name(exchange: Exchange) -> str:
    """File name of the recording of an exchange."""
    return f"{exchange.purpose}-{exchange.key[:20]}.json"


def write_recording(folder: str | Path, exchange: Exchange, reply: Reply) -> Path:
    """Write an exchange into `folder` (made if missing) as one JSON file; gives back its path.

    The constant part of the prompt, the same in many, stands once in a text file beside it.

    Raises:
        InputError: it cannot be written.
    """
    folder = Path(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"cannot write {folder}: {describe(error)}") from error
    digest = hashlib.sha256(exchange.system.encode("utf-8", "surrogatepass")).hexdigest()
    system = folder / f"system-{digest[:12]}.md"
    if not system.exists():
        write_text(system, redact(exchange.system))
    record = {
        "request": exchange.summary,
        "purpose": exchange.purpose,
        "key": exchange.key,
        "model": reply.model,
        "usage": asdict(reply.usage),
        "stop_reason": reply.stop_reason,
        "reply": reply.text,
        "messages": exchange.messages(),
        "system": system.name,
    }
    path = folder / recording_name(exchange)
    write_text(path, redact(json.dumps(record, indent=1, ensure_ascii=False)) + "\n")
    return path


def read_recording(folder: str | Path, exchange: Exchange) -> Reply:
    """The reply recorded for `exchange`.

    Raises:
        MissingRecordingError: there is none.
        LlmError: the file is damaged, or is that of another exchange.
    """
    path = Path(folder) / recording_name(exchange)
    if not path.is_file():
        request = one_line(exchange.summary, 80)
        raise MissingRecordingError(
            f"no reply is recorded in {folder} for {exchange.purpose} {request!r} (key {exchange.key[:20]})", exchange
        )
    try:
        if path.stat().st_size > LARGEST:
            raise ValueError("too large")
        record = json.loads(path.read_text(encoding="utf-8"))
        if record["key"] != exchange.key:
            raise ValueError("it belongs to another prompt")
        return _reply(record)
    except (OSError, ValueError, KeyError, TypeError, RecursionError) as error:
        raise LlmError(f"the recording {path} cannot be used: {one_line(str(error), 120)}") from None


def _reply(record: dict[str, Any]) -> Reply:
    text, usage = record["reply"], record.get("usage") or {}
    numbers = isinstance(usage, dict) and all(isinstance(v, int) for v in usage.values())
    if not isinstance(text, str) or not numbers:
        raise ValueError("its reply is no text, or its usage no numbers")
    return Reply(text, str(record.get("model", "")), Usage(**usage), str(record.get("stop_reason", "end_turn")))
