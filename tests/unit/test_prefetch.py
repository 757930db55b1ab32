"""Stages in threads of their own: order, bounds, errors, and an early end."""

from __future__ import annotations

import signal
import subprocess
import sys
import threading
import time
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


COMMAND = """
import time
from lampblack.cli.console import for_people
from lampblack.finals.prefetch import prefetch

def items():
    yield 0
    time.sleep(2)
    yield 1

with for_people():
    for item in prefetch(items()):
        print(item, flush=True)
"""


def test_a_command_that_is_told_twice_to_end_says_nothing() -> None:
    """As one that make runs: the signal reaches both, and make passes it on."""
    command = [sys.executable, "-c", COMMAND]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == b"0\n"
        process.terminate()
        time.sleep(0.5)
        process.terminate()
        _, said = process.communicate(timeout=60)
    assert said == b""
    assert process.returncode == 128 + signal.SIGTERM
