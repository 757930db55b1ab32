"""A clock of the day that jumps, for programs that a test starts."""

from __future__ import annotations

import struct
import subprocess
from pathlib import Path


class JumpingClock:
    """Programs with ``environment`` have the time of day of this clock.

    Args:
        folder: where what it needs is built.
    """

    def __init__(self, folder: Path) -> None:
        self._offset, library = folder / "clock-offset", folder / "clock.so"
        self.jump(0)
        source = Path(__file__).with_suffix(".c")
        subprocess.run(
            ["cc", "-shared", "-fPIC", "-Wall", "-Werror", "-o", library, source, "-ldl"],
            check=True,
        )
        self.environment = {"LD_PRELOAD": str(library), "CLOCK_OFFSET": str(self._offset)}

    def jump(self, seconds: int) -> None:
        """Be ``seconds`` away from the time of this machine. Programs that run see it at once."""
        with self._offset.open("r+b" if self._offset.exists() else "wb") as file:
            file.write(struct.pack("q", seconds))
