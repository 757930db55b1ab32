"""Stages of a line of work, each in a thread of its own."""

from __future__ import annotations

from collections.abc import Callable, Generator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from typing import Final, TypeVar

Item = TypeVar("Item")

_END: Final = object()


def ahead(
    items: Generator[Item, None, None], abandon: Callable[[], None] = lambda: None
) -> Generator[Item, None, None]:
    """``items``, of which the next is made in a thread while the last is used: one is waiting at
    most. Close it to end early; then ``abandon`` may cut short what is being made."""
    with closing(items), ThreadPoolExecutor(1) as thread:
        try:
            coming = thread.submit(next, items, _END)
            while (item := coming.result()) is not _END:
                coming = thread.submit(next, items, _END)
                yield item  # type: ignore[misc]
        except BaseException:
            abandon()
            raise
