"""Warnings collected by thread; ``warnings.catch_warnings`` knows only the whole process."""

from __future__ import annotations

import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager

from .errors import LampblackWarning

_local = threading.local()


def install_warning_collector() -> None:
    """From now on ``collect_warnings`` collects every ``LampblackWarning`` of its thread, and
    no warning is printed."""
    warnings.simplefilter("ignore")
    warnings.simplefilter("always", LampblackWarning)

    def collect(message: Warning | str, category: type[Warning], *_: object, **__: object) -> None:
        collected = getattr(_local, "collected", None)
        if collected is not None and str(message) not in collected:
            collected.append(str(message))

    warnings.showwarning = collect


@contextmanager
def collect_warnings() -> Iterator[list[str]]:
    """The sentences of this thread's warnings within the block."""
    _local.collected = []
    try:
        yield _local.collected
    finally:
        _local.collected = None
