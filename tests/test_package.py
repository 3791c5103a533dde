"""What importing iconjax does, and does not do."""

from __future__ import annotations

import subprocess
import sys
import time

import pytest

import iconjax


def run(code: str) -> str:
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def test_import_is_light():
    heavy = ["jax", "jaxlib", "anthropic", "skimage", "scipy", "shapely", "networkx"]
    found = f"print([m for m in {heavy} if m in sys.modules])"
    assert run(f"import iconjax, sys; {found}") == "[]"
    assert run(f"import iconjax, sys; iconjax.EditConfig(); iconjax.Segmentation; iconjax.InputError; {found}") == "[]"


def test_import_touches_no_network():
    code = "import socket\ndef no(*a, **k): raise AssertionError('network')\nsocket.socket.connect = no\n"
    code += "socket.getaddrinfo = no\nimport iconjax\niconjax.EditConfig\niconjax.EditResult\nprint('quiet')"
    assert run(code) == "quiet"


def test_an_edit_leaves_jax_configuration_alone():
    code = """
import sys; sys.path.insert(0, {tests!r})
import jax, iconjax
from edit_support import LABELS, PROGRAM, small_picture
before = dict(jax.config.values)
image, mask = small_picture()
iconjax.edit(image, mask, labels=LABELS, program=PROGRAM)
changed = {{k: (v, jax.config.values[k]) for k, v in before.items() if jax.config.values[k] != v}}
print(changed, jax.numpy.ones(1).dtype)
"""
    assert run(code.format(tests=__file__.rpartition("/")[0])) == "{} float32"


def test_edit_is_the_function_whatever_is_imported_first():
    for first in (
        "import iconjax.edit.config",
        "import iconjax.edit.pipeline",
        "import iconjax",
        "import iconjax.cli",
    ):
        assert run(f"{first}\nfrom iconjax import edit\nprint(type(edit).__name__)") == "function"


def test_help_is_quick():
    command = [sys.executable, "-m", "iconjax", "--help"]
    subprocess.run(command, capture_output=True, check=True)
    times = []
    for _ in range(3):
        start = time.perf_counter()
        subprocess.run(command, capture_output=True, check=True)
        times.append(time.perf_counter() - start)
    assert min(times) < 1.0  # 0.15 s on an idle machine; tests share theirs


def test_public_names_exist():
    for name in iconjax.__all__:
        assert getattr(iconjax, name) is not None
    assert set(iconjax.__all__) <= set(dir(iconjax))
    with pytest.raises(AttributeError, match="no_such"):
        _ = iconjax.no_such
