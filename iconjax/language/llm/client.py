"""The edge to the `anthropic` SDK: an exchange becomes a request to the Messages API, and its answer a reply.

Structured output is asked for by `output_config.format` on `messages.create`, which is what `messages.parse` sends too;
`parse` would validate a reply before one can see that it was cut short, and keep no verbatim text to record.
"""

from __future__ import annotations

import asyncio
import base64
import time
from collections.abc import Awaitable, Callable
from typing import Any

from iconjax.errors import ConfigError
from iconjax.language.base import Usage
from iconjax.language.llm.exchange import Exchange, Reply, Turn
from iconjax.language.llm.failures import Failure, diagnose, not_whole
from iconjax.language.llm.faults import LlmError
from iconjax.language.llm.retry import pause
from iconjax.language.llm.secrets import redact
from iconjax.language.llm.settings import LlmSettings

NO_KEY = "no-key"
"""Sent to a server of the user's own when no credentials are configured: many local ones need none."""


class AnthropicClient:
    """Asks a server that speaks the Messages API.

    Credentials come from the environment, as the SDK reads them; they are never kept here.
    """

    def __init__(
        self,
        settings: LlmSettings,
        *,
        wait: Callable[[float], None] = time.sleep,
        wait_async: Callable[[float], Awaitable[None]] = asyncio.sleep,
    ) -> None:
        """`wait` and `wait_async` pass the time between attempts.

        Raises:
            ConfigError: the SDK is not installed.
        """
        self.settings = settings
        self._wait, self._wait_async = wait, wait_async
        self._sdk = _sdk()
        self._client: Any = None

    def send(self, exchange: Exchange) -> Reply:
        """Ask, and ask again where that may help.

        Raises:
            LlmError: no usable answer; the message says why and what to do.
        """
        body, attempt = self._body(exchange), 0
        self._client = self._client or self._open(self._sdk.Anthropic, self._sdk.DefaultHttpxClient)
        while True:
            failure: Failure
            try:
                return _reply(self._client.messages.create(**body), self.settings)
            except LlmError:
                raise
            except Exception as error:  # the SDK raises its own, httpx's, and ValueError or TypeError for odd answers
                failure = diagnose(error, self.settings)
            # Raised out here, and not in the handler: the SDK's exceptions hold the request with its headers.
            seconds = self._pause(failure, attempt)
            self._wait(seconds)
            attempt += 1

    async def send_async(self, exchange: Exchange) -> Reply:
        """As `send`; one connection pool for each call, as event loops do not share them."""
        body, attempt = self._body(exchange), 0
        async with self._open(self._sdk.AsyncAnthropic, self._sdk.DefaultAsyncHttpxClient) as client:
            while True:
                failure: Failure
                try:
                    return _reply(await client.messages.create(**body), self.settings)
                except LlmError:
                    raise
                except Exception as error:
                    failure = diagnose(error, self.settings)
                seconds = self._pause(failure, attempt)
                await self._wait_async(seconds)
                attempt += 1

    def _pause(self, failure: Failure, attempt: int) -> float:
        seconds = pause(attempt, failure.wait) if failure.may_pass and attempt < self.settings.retries else None
        if seconds is None:
            tried = f" ({attempt + 1} attempts)" if attempt else ""
            raise LlmError(failure.message + tried)
        return seconds

    def _open(self, kind: Callable[..., Any], transport: Callable[..., Any]) -> Any:
        from iconjax.language.llm.secrets import configured

        base_url = self.settings.base_url or None
        return kind(
            api_key=NO_KEY if base_url and not configured() else None,
            base_url=base_url,
            timeout=self.settings.timeout,
            max_retries=0,
            # A server that sends us elsewhere would send the credentials along.
            http_client=transport(follow_redirects=False),
        )

    def _body(self, exchange: Exchange) -> dict[str, Any]:
        config: dict[str, Any] = {"format": {"type": "json_schema", "schema": dict(exchange.schema)}}
        if self.settings.effort:
            config["effort"] = self.settings.effort
        return {
            "model": self.settings.model,
            "max_tokens": self.settings.max_tokens,
            "system": [{"type": "text", "text": exchange.system, "cache_control": {"type": "ephemeral"}}],
            "messages": [_message(turn) for turn in exchange.turns],
            "output_config": config,
        }


def _sdk() -> Any:
    try:
        import anthropic
    except ImportError:
        raise ConfigError("the language model needs the anthropic SDK: pip install 'iconjax[llm]'") from None
    return anthropic


def _message(turn: Turn) -> dict[str, Any]:
    content: list[dict[str, Any]] = []
    if turn.picture is not None:
        data = base64.b64encode(turn.picture.png).decode("ascii")
        content.append({"type": "image", "source": {"type": "base64", "media_type": "image/png", "data": data}})
    content.append({"type": "text", "text": turn.text})
    return {"role": turn.role, "content": content}


def _reply(message: Any, settings: LlmSettings) -> Reply:
    """Only what a reply needs, checked: a server may answer with anything."""
    blocks = getattr(message, "content", None)
    if not isinstance(blocks, list):
        raise LlmError("the server's answer is no message of the Messages API; check the base URL")
    stop = str(getattr(message, "stop_reason", None) or "end_turn")
    if problem := not_whole(stop, message, settings):
        raise LlmError(problem)
    texts = [getattr(b, "text", None) for b in blocks if getattr(b, "type", "") == "text"]
    text = redact("".join(t for t in texts if isinstance(t, str)))
    if not text.strip():
        raise LlmError("the model's reply is empty; try again, or another model")
    usage = getattr(message, "usage", None)
    return Reply(text, str(getattr(message, "model", "") or settings.model), _usage(usage), stop)


def _usage(usage: Any) -> Usage:
    def tokens(name: str) -> int:
        value = getattr(usage, name, None)
        return value if isinstance(value, int) and value > 0 else 0

    return Usage(
        tokens("input_tokens"),
        tokens("output_tokens"),
        tokens("cache_read_input_tokens"),
        tokens("cache_creation_input_tokens"),
    )
