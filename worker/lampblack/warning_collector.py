"""Collecting warnings per thread; ``warnings.catch_warnings`` is for the whole process."""

from __future__ import annotations

import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager

from .errors import LampblackWarning

_local = threading.local()


def install_warning_collector() -> None:
    """From now on, ``collect_warnings`` collects the ``LampblackWarning``s of its thread, and no
    warning is printed."""
    warnings.simplefilter("ignore")
    warnings.simplefilter("always", LampblackWarning)

    def collect(message: Warning | str, category: type[Warning], *_: object, **__: object) -> None:
        collected = getattr(_local, "collected", None)
        if collected is not None and str(message) not in collected:
            collected.append(str(message))

    warnings.showwarning = collect


@contextmanager
def collect_warnings() -> Iterator[list[str]]:
    """A context that yields the texts of this thread's warnings in it, but for those in contexts
    within it."""
    around = getattr(_local, "collected", None)
    collected: list[str] = []
    _local.collected = collected
    try:
        yield collected
    finally:
        _local.collected = around
