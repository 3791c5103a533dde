"""What a failed request to the model means, in one line that says what to do."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from iconjax.language.llm.faults import one_line
from iconjax.language.llm.retry import LONGEST_WAIT, may_pass, retry_after
from iconjax.language.llm.secrets import redact
from iconjax.language.llm.settings import LlmSettings

CREDIT = ("credit", "billing", "spend limit", "quota", "insufficient")
"""Words by which a server says that money, not time, is short."""


@dataclass(frozen=True)
class Failure:
    """One failed attempt.

    Attributes:
        message: what to tell the user if it is the last.
        may_pass: whether trying again may help.
        wait: seconds that the server asked us to wait, or None.
    """

    message: str
    may_pass: bool
    wait: float | None = None


def diagnose(error: Exception, settings: LlmSettings) -> Failure:
    """What `error`, raised by the SDK, means."""
    import anthropic

    if isinstance(error, anthropic.APIStatusError):
        return _status(error, settings)
    if isinstance(error, anthropic.APITimeoutError):
        return Failure(f"the model did not answer within {settings.timeout:g} s; raise ICONJAX_TIMEOUT", True)
    if isinstance(error, anthropic.APIConnectionError):
        where = settings.base_url or "Anthropic"
        return Failure(f"no connection to {where}, or it was cut; check the network and the base URL", True)
    if isinstance(error, anthropic.CredentialsError) or "authentication method" in str(error):
        return Failure("no credentials for the language model: set ANTHROPIC_API_KEY or ANTHROPIC_AUTH_TOKEN", False)
    return Failure(f"the server's answer cannot be read ({type(error).__name__}); check the base URL", False)


def not_whole(stop: str, message: Any, settings: LlmSettings) -> str:
    """Why a reply that ended with `stop` cannot be used, or ""."""
    if stop == "refusal":
        details = getattr(message, "stop_details", None)
        category = getattr(details, "category", None)
        return f"the model declined to answer{f' ({category})' if category else ''}; put the request in other words"
    if stop == "max_tokens":
        return f"the model's reply was cut off at {settings.max_tokens} tokens; raise ICONJAX_MAX_TOKENS"
    if stop == "model_context_window_exceeded":
        return "the picture has more segments than the model can read at once; use a model with a larger context"
    return ""


def _status(error: Any, settings: LlmSettings) -> Failure:
    status, said = int(error.status_code), _said(error)
    wait = retry_after(error.response.headers.get("retry-after"))
    if status == 402 or (status in (400, 403, 429) and any(word in said.lower() for word in CREDIT)):
        return Failure(f"the account has no credit or quota left: {said or 'see its billing page'}", False)
    if status == 401:
        return Failure("the server does not accept the credentials: check ANTHROPIC_API_KEY", False)
    if status == 403:
        return Failure(f"the credentials do not allow this request: {said or 'permission denied'}", False)
    if status == 404:
        return Failure(f"the server knows no model {settings.model!r}, or no Messages API; check ICONJAX_MODEL", False)
    if status == 413:
        return Failure("the request is too large for the server; leave out the picture, or use fewer segments", False)
    if status == 429:
        return Failure(f"too many requests{_later(wait)}", True, wait)
    if status == 529:
        return Failure(f"the model's servers are overloaded{_later(wait)}", True, wait)
    told = f": {said}" if said else ""
    return Failure(f"the server answered with status {status}{told}", may_pass(status), wait)


def _later(wait: float | None) -> str:
    if wait is None or wait <= LONGEST_WAIT:
        return "; try again later"
    return f"; the server asks to wait for {wait:.0f} s"


def _said(error: Any) -> str:
    body = error.body.get("error") if isinstance(error.body, dict) else None
    message = body.get("message") if isinstance(body, dict) else None
    return one_line(redact(message), 200) if isinstance(message, str) else ""
