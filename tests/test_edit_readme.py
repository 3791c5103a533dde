"""The README and the guide show commands that exist, on files that exist."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import click
import pytest

from iconjax.cli import main

ROOT = Path(__file__).parents[1]
OWN = {"image.png", "picture.png", "parts", "labels.json"}
"""What the reader brings, or has made by a command before."""
COMMAND = re.compile(r"(?:^|`|&& )(?:\.venv/bin/)?iconjax ([^`\n]+)", re.MULTILINE)


def shown_commands() -> list[str]:
    texts = [(ROOT / name).read_text("utf-8") for name in ("README.md", "docs/guide.md")]
    return sorted({re.split(r" [|>] ", c)[0].strip() for text in texts for c in COMMAND.findall(text)})


@pytest.mark.parametrize("line", [c for c in shown_commands() if "NAME" not in c])
def test_command_is_understood(line):
    name, *args = shlex.split(line)
    command = main.get_command(click.Context(main), name)
    assert command is not None
    params = command.make_context(name, args).params
    places = [params.get("picture") or params.get("folder"), params.get("labels")]
    for place in places:
        if place and place not in OWN:
            assert (ROOT / place).exists()


def test_enough_commands_were_found():
    assert {c.split()[0] for c in shown_commands()} == {
        "edit",
        "translate",
        "relations",
        "dsl",
        "eval",
        "label",
        "segment",
    }


def test_test_command_is_what_ci_runs():
    ci = (ROOT / ".ci" / "run").read_text("utf-8")
    readme = (ROOT / "README.md").read_text("utf-8")
    assert "pip install -q -e '.[test]'" in ci
    assert "pip install -q -e '.[test]' && .venv/bin/pytest" in readme
    assert re.search(r"^pytest\b", ci, re.MULTILINE)


def test_local_links_lead_somewhere():
    for name in ("README.md", "docs/guide.md"):
        page = ROOT / name
        for link in re.findall(r"\]\((?!https?:|#)([^)#]+)\)", page.read_text("utf-8")):
            assert (page.parent / link).exists(), (name, link)
