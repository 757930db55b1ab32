"""The parent's ends of the pipes to the render process, which do not wait for a process that is
stopped or hangs."""

from __future__ import annotations

import os
import select
import time
from collections.abc import Callable
from dataclasses import dataclass
from io import FileIO
from pathlib import Path

LOOK_SECONDS = 0.5
STOPPED_SECONDS = 3.0
IDLE_SECONDS = 8.0
SLOW_SECONDS = 8.0
SLOW_SHARE = 0.02
"""Of one processor. A process that gets less of it hardly works."""


class Stalled(OSError):
    """The process does not work and will not answer."""


class WatchedPipe:
    """One end of a pipe to a process that owes an answer, or reads a request.

    A process that was stopped (SIGSTOP) is given up, and one that did nothing for
    ``IDLE_SECONDS``, as where a driver hangs. One that the machine keeps from its work (others use
    the processor, or its memory is read back from the disk) is waited for. Linux tells; elsewhere
    all are waited for.

    Args:
        slow: called each time that the process has hardly worked for ``SLOW_SECONDS``.

    Raises:
        Stalled: from ``readinto`` and ``write``.
    """

    def __init__(self, pipe: FileIO, pid: int, slow: Callable[[], None] = lambda: None) -> None:
        self._pipe = pipe
        self._process = Path(f"/proc/{pid}")
        self._slow = slow

    def readinto(self, buffer: memoryview) -> int | None:
        """Read what is there; wait until there is something."""
        self._wait([self._pipe], [])
        return self._pipe.readinto(buffer)

    def write(self, data: memoryview) -> int | None:
        """Write what fits; wait until something does. The pipe does not block."""
        self._wait([], [self._pipe])
        return self._pipe.write(data)

    def _wait(self, reading: list[FileIO], writing: list[FileIO]) -> None:
        began = running = worked = time.monotonic()
        first, last = _Work.of(self._process), (-1, -1)
        while not any(select.select(reading, writing, [], LOOK_SECONDS)):
            work, now = _Work.of(self._process), time.monotonic()
            if work is None or first is None:
                continue
            if work.amount != last:
                running = worked = now
                last = work.amount
            if not set(work.states) <= {"T", "t"}:
                running = now
            elif now - running > STOPPED_SECONDS:
                raise Stalled("it was stopped")
            if "R" in work.states:
                worked = now
            elif now - worked > IDLE_SECONDS:
                raise Stalled(f"it did no work for {IDLE_SECONDS:.0f} seconds")
            if now - began > SLOW_SECONDS and now - worked < IDLE_SECONDS / 2:
                if work.seconds - first.seconds < SLOW_SHARE * (now - began):
                    self._slow()
                began, first = now, work


@dataclass(frozen=True)
class _Work:
    """What a process has done so far (proc(5)).

    Attributes:
        states: a letter for each thread. R: it runs, or would if there were a free processor.
        amount: processor time in ticks, and pages of memory that were read from a disk.
    """

    states: str
    amount: tuple[int, int]

    @staticmethod
    def of(process: Path) -> _Work | None:
        """None if the process has ended, or the system is not Linux."""
        try:
            fields = _fields(process)
            states = "".join(_fields(thread)[0] for thread in (process / "task").iterdir())
        except (OSError, IndexError):
            return None
        return _Work(states, (int(fields[11]) + int(fields[12]), int(fields[9])))

    @property
    def seconds(self) -> float:
        """Processor time."""
        return self.amount[0] / os.sysconf("SC_CLK_TCK")


def _fields(process: Path) -> list[str]:
    """From its state on."""
    text = (process / "stat").read_text(encoding="utf-8", errors="replace")
    return text.rpartition(")")[2].split()


def unblocked(pipe: FileIO) -> FileIO:
    """``pipe``, of which a write takes only what fits."""
    os.set_blocking(pipe.fileno(), False)
    return pipe
