"""The kinds of requests that the guide shows are understood by the built-in translator."""

from __future__ import annotations

from pathlib import Path

import pytest

from iconjax.edit.inputs import open_inputs
from iconjax.edit.pipeline import read_request

ROOT = Path(__file__).parents[1]


def shown() -> list[str]:
    section = (ROOT / "docs/guide.md").read_text("utf-8").partition("## Writing requests")[2].partition("\n## ")[0]
    rows = [line.split("|") for line in section.splitlines() if line.startswith("|")][2:]
    requests = [text.strip() for row in rows for text in row[2].split("·")]
    return [text.replace("...", "Move the cup up") for text in requests]


@pytest.fixture(scope="module")
def trophy():
    return open_inputs(ROOT / "eval" / "benchmark" / "trophy-cup-base").scene


def test_the_guide_shows_requests():
    assert len(shown()) > 12


@pytest.mark.parametrize("request_", shown())
def test_a_shown_request_is_understood(trophy, request_):
    assert read_request(request_, trophy, "offline").program
