"""Prefetching: a stage of a job runs in its own thread, one item ahead."""

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
    """Yield ``items``. A thread makes the next item while the caller uses the current one; at most
    one item waits. To end early, close the generator; then ``abandon`` may interrupt the thread."""
    with closing(items), ThreadPoolExecutor(1) as thread:
        try:
            coming = thread.submit(next, items, _END)
            while (item := coming.result()) is not _END:
                coming = thread.submit(next, items, _END)
                yield item  # type: ignore[misc]
        except BaseException:
            abandon()
            raise
