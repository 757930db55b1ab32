"""Processes that a test did not start itself."""

from __future__ import annotations

import os
import time
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path


def gone(pids: Iterable[int], seconds: float) -> bool:
    """Wait for all of these processes to end."""
    left, deadline = set(pids), time.monotonic() + seconds
    while left and time.monotonic() < deadline:
        left = {pid for pid in left if _lives(pid)}
        time.sleep(0.05)
    return not left


def _lives(pid: int) -> bool:
    """Whether it is there, and not only its entry, which waits for its parent to look at it."""
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state not in "ZX"


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


def processes_with(folder: Path) -> dict[int, bytes]:
    """Command lines of all processes whose environment names ``folder``; also of orphans."""
    found: dict[int, bytes] = {}
    for entry in Path("/proc").glob("[0-9]*/environ"):
        with suppress(OSError):
            if os.fsencode(folder) in entry.read_bytes():
                found[int(entry.parent.name)] = (entry.parent / "cmdline").read_bytes()
    return found


def workers_of(root: int) -> list[int]:
    """Workers that descend from ``root``."""
    return [pid for pid, words in processes_below(root).items() if b"lampblack\0serve" in words]
