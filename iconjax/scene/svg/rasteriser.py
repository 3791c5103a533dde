"""The rasteriser, in a process of its own that is started when it is first needed and replaced when it breaks."""

from __future__ import annotations

import atexit
import os
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from threading import Lock, Timer
from typing import IO

MAX_SECONDS = 10.0
"""Longest that one drawing may take."""
_WORKER = Path(__file__).with_name("worker.py")


class RasteriserError(Exception):
    """The rasteriser refused, broke down or took too long."""


class _Rasteriser:
    def __init__(self) -> None:
        self._lock = Lock()
        self._process: subprocess.Popen[bytes] | None = None
        self._owner = 0

    def draw(self, text: bytes) -> bytes:
        with self._lock:
            process = self._running()
            timer = Timer(MAX_SECONDS, process.kill)
            timer.start()
            try:
                return _exchange(process, text)
            except (OSError, ValueError, EOFError):
                self._drop()
                raise RasteriserError("the rasteriser broke down or took too long") from None
            except BaseException:  # an interrupted exchange leaves the pipe out of step
                self._drop()
                raise
            finally:
                timer.cancel()

    def close(self) -> None:
        with self._lock:
            self._drop()

    def _running(self) -> subprocess.Popen[bytes]:
        if self._process is not None and (self._owner != os.getpid() or self._process.poll() is not None):
            if self._owner == os.getpid():
                self._drop()
            self._process = None  # after a fork it is the parent's
        if self._process is None:
            # -P: the worker's own folder holds modules whose names are those of the standard library.
            command = [sys.executable, "-P", str(_WORKER)]
            pipe, null = subprocess.PIPE, subprocess.DEVNULL
            self._process = subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=null)
            self._owner = os.getpid()
        return self._process

    def _drop(self) -> None:
        process, self._process = self._process, None
        if process is None or self._owner != os.getpid():
            return
        process.kill()
        for stream in (process.stdin, process.stdout):
            with suppress(OSError, ValueError):
                assert stream is not None
                stream.close()
        process.wait()


def _exchange(process: subprocess.Popen[bytes], text: bytes) -> bytes:
    send, receive = process.stdin, process.stdout
    assert send is not None and receive is not None
    send.write(len(text).to_bytes(8, "big") + text)
    send.flush()
    status = _read(receive, 1)
    answer = _read(receive, int.from_bytes(_read(receive, 8), "big"))
    if status != b"+":
        raise RasteriserError(answer.decode("utf-8", "replace"))
    return answer


def _read(stream: IO[bytes], count: int) -> bytes:
    data = stream.read(count)
    if len(data) < count:
        raise EOFError
    return data


_SHARED = _Rasteriser()
atexit.register(_SHARED.close)


def rasterise(text: bytes) -> bytes:
    """SVG text as a PNG of the size it states.

    Raises:
        RasteriserError: it cannot be drawn.
    """
    return _SHARED.draw(text)
