"""The parent's ends of the pipes to the render process, which do not wait for a process that is
stopped or hangs."""

from __future__ import annotations

import os
import select
import time
from io import FileIO
from pathlib import Path

LOOK_SECONDS = 0.5
STOPPED_SECONDS = 3.0
IDLE_SECONDS = 10.0


class Stalled(OSError):
    """The process does not work and will not answer."""


class WatchedPipe:
    """One end of a pipe to a process that owes an answer, or reads a request.

    A process that was stopped (SIGSTOP), or that used no processor time for ``IDLE_SECONDS``
    (a driver that hangs, a machine that swaps), is given up. Linux tells; elsewhere it is waited
    for.

    Raises:
        Stalled: from ``readinto`` and ``write``.
    """

    def __init__(self, pipe: FileIO, pid: int) -> None:
        self._pipe = pipe
        self._process = Path(f"/proc/{pid}/stat")

    def readinto(self, buffer: memoryview) -> int | None:
        """Read what is there; wait until there is something."""
        self._wait([self._pipe], [])
        return self._pipe.readinto(buffer)

    def write(self, data: memoryview) -> int | None:
        """Write what fits; wait until something does. The pipe does not block."""
        self._wait([], [self._pipe])
        return self._pipe.write(data)

    def _wait(self, reading: list[FileIO], writing: list[FileIO]) -> None:
        worked, used = time.monotonic(), -1
        running = worked
        while not any(select.select(reading, writing, [], LOOK_SECONDS)):
            state, now = self._look()
            if state in "Tt":
                if time.monotonic() - running > STOPPED_SECONDS:
                    raise Stalled("it was stopped")
            else:
                running = time.monotonic()
            if now != used:
                worked, used = time.monotonic(), now
            elif time.monotonic() - worked > IDLE_SECONDS:
                raise Stalled(f"it did no work for {IDLE_SECONDS:.0f} seconds")

    def _look(self) -> tuple[str, int]:
        """The state of the process (proc(5)), and the processor time that it has used, in ticks."""
        try:
            fields = self._process.read_text(encoding="utf-8").rpartition(")")[2].split()
        except OSError:
            return "", time.monotonic_ns()  # not Linux: it counts as at work
        return fields[0], int(fields[11]) + int(fields[12])


def unblocked(pipe: FileIO) -> FileIO:
    """``pipe``, of which a write takes only what fits."""
    os.set_blocking(pipe.fileno(), False)
    return pipe
