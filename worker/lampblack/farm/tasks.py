"""Dividing a shot into tasks."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from ..errors import LampblackError
from ..finals.settings import RenderSettings
from ..shot import ShotFrame, by_drawing

MAX_TASKS = 1024
"""The most values of an OpenJD task parameter."""


def on_one_device(settings: RenderSettings) -> RenderSettings:
    """The settings for tasks on several machines: without a named device all use the processor,
    so that one shot is not lit by several kinds."""
    return (
        msgspec.structs.replace(settings, device="cpu") if settings.device == "auto" else settings
    )


def cut_into_tasks(frames: Sequence[ShotFrame], size: int) -> list[list[int]]:
    """Frame numbers by task: at least ``size`` frames each; frames of one drawing are together.

    Raises:
        LampblackError: frames have no numbers.
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
