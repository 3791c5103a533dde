"""One exchange with a language model: what is asked, and what came back."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Literal, Protocol

from iconjax.language.base import NO_TOKENS, Usage


@dataclass(frozen=True)
class Picture:
    """A PNG that the model sees.

    Attributes:
        png: the file.
        key: hash of what it shows. The file itself will not do: another version of the drawing library writes other
            bytes, and recordings would be lost.
    """

    png: bytes = field(repr=False)
    key: str


@dataclass(frozen=True)
class Turn:
    """One message of the conversation; the picture comes before the text."""

    role: Literal["user", "assistant"]
    text: str
    picture: Picture | None = None


@dataclass(frozen=True)
class Exchange:
    """A question to the model.

    Attributes:
        purpose: a short word, such as "translate".
        summary: what it is about in one line (the request), for messages and recordings.
        system: the constant part of the prompt.
        turns: the conversation so far, the last turn is the user's.
        schema: JSON schema of the reply.
    """

    purpose: str
    summary: str
    system: str = field(repr=False)
    turns: tuple[Turn, ...] = field(repr=False)
    schema: Mapping[str, Any] = field(repr=False)

    @cached_property
    def key(self) -> str:
        """SHA-256 of everything that the answer depends on but the model and its settings.

        Leaving out the model lets recordings of any model replay everywhere; to compare models, keep a folder for each.
        """
        content = {"system": self.system, "messages": self.messages(), "schema": self.schema}
        text = json.dumps(content, sort_keys=True, ensure_ascii=False, separators=(",", ":"))
        return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()

    def messages(self) -> list[dict[str, Any]]:
        """The conversation as plain data, a picture as its key."""
        return [
            {"role": t.role, "text": t.text} | ({"picture": t.picture.key} if t.picture is not None else {})
            for t in self.turns
        ]


@dataclass(frozen=True)
class Reply:
    """What the model answered.

    Attributes:
        text: the reply, verbatim.
        model: which model says it wrote it.
        usage: tokens spent.
        stop_reason: "end_turn" for a whole reply.
    """

    text: str
    model: str = ""
    usage: Usage = NO_TOKENS
    stop_reason: str = "end_turn"


class Client(Protocol):
    """Something that answers exchanges: a server, or a folder of recordings."""

    def send(self, exchange: Exchange) -> Reply:
        """The reply to `exchange`.

        Raises:
            LlmError: there is none.
        """
        ...

    async def send_async(self, exchange: Exchange) -> Reply:
        """As `send`, for many at a time."""
        ...


def layers(client: Client) -> Iterator[Client]:
    """A client and, from the outside in, those that it passes exchanges on to as its attribute `client`."""
    inner: Client | None = client
    while inner is not None:
        yield inner
        inner = getattr(inner, "client", None)
