"""Processor time of the render process, by what it was spent on."""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Literal

Activity = Literal["mesh", "cycles", "denoiser"]

_seconds: dict[Activity, float] = defaultdict(float)


@contextmanager
def spent_on(activity: Activity) -> Iterator[None]:
    """A context whose processor seconds, of all threads, count as ``activity``."""
    begin = time.process_time()
    try:
        yield
    finally:
        _seconds[activity] += time.process_time() - begin


def take_spent() -> dict[Activity, float]:
    """Processor seconds since the last call."""
    taken: dict[Activity, float] = dict(_seconds)
    _seconds.clear()
    return taken
