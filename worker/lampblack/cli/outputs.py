"""Checks of output files, before any work is done."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from ..errors import LampblackError


def keep_inputs(output: Path, inputs: Iterable[str | Path | None]) -> None:
    """Refuse an output that would replace one of the inputs."""
    given = [Path(path) for path in inputs if path is not None]
    if output.exists() and any(path.exists() and path.samefile(output) for path in given):
        raise LampblackError(
            f"{output} is one of the inputs, and would be overwritten.", "Choose another."
        )


def check_suffix(path: Path, *suffixes: str) -> None:
    """Refuse an output whose file format is unknown."""
    if path.suffix.lower() not in suffixes:
        raise LampblackError(
            f"{path} is not of a file format that can be written here.",
            f"Known: {', '.join(suffixes)}.",
        )
