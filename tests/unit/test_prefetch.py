"""Stages in threads of their own: order, bounds, errors, and an early end."""

from __future__ import annotations

import threading
from collections.abc import Generator
from contextlib import closing

import pytest

from lampblack.finals.prefetch import prefetch


def test_items_keep_their_order_and_only_one_waits() -> None:
    made: list[int] = []

    def items() -> Generator[int, None, None]:
        for number in range(20):
            made.append(number)
            yield number

    taken = []
    for number in prefetch(items()):
        taken.append(number)
        assert len(made) <= len(taken) + 1
    assert taken == made == list(range(20))


def test_an_error_comes_up_where_the_item_is_wanted() -> None:
    def items() -> Generator[int, None, None]:
        yield 1
        raise KeyError("two")

    stream = prefetch(items())
    assert next(stream) == 1
    with pytest.raises(KeyError, match="two"):
        next(stream)


def test_an_early_end_cuts_short_what_is_being_made_and_closes_every_stage() -> None:
    let_go, closed = threading.Event(), []

    def first() -> Generator[int, None, None]:
        try:
            yield from range(100)
        finally:
            closed.append("first")

    def second(items: Generator[int, None, None]) -> Generator[int, None, None]:
        with closing(items):
            try:
                for number in items:
                    if number:
                        assert let_go.wait(30)
                    yield number
            finally:
                closed.append("second")

    stream = prefetch(second(prefetch(first())), let_go.set)
    assert next(stream) == 0
    stream.close()
    assert closed == ["second", "first"]
