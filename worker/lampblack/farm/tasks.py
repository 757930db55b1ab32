"""A shot cut into tasks."""

from __future__ import annotations

from collections.abc import Sequence

from ..errors import LampblackError
from ..shot import ShotFrame, by_drawing

MAX_TASKS = 1024
"""As many as an OpenJD task parameter may have values."""


def cut_into_tasks(frames: Sequence[ShotFrame], size: int) -> list[list[int]]:
    """Frame numbers by task: ``size`` frames or more, all that share a drawing together.

    Raises:
        LampblackError: frames without a number, which no task could name.
    """
    if any(frame.number is None for frame in frames):
        raise LampblackError(
            "Some of the drawings have no number.", "Name them like walk.0001.png."
        )
    size = max(size, -(-len(frames) // MAX_TASKS))
    tasks: list[list[int]] = []
    for group in by_drawing(frames):
        if not tasks or len(tasks[-1]) >= size:
            tasks.append([])
        tasks[-1] += [frame.number for frame in group if frame.number is not None]
    return [sorted(task) for task in tasks]
