"""What a result depends on, as one short text: the code, the settings, and the files of the case."""

from __future__ import annotations

import hashlib
import json
import platform
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import iconjax

PACKAGES = ("jax", "jaxlib", "jaxopt", "numpy", "optimistix", "pillow", "scikit-image", "scipy", "shapely")

CASE_FILES = (
    "case.json",
    "checks.json",
    "ground_truth.json",
    "ground_truth.png",
    "image.png",
    "program.txt",
    "segmentation.png",
)


@cache
def code_digest() -> str:
    """Digest of the package's own files: results of other code are never taken for results of this."""
    root = Path(iconjax.__file__).parent
    digest = hashlib.sha256()
    for folder in (root, root.parent / "dsl_specs"):
        for path in sorted(p for p in folder.rglob("*") if p.is_file() and p.suffix not in (".pyc", ".part")):
            digest.update(path.relative_to(folder).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:16]


def fingerprint(case_folder: Path, settings: dict[str, Any]) -> str:
    """Digest of a case's files, the settings of a method, and the code."""
    digest = hashlib.sha256(json.dumps([settings, code_digest()], sort_keys=True, default=str).encode())
    for name in CASE_FILES:
        path = case_folder / name
        digest.update(name.encode() + b"\0" + (path.read_bytes() if path.exists() else b"-") + b"\0")
    return digest.hexdigest()[:16]


def versions() -> dict[str, str]:
    """Versions of everything that takes part."""
    found = {"iconjax": iconjax.__version__, "code": code_digest(), "python": platform.python_version()}
    for name in PACKAGES:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            found[name] = "not installed"
    return found
