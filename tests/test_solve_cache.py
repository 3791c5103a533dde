"""The store of compiled solvers: what breaks it, what it keeps, and what it leaves alone."""

from __future__ import annotations

import threading

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from engine_support import met, picture, rect, searched

from iconjax.solve import cache

ONES = (np.ones((3, 2)), np.arange(4))


def function(x, k):
    """Something small enough to compile in a moment."""
    return jnp.sum(x) * 2 + k


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """An empty cache folder, and nothing in memory."""
    monkeypatch.setenv("ICONJAX_CACHE", str(tmp_path / "cache"))
    forget(monkeypatch)
    return tmp_path / "cache"


def forget(monkeypatch):
    """As a new process would begin."""
    monkeypatch.setattr(cache, "_memory", {})


def no_compiling(monkeypatch):
    """Make any compilation an error."""

    def jit(*args, **kwargs):
        raise AssertionError("compiled again")

    monkeypatch.setattr(cache.jax, "jit", jit)


def get(name="small", arguments=ONES):
    """An executable and its result for the arguments."""
    with cache.precise_cpu():
        executable, seconds = cache.compiled(name, function, arguments)
        return np.asarray(executable(*arguments)), seconds


def test_a_second_process_loads_instead_of_compiling(folder, monkeypatch):
    first, _ = get()
    assert [p.suffix for p in folder.iterdir()] == [".xla"]
    forget(monkeypatch)
    no_compiling(monkeypatch)
    again, seconds = get()
    assert np.array_equal(first, again) and again.tolist() == [12, 13, 14, 15]
    assert seconds > 0


def test_a_second_call_costs_nothing(folder, monkeypatch):
    get()
    for path in folder.iterdir():
        path.unlink()
    no_compiling(monkeypatch)
    assert get()[1] == 0.0


@pytest.mark.parametrize("damage", [b"", b"not a pickle", None])
def test_a_damaged_file_is_ignored_and_made_anew(folder, monkeypatch, damage):
    good, _ = get()
    (path,) = folder.iterdir()
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 2] if damage is None else damage)
    forget(monkeypatch)
    assert np.array_equal(get()[0], good)
    forget(monkeypatch)
    no_compiling(monkeypatch)  # the file is whole again
    assert np.array_equal(get()[0], good)


def test_a_file_of_something_else_is_ignored(folder, monkeypatch):
    import pickle

    good, _ = get()
    (path,) = folder.iterdir()
    path.write_bytes(pickle.dumps(("a", "pickle", "of strings")))
    forget(monkeypatch)
    assert np.array_equal(get()[0], good)


def test_without_a_cache_folder_it_works_and_writes_nothing(tmp_path, monkeypatch):
    monkeypatch.setenv("ICONJAX_CACHE", "")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    forget(monkeypatch)
    assert cache.cache_folder() is None
    assert get()[0].tolist() == [12, 13, 14, 15]
    assert not list(tmp_path.iterdir())


def test_a_folder_that_cannot_be_made_stops_nothing(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("ICONJAX_CACHE", str(tmp_path / "file" / "cache"))
    forget(monkeypatch)
    assert get()[0].tolist() == [12, 13, 14, 15]


def test_no_half_written_files_are_left_behind(folder, monkeypatch):
    def fail(*args):
        raise OSError("disk full")

    monkeypatch.setattr(cache.os, "replace", fail)
    assert get()[0].tolist() == [12, 13, 14, 15]
    assert not list(folder.glob("*.xla"))


def test_other_shapes_and_other_names_are_other_executables(folder):
    get()
    get("other")
    get(arguments=(np.ones((5, 2)), np.arange(4)))
    get(arguments=(np.ones((3, 2), np.float32), np.arange(4)))
    assert len(list(folder.glob("*.xla"))) == 4


def test_the_folder_follows_the_environment(tmp_path, monkeypatch):
    monkeypatch.delenv("ICONJAX_CACHE", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache.cache_folder() == tmp_path / "iconjax"
    monkeypatch.setenv("ICONJAX_CACHE", str(tmp_path / "own"))
    assert cache.cache_folder() == tmp_path / "own"


def test_several_threads_may_ask_at_once(folder):
    results = []
    threads = [threading.Thread(target=lambda: results.append(get()[0].tolist()), daemon=True) for _ in range(4)]
    for t in threads:
        t.start()
    for t in threads:
        t.join(timeout=60)
    assert results == [[12, 13, 14, 15]] * 4


@pytest.fixture
def single_precision():
    """JAX as it starts, whatever ran before; a change made for good would show."""
    before = jax.config.jax_enable_x64
    jax.config.update("jax_enable_x64", False)
    yield
    jax.config.update("jax_enable_x64", before)


def test_double_precision_ends_with_its_block_and_stays_in_its_thread(single_precision):
    seen = []
    with cache.precise_cpu():
        assert jnp.asarray(np.ones(1)).dtype == jnp.float64
        thread = threading.Thread(target=lambda: seen.append(jax.config.jax_enable_x64))
        thread.start()
        thread.join()
    assert not jax.config.jax_enable_x64 and seen == [False]


def test_a_search_leaves_the_callers_jax_as_it_was(single_precision):
    watched = ("jax_enable_x64", "jax_default_device", "jax_platforms", "jax_compilation_cache_dir", "jax_debug_nans")
    before = {name: getattr(jax.config, name) for name in watched}
    dtype = jnp.asarray(np.ones(1)).dtype
    scene = picture({"Ball": rect(30, 30, 60, 60)})
    assert met(searched(scene, 'translate("Ball")\nequal(min_x("Ball"), 40)'))
    assert {name: getattr(jax.config, name) for name in watched} == before
    assert jnp.asarray(np.ones(1)).dtype == dtype


def test_a_search_obeys_no_precision_set_by_the_caller():
    scene = picture({"Ball": rect(30, 30, 60, 60)})
    text = 'translate("Ball")\nequal(min_x("Ball"), 40)'
    plain = searched(scene, text)
    with jax.enable_x64(True):
        double = searched(scene, text)
    assert np.array_equal(plain.matrices, double.matrices) and plain.matrices.dtype == np.float64
