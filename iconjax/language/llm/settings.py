"""Settings of the language model. Credentials are not among them: the SDK reads those itself."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any

from iconjax.errors import ConfigError

EFFORTS = ("", "low", "medium", "high", "xhigh", "max")
PREFIX = "ICONJAX_"


@dataclass(frozen=True)
class LlmSettings:
    """How the language model is asked.

    Every field but `base_url` can be set as an environment variable: `ICONJAX_MODEL`, `ICONJAX_EFFORT`, and so on; the
    base URL is the SDK's `ANTHROPIC_BASE_URL`.

    Attributes:
        model: name of the model.
        effort: "low" to "max", for models that know it; "" is the model's own default.
        base_url: of a server that speaks the Messages API; "" is Anthropic's.
        max_tokens: most tokens of a reply, thinking included.
        timeout: seconds that an attempt may wait for the server.
        retries: attempts after the first when the server is busy or not reached.
        repairs: how often an invalid reply goes back with its errors.
        image: whether the model also sees the coloured segmentation.
        crucial: whether the model also judges which connections hold an object together (it sees the picture for that).
        hints: whether the model is also asked to guess the motions (it is shown outlines then).
        readings: how many different readings to ask for.
        record: folder into which every exchange is recorded; "" for none.
        replay: folder from which "llm-replay" answers; "" for none.
    """

    model: str = "claude-opus-5-5"
    effort: str = ""
    base_url: str = ""
    max_tokens: int = 16_000
    timeout: float = 120.0
    retries: int = 3
    repairs: int = 2
    image: bool = False
    crucial: bool = True
    hints: bool = False
    readings: int = 1
    record: str = ""
    replay: str = ""

    def __post_init__(self) -> None:
        for name in ("model", "effort", "base_url", "record", "replay"):
            if not isinstance(getattr(self, name), str):
                raise ConfigError(f"{name} is {getattr(self, name)!r}; it has to be text")
        if not self.model.strip():
            raise ConfigError("model is empty; write the name of a model")
        if self.effort not in EFFORTS:
            raise ConfigError(f"effort is {self.effort!r}; it can be {', '.join(EFFORTS[1:])}, or empty")
        for name, least, most in _RANGES:
            value = getattr(self, name)
            if isinstance(value, bool) or not isinstance(value, int | float) or not least <= value <= most:
                raise ConfigError(f"{name} is {value!r}; it has to be a number from {least} to {most}")
        for name in ("image", "crucial", "hints"):
            if not isinstance(getattr(self, name), bool):
                raise ConfigError(f"{name} is {getattr(self, name)!r}; it can be True or False")

    @classmethod
    def from_environment(cls, **given: Any) -> LlmSettings:
        """Settings from the environment; what is `given` and not None wins.

        Raises:
            ConfigError: a value that is not allowed; the message names it.
        """
        values: dict[str, Any] = {}
        for field in fields(cls):
            variable = "ANTHROPIC_BASE_URL" if field.name == "base_url" else PREFIX + field.name.upper()
            text = os.environ.get(variable, "").strip()
            if text:
                values[field.name] = _read(variable, text, type(field.default))
        return cls(**values | {name: value for name, value in given.items() if value is not None})


_RANGES = (
    ("max_tokens", 256, 128_000),
    ("timeout", 0.05, 3600),
    ("retries", 0, 20),
    ("repairs", 0, 10),
    ("readings", 1, 8),
)
_SWITCH = {"1": True, "true": True, "yes": True, "on": True, "0": False, "false": False, "no": False, "off": False}


def _read(variable: str, text: str, kind: type) -> Any:
    if kind is bool:
        if text.lower() not in _SWITCH:
            raise ConfigError(f"{variable} is {text!r}; it can be 1 or 0")
        return _SWITCH[text.lower()]
    convert: Callable[[str], Any] = kind
    try:
        return convert(text)
    except ValueError:
        raise ConfigError(f"{variable} is {text!r}; it has to be a number") from None
