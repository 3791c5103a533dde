"""Compiled solvers, kept in memory and in the user's cache folder.

XLA compiles cost seconds; an edit should not. Solvers are compiled ahead of time for a few static sizes and stored as
serialised executables, keyed by everything that could change them. A missing, unreadable or stale file only means
compiling again. Nothing here touches JAX's global configuration: 64-bit and device choices are local contexts.
"""

from __future__ import annotations

import hashlib
import os
import pickle
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

import jax
from jax.experimental import serialize_executable

import iconjax

KEPT = 32
"""Executables that the cache folder holds at most; each takes some megabytes."""
_memory: dict[str, Any] = {}
OPTIONS: dict[str, str | bool] = {"xla_llvm_disable_expensive_passes": True}
"""Halves the compile time and costs no measurable speed on kernels this small (`docs/performance.md`)."""


def cache_folder() -> Path | None:
    """Where compiled solvers are stored; None when `ICONJAX_CACHE` is set to nothing."""
    chosen = os.environ.get("ICONJAX_CACHE")
    if chosen is not None:
        return Path(chosen).expanduser() if chosen else None
    base = os.environ.get("XDG_CACHE_HOME") or Path("~/.cache").expanduser()
    return Path(base) / "iconjax"


@contextmanager
def precise_cpu() -> Iterator[None]:
    """64-bit numbers on the CPU, for this thread and this block only."""
    with jax.enable_x64(True), jax.default_device(jax.devices("cpu")[0]):
        yield


@cache
def _sources() -> str:
    """Digest of the package's own code: an edited checkout must not run yesterday's solver."""
    digest = hashlib.sha256()
    for path in sorted(Path(iconjax.__file__).parent.rglob("*.py")):
        if path.parent.name in {"solve", "operators", "dsl"}:
            digest.update(path.read_bytes())
    return digest.hexdigest()


@cache
def _machine() -> str:
    import platform

    try:
        flags = next(line for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("flags"))
    except (OSError, StopIteration):
        flags = platform.processor()
    return f"{platform.machine()}|{platform.system()}|{flags}"


def compiled(name: str, function: Callable[..., Any], arguments: tuple[Any, ...]) -> tuple[Any, float]:
    """An executable of `function` for the shapes of `arguments`, and the seconds spent to get it.

    Call inside `precise_cpu()`. `name` identifies the function together with everything it closes over.
    """
    leaves, tree = jax.tree.flatten(arguments)
    shapes = [(tuple(x.shape), str(x.dtype)) for x in leaves]
    text = "|".join([name, str(shapes), str(tree), jax.__version__, version("jaxlib"), _sources(), _machine()])
    key = hashlib.sha256(text.encode()).hexdigest()[:32]
    if key in _memory:
        return _memory[key], 0.0
    begin = time.perf_counter()
    executable = _load(key)
    if executable is None:
        specs = jax.eval_shape(lambda *a: a, *arguments)
        executable = jax.jit(function).lower(*specs).compile(compiler_options=OPTIONS)
        _store(key, executable)
    _memory[key] = executable
    return executable, time.perf_counter() - begin


def _load(key: str) -> Any | None:
    folder = cache_folder()
    if folder is None:
        return None
    try:
        payload = (folder / f"{key}.xla").read_bytes()
        return serialize_executable.deserialize_and_load(*pickle.loads(payload))
    except Exception:  # a damaged or foreign file is the same as none
        return None


def _store(key: str, executable: Any) -> None:
    folder = cache_folder()
    if folder is None:
        return
    temporary = ""
    try:
        payload = pickle.dumps(serialize_executable.serialize(executable))
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        handle, temporary = tempfile.mkstemp(dir=folder)
        with os.fdopen(handle, "wb") as file:
            file.write(payload)
        os.replace(temporary, folder / f"{key}.xla")
        _prune(folder)
    except Exception:  # a full or read-only disk must not stop an edit
        if temporary:
            Path(temporary).unlink(missing_ok=True)


def _prune(folder: Path) -> None:
    """Remove the executables that were stored longest ago, beyond the newest `KEPT`."""
    stored = sorted(folder.glob("*.xla"), key=lambda path: path.stat().st_mtime, reverse=True)
    for path in stored[KEPT:]:
        path.unlink(missing_ok=True)
