"""A process that draws SVG text with resvg: run as a script, fed through its standard input.

It stands alone, so that what the rasteriser cannot take (a crash, a flood of memory, an endless loop) ends this
process and not the caller's. Each request is a length of 8 bytes and the text, each answer a status byte, a
length of 8 bytes, and a PNG or the reason why there is none.
"""

from __future__ import annotations

import sys

MAX_MEMORY = 3 << 30
"""Bytes of address space; the rasteriser itself takes a small part of it."""


def main() -> None:
    limit_memory()
    import resvg_py

    receive, send = sys.stdin.buffer, sys.stdout.buffer
    while len(head := receive.read(8)) == 8:
        text = receive.read(int.from_bytes(head, "big"))
        try:
            answer = resvg_py.svg_to_bytes(svg_string=text.decode("utf-8"), skip_system_fonts=True, dpi=96)
            status = b"+"
        except BaseException as error:
            answer, status = " ".join(str(error).split())[:120].encode(), b"-"
        send.write(status + len(answer).to_bytes(8, "big") + answer)
        send.flush()


def limit_memory() -> None:
    """Make allocations beyond the limit fail, where the system can."""
    try:
        import resource
    except ImportError:
        return
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    limit = MAX_MEMORY if hard == resource.RLIM_INFINITY else min(MAX_MEMORY, hard)
    resource.setrlimit(resource.RLIMIT_AS, (limit, hard))


if __name__ == "__main__":
    main()
