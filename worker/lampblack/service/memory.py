"""Memory of the worker and its child processes."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path


def resident_bytes(children: Iterable[int | None] = ()) -> int:
    """Resident memory in bytes of this process and ``children``, where the system reports it."""
    total = 0
    for pid in (os.getpid(), *children):
        try:
            pages = Path(f"/proc/{pid}/statm").read_text().split()[1] if pid else "0"
        except (OSError, IndexError):
            continue
        total += int(pages) * os.sysconf("SC_PAGE_SIZE")
    return total
