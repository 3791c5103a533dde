"""How far a run has come: one line with a bar and the time that is left, on a terminal only."""

from __future__ import annotations

import shutil
import sys
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from time import monotonic
from typing import TextIO

from iconjax.evaluation.record import CaseRecord

WINDOW = 40
"""Finished cases that the speed is taken from: the first ones compile and would be held against all others."""

WIDTH = 24
"""Characters of the bar."""


@dataclass(frozen=True)
class Step:
    """A case was finished by a method.

    Attributes:
        record: how it came out.
        done, total: cases finished and to be finished, over all methods.
    """

    record: CaseRecord
    done: int
    total: int

    @property
    def state(self) -> str:
        """How it came out, in words."""
        record = self.record
        return f"failed: {record.error}" if record.error else "right" if record.right else "not right"

    def __str__(self) -> str:
        return f"{self.done}/{self.total} {self.record.method}: {self.record.case}: {self.state}"


Progress = Callable[[Step], None]


class Bar:
    """Draws each step over the one before; failures stay on the screen.

    Args:
        stream: a terminal.
        clock: seconds that only grow.
    """

    def __init__(self, stream: TextIO, clock: Callable[[], float] = monotonic) -> None:
        self.stream, self.clock = stream, clock
        self.times = deque([clock()], maxlen=WINDOW + 1)

    def __call__(self, step: Step) -> None:
        """Show a step."""
        self.times.append(self.clock())
        if step.record.error:
            self.stream.write(f"\r\x1b[K{step}\n")
        columns = shutil.get_terminal_size().columns
        self.stream.write("\r\x1b[K" + self.line(step)[: columns - 1])
        self.stream.flush()

    def line(self, step: Step) -> str:
        """The bar as text."""
        full = WIDTH * step.done // max(step.total, 1)
        record, bar = step.record, "#" * full + "." * (WIDTH - full)
        word = "failed" if record.error else step.state
        return f"[{bar}] {step.done}/{step.total}  {self.left(step)} left  {record.method}: {record.case}: {word}"

    def left(self, step: Step) -> str:
        """The time that the rest will take, as m:ss or h:mm:ss."""
        pace = (self.times[-1] - self.times[0]) / max(len(self.times) - 1, 1)
        seconds = round(pace * (step.total - step.done))
        hours, rest = divmod(seconds, 3600)
        minutes = f"{rest // 60}:{rest % 60:02}"
        return f"{hours}:{minutes.zfill(5)}" if hours else minutes

    def close(self) -> None:
        """Take the bar away."""
        self.stream.write("\r\x1b[K")
        self.stream.flush()


@contextmanager
def bar_on_terminal() -> Iterator[Progress]:
    """A bar on stderr, gone at the end; nothing where stderr is no terminal."""
    if not sys.stderr.isatty():
        yield lambda step: None
        return
    bar = Bar(sys.stderr)
    try:
        yield bar
    finally:
        bar.close()
