"""A process that does no work is not waited for, and one that works is."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from io import FileIO
from typing import cast

import numpy as np
import pytest

from lampblack.render import watched_pipe
from lampblack.render.watched_pipe import Stalled, WatchedPipe, unblocked
from lampblack.render.wire import Load, send

BUSY = """
import sys, time
end = time.monotonic() + 3
while time.monotonic() < end: pass
sys.stdout.buffer.write(b"x")
"""
HINDERED = """
import sys, time
end = time.monotonic() + 4
while time.monotonic() < end:
    time.sleep(0.1)
    busy = time.process_time() + 0.003
    while time.process_time() < busy: pass
sys.stdout.buffer.write(b"x")
"""
IDLE = "import time; time.sleep(60)"


@pytest.fixture(autouse=True)
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(watched_pipe, "LOOK_SECONDS", 0.1)
    monkeypatch.setattr(watched_pipe, "STOPPED_SECONDS", 0.5)
    monkeypatch.setattr(watched_pipe, "IDLE_SECONDS", 1.5)
    monkeypatch.setattr(watched_pipe, "SLOW_SECONDS", 1.0)
    monkeypatch.setattr(watched_pipe, "SLOW_SHARE", 0.1)


@contextmanager
def started(program: str) -> Iterator[subprocess.Popen[bytes]]:
    process = subprocess.Popen(
        [sys.executable, "-c", program], bufsize=0, stdin=subprocess.PIPE, stdout=subprocess.PIPE
    )
    with process:
        try:
            yield process
        finally:
            process.kill()


@pytest.mark.parametrize(("program", "slow"), [(BUSY, False), (HINDERED, True)])
def test_an_answer_that_takes_its_time_is_waited_for(program: str, slow: bool) -> None:
    """It is told of a process that hardly gets to work."""
    told: list[str] = []
    with started(program) as process:
        stdout = cast(FileIO, process.stdout)
        pipe = WatchedPipe(stdout, process.pid, lambda: told.append("slow"))
        assert pipe.readinto(memoryview(bytearray(1))) == 1
    assert bool(told) == slow


@pytest.mark.parametrize(("program", "stop"), [(IDLE, False), (BUSY, True)])
def test_a_process_that_does_not_work_is_given_up(program: str, stop: bool) -> None:
    with started(program) as process:
        if stop:
            process.send_signal(signal.SIGSTOP)
        pipe = WatchedPipe(cast(FileIO, process.stdout), process.pid)
        began = time.monotonic()
        with pytest.raises(Stalled, match="stopped" if stop else "no work"):
            pipe.readinto(memoryview(bytearray(1)))
        assert time.monotonic() - began > 0.4


def test_a_process_that_does_not_read_is_given_up() -> None:
    with started(IDLE) as process:
        pipe = WatchedPipe(unblocked(cast(FileIO, process.stdin)), process.pid)
        vertices = np.zeros((100_000, 3), np.float32)  # more than the pipe holds
        with pytest.raises(Stalled):
            send(pipe, Load(), [vertices])
