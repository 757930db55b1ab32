"""Memory and processor time of processes."""

from __future__ import annotations

import os
import resource
from pathlib import Path


def peak_gib() -> float:
    """Upper bound on the peak memory in GiB: this process's peak plus the largest child's."""
    own = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    child = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
    return round((own + child) / 2**20, 2)


def processor_seconds(pid: int) -> float:
    """Processor seconds of a process and its living children, from ``/proc``."""
    tick = os.sysconf("SC_CLK_TCK")
    spent = 0
    for entry in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = entry.read_text().rpartition(")")[2].split()
        except OSError:
            continue  # it ended meanwhile
        if entry.parent.name == str(pid) or fields[1] == str(pid):
            spent += int(fields[11]) + int(fields[12])
    return spent / tick
