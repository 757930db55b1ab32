"""Threads that survive an error which their work did not expect."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable

PAUSE_SECONDS = 0.5


def lasting_thread(
    name: str, run: Callable[[], None], report: Callable[[Exception], None]
) -> threading.Thread:
    """A thread that calls ``run`` until it returns. If it raises, ``report`` is told, and it runs
    again: one piece of bad luck must not end the previews or the jobs of a whole day."""

    def run_on() -> None:
        while True:
            try:
                run()
                return
            except Exception as error:
                report(error)
                time.sleep(PAUSE_SECONDS)

    return threading.Thread(target=run_on, name=name, daemon=True)


def join_all(threads: Iterable[threading.Thread], seconds: float) -> None:
    """Wait for the end of ``threads``, but for all of them at most ``seconds``: a network or a
    kernel cannot be interrupted."""
    until = time.monotonic() + seconds
    for thread in threads:
        if thread.is_alive():
            thread.join(max(0.0, until - time.monotonic()))
