"""Real icons for the measurements: SVG files of npm packages, and iconify collections as SVG text."""

from __future__ import annotations

import json
import random
from collections.abc import Iterator
from pathlib import Path

FOLDERS = {
    "bootstrap-icons": "bootstrap-icons/icons",
    "devicon": "devicon/icons",
    "flag-icons": "flag-icons/flags/4x3",
    "flat-color-icons": "flat-color-icons/svg",
    "lucide-static": "lucide-static/icons",
    "@mdi/svg": "@mdi/svg/svg",
    "@tabler/icons": "@tabler/icons/icons",
}
COLLECTIONS = ("fluent-emoji-flat", "fxemoji", "noto", "openmoji", "streamline-emojis", "twemoji")


def sample(modules: Path, per_set: int, seed: int) -> Iterator[tuple[str, str, bytes]]:
    """(set, name, bytes) of `per_set` icons of every set that is installed in a node_modules folder."""
    for name, folder in FOLDERS.items():
        files = sorted((modules / folder).rglob("*.svg"))
        for path in _pick(files, per_set, seed):
            yield name, str(path.relative_to(modules / folder)), path.read_bytes()
    for name in COLLECTIONS:
        path = modules / "@iconify-json" / name / "icons.json"
        if not path.is_file():
            continue
        table = json.loads(path.read_text("utf-8"))
        for key in _pick(sorted(table["icons"]), per_set, seed):
            icon = table["icons"][key]
            width = icon.get("width", table.get("width", 16))
            height = icon.get("height", table.get("height", 16))
            head = (
                f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="{width}" '
            )
            head += f'height="{height}" viewBox="0 0 {width} {height}">'
            yield name, key, f"{head}{icon['body']}</svg>\n".encode()


def _pick(items: list, count: int, seed: int) -> list:
    return random.Random(seed).sample(items, min(count, len(items)))
