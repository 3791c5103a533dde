"""The registered methods that minimise a candidate's loss. Adding one is a function and a line in `METHODS`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from iconjax.errors import ConfigError
from iconjax.solve import irls

METHODS: Mapping[str, Callable[..., Any]] = {
    "irls": irls.solve,
}


def method(name: str) -> Callable[..., Any]:
    """The method called `name`: `(problem, candidate, *, table, wide) -> Solution`, pure.

    Raises:
        ConfigError: no such method; names those that exist.
    """
    if name not in METHODS:
        raise ConfigError(f"unknown solver {name!r}: choose one of {', '.join(METHODS)}")
    return METHODS[name]
