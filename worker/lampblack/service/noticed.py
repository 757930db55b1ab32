"""Warnings caught thread by thread; ``warnings.catch_warnings`` knows only the whole process."""

from __future__ import annotations

import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager

from ..errors import LampblackWarning

_local = threading.local()


def listen() -> None:
    """From now on ``noticed_warnings`` gathers every ``LampblackWarning`` of its thread, and
    no warning is printed."""
    warnings.simplefilter("ignore")
    warnings.simplefilter("always", LampblackWarning)

    def notice(message: Warning | str, category: type[Warning], *_: object, **__: object) -> None:
        heard = getattr(_local, "heard", None)
        if heard is not None and str(message) not in heard:
            heard.append(str(message))

    warnings.showwarning = notice


@contextmanager
def noticed_warnings() -> Iterator[list[str]]:
    """The sentences of what this thread is warned of within the block."""
    _local.heard = []
    try:
        yield _local.heard
    finally:
        _local.heard = None
