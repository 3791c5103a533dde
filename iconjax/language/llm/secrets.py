"""Keeping credentials out of everything that is written or shown."""

from __future__ import annotations

import os

VARIABLES = ("ANTHROPIC_API_KEY", "ANTHROPIC_AUTH_TOKEN")
"""Environment variables that hold a credential itself."""
PROFILE = "ANTHROPIC_PROFILE"
"""Names a profile of the SDK's own, which leads to a credential."""
HIDDEN = "[credential]"


def configured() -> bool:
    """Whether the environment configures credentials for Anthropic; their values are not looked at."""
    return any(os.environ.get(name, "").strip() for name in (*VARIABLES, PROFILE))


def redact(text: str) -> str:
    """`text` without any configured credential: a server may repeat what it was sent."""
    for name in VARIABLES:
        secret = os.environ.get(name, "").strip()
        if len(secret) >= 4:
            text = text.replace(secret, HIDDEN)
    return text
