"""Processes that a test did not start itself."""

from __future__ import annotations

import os
import time
from contextlib import suppress
from pathlib import Path


def gone(pid: int, seconds: float) -> bool:
    """Wait for a process to end."""
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        try:
            os.kill(pid, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.05)
    return False


def processes_below(root: int) -> dict[int, bytes]:
    """Command lines of all processes that descend from ``root``."""
    parents: dict[int, int] = {}
    for entry in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError, IndexError, ValueError):
            fields = entry.read_text().rpartition(")")[2].split()
            if fields[0] not in "ZX":
                parents[int(entry.parent.name)] = int(fields[1])
    found: dict[int, bytes] = {}
    for pid in parents:
        above = pid
        while above in parents and above != root:
            above = parents[above]
        if above == root and pid != root:
            with suppress(OSError):
                found[pid] = Path(f"/proc/{pid}/cmdline").read_bytes()
    return found


def workers_of(root: int) -> list[int]:
    """Workers that descend from ``root``."""
    return [pid for pid, words in processes_below(root).items() if b"lampblack\0serve" in words]
