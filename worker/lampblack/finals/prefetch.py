"""Stages of a job, each in a thread of its own."""

from __future__ import annotations

from collections.abc import Callable, Generator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from typing import Final, TypeVar

Item = TypeVar("Item")

_END: Final = object()


def prefetch(
    items: Generator[Item, None, None], abandon: Callable[[], None] = lambda: None
) -> Generator[Item, None, None]:
    """Yield ``items``. A thread makes the next one while the caller uses the last one; at most
    one waits. Close the generator to end early: ``abandon`` may then cut short what is made."""
    with closing(items), ThreadPoolExecutor(1) as thread:
        try:
            coming = thread.submit(next, items, _END)
            while (item := coming.result()) is not _END:
                coming = thread.submit(next, items, _END)
                yield item  # type: ignore[misc]
        except BaseException:
            abandon()
            raise
