"""No test asks a real model: credentials of whoever runs the tests are taken out of their reach."""

from __future__ import annotations

import pytest


@pytest.fixture(autouse=True)
def no_credentials(monkeypatch: pytest.MonkeyPatch) -> None:
    """As on a machine where no model is configured."""
    for name in ("API_KEY", "AUTH_TOKEN", "PROFILE", "BASE_URL"):
        monkeypatch.delenv(f"ANTHROPIC_{name}", raising=False)
    for name in ("REPLAY", "RECORD"):
        monkeypatch.delenv(f"ICONJAX_{name}", raising=False)
