"""Files appear whole or not at all."""

from __future__ import annotations

import errno
import os

import pytest

from iconjax import InputError
from iconjax.files import check_writable, image_format, write_bytes, write_text


def test_writes_and_replaces(tmp_path):
    path = tmp_path / "a.txt"
    write_text(path, "one")
    write_text(str(path), "zwei ü")
    assert path.read_text("utf-8") == "zwei ü"
    assert os.listdir(tmp_path) == ["a.txt"]


def test_mode_is_that_of_an_ordinary_file(tmp_path):
    (tmp_path / "ordinary").write_bytes(b"")
    write_bytes(tmp_path / "ours", b"")
    assert (tmp_path / "ours").stat().st_mode == (tmp_path / "ordinary").stat().st_mode
    (tmp_path / "ours").chmod(0o640)
    write_bytes(tmp_path / "ours", b"x")
    assert (tmp_path / "ours").stat().st_mode & 0o777 == 0o640


def test_a_link_keeps_pointing(tmp_path):
    (tmp_path / "real").write_text("old")
    (tmp_path / "link").symlink_to("real")
    write_text(tmp_path / "link", "new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_text() == "new"


@pytest.mark.parametrize("call", ["write", "fsync", "replace"])
def test_a_full_disk_leaves_what_was_there(tmp_path, monkeypatch, call):
    path = tmp_path / "a.txt"
    path.write_text("old")

    def full(*args, **kwargs):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    if call == "write":
        real = os.fdopen

        def broken(*args, **kwargs):
            stream = real(*args, **kwargs)
            os.close(stream.fileno())  # the descriptor is gone, so the write fails
            return stream

        monkeypatch.setattr(os, "fdopen", broken)
    else:
        monkeypatch.setattr(os, call, full)
    with pytest.raises(InputError, match=r"cannot write .*a\.txt"):
        write_text(path, "new")
    assert path.read_text() == "old"
    assert os.listdir(tmp_path) == ["a.txt"]


@pytest.mark.parametrize("check", [check_writable, lambda path: write_bytes(path, b"x")])
def test_impossible_places(tmp_path, check):
    (tmp_path / "file").write_text("x")
    for path in (tmp_path, tmp_path / "missing" / "a", tmp_path / "file" / "a", "", "a\0b"):
        with pytest.raises(InputError, match="cannot write"):
            check(path)
    assert os.listdir(tmp_path) == ["file"]


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
def test_devices_are_written_to_and_not_replaced():
    before = os.stat("/dev/full").st_ino
    with pytest.raises(InputError, match="no space"):
        write_bytes("/dev/full", b"x" * 100_000)
    write_bytes("/dev/null", b"x")
    assert os.stat("/dev/full").st_ino == before


def test_image_formats():
    assert image_format("a.PNG") == "PNG"
    assert image_format("b.jpeg") == "JPEG"
    for name in ("a", "a.svg", ".png"):
        with pytest.raises(InputError, match=r"\.png"):
            image_format(name)
