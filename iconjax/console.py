"""Manners of the command line: one-line errors, exit statuses, and progress that only a terminal sees."""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from time import perf_counter
from typing import Any

import click

from iconjax.errors import IconjaxError
from iconjax.files import describe

USAGE, BUG, STOPPED = 2, 70, 130
"""Exit statuses: bad input; an error inside iconjax; interrupted. A strict edit that misses one gives 1."""


class PoliteGroup(click.Group):
    """A group of commands in which whatever goes wrong is one line on stderr and an exit status."""

    # Not typed as click types it, in overloads: one for a call that never returns, and one for all others.
    def main(  # type: ignore[override]
        self,
        args: Sequence[str] | None = None,
        prog_name: str | None = None,
        *,
        standalone_mode: bool = True,
        **extra: Any,
    ) -> Any:
        """Run a command; with `standalone_mode` off, exceptions reach the caller."""
        if not standalone_mode:
            return super().main(args, prog_name, standalone_mode=False, **extra)
        status: Any
        try:
            status = super().main(args, prog_name, standalone_mode=False, **extra)
        except IconjaxError as error:
            status = fail(str(error), USAGE)
        except click.ClickException as error:
            status = fail(_usage(error), USAGE)
        except (click.Abort, KeyboardInterrupt):
            status = fail("interrupted", STOPPED)
        except BrokenPipeError:  # whoever read our output has seen enough
            _drop_stdout()
            status = 1
        except OSError as error:
            status = fail(describe(error), USAGE)
            _drop_stdout()
        except Exception as error:
            if os.environ.get("ICONJAX_DEBUG"):
                traceback.print_exc()
            status = fail(
                f"internal error: {type(error).__name__}: {error} (ICONJAX_DEBUG=1 shows where)",
                BUG,
            )
        sys.exit(status if isinstance(status, int) else 0)


def _drop_stdout() -> None:
    """Keep the interpreter from trying once more at exit to write what stdout did not take."""
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def fail(message: str, status: int) -> int:
    """Write one line to stderr; gives back `status`."""
    say("error: " + "; ".join(line.strip() for line in message.splitlines() if line.strip()))
    return status


def say(message: str) -> None:
    """A message for the person at the keyboard."""
    click.echo(f"iconjax: {message}", err=True)


@contextmanager
def progress() -> Iterator[Any]:
    """A function that shows which stage has begun, on a line that vanishes at the end; silent in a pipe."""
    if not sys.stderr.isatty():
        yield lambda stage: None
        return
    start = perf_counter()

    def show(stage: str) -> None:
        sys.stderr.write(f"\r\x1b[K{perf_counter() - start:5.1f} s  {stage} ...")
        sys.stderr.flush()

    try:
        yield show
    finally:
        sys.stderr.write("\r\x1b[K")
        sys.stderr.flush()


def _usage(error: click.ClickException) -> str:
    message = error.format_message()
    if isinstance(error, click.UsageError) and error.ctx is not None:
        return f"{message} (see '{error.ctx.command_path} --help')"
    return message
