"""When to try again, and after how long.

The SDK could do this itself, but it waits as long as a server says, be it a day. Here a wait is bounded, and tests can
pass the time themselves.
"""

from __future__ import annotations

import random
import time
from email.utils import mktime_tz, parsedate_tz

FIRST_PAUSE, LONGEST_PAUSE = 0.5, 8.0
LONGEST_WAIT = 60.0
"""Seconds that a server may ask us to wait; if it wants longer, the user should know instead."""
BUSY = frozenset({408, 409, 429})
"""Statuses below 500 that may pass."""


def may_pass(status: int | None) -> bool:
    """Whether a failure may go away by itself; `status` is None where the server was not reached."""
    return status is None or status in BUSY or status >= 500


def retry_after(header: str | None, now: float | None = None) -> float | None:
    """Seconds that a `retry-after` header asks for (a number, or a date), or None."""
    if not header:
        return None
    try:
        seconds = float(header)
    except ValueError:
        date = parsedate_tz(header)
        if date is None:
            return None
        seconds = mktime_tz(date) - (time.time() if now is None else now)
    return seconds if 0 <= seconds < float("inf") else None


def pause(attempt: int, asked: float | None) -> float | None:
    """Seconds to wait after failed attempt number `attempt` (from 0), or None where waiting makes no sense.

    Without a wish of the server it doubles from one attempt to the next, less a random quarter, so that clients that
    failed together do not come back together.
    """
    if asked is not None and asked > 0:
        return asked if asked <= LONGEST_WAIT else None
    return min(FIRST_PAUSE * 2.0**attempt, LONGEST_PAUSE) * (1 - 0.25 * random.random())
