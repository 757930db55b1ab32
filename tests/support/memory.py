"""The memory that a piece of work takes at its peak."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def little_memory(most: int = 100 << 20) -> Iterator[None]:
    """What is refused is refused with little memory, that of C libraries too."""
    Path("/proc/self/clear_refs").write_text("5", encoding="ascii")  # the peak starts anew
    before = _memory("VmRSS")
    yield
    assert _memory("VmHWM") - before < most


def _memory(name: str) -> int:
    """Bytes of resident memory of this process: now, or at the most."""
    lines = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    return next(int(line.split()[1]) << 10 for line in lines if line.startswith(name))
