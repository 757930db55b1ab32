"""The contact sheet of a rendered shot."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..drawing import load_picture, save_picture
from ..drawing.contact_sheet import contact_sheet
from ..shot import ShotFrame
from .resolve import ResolvedJob


def save_contact_sheet(path: Path, job: ResolvedJob, done: Sequence[ShotFrame]) -> None:
    """Write a picture with the drawings above and the lit frames below: at most 12 of the frames
    ``done``, at even distances. A single frame is next to its drawing. Without frames, nothing is
    written.

    Raises:
        OutputError: it cannot be written.
    """
    written = set(done)
    frames = [frame for frame in job.frames if frame in written]
    if not frames:
        return

    def drawn(frame: ShotFrame) -> NDArray[np.uint8]:
        return job.shot.finish(frame, job.shot.cel(frame).pixels)

    def lit(frame: ShotFrame) -> NDArray[np.uint8]:
        return load_picture(job.targets.path(frame))

    if len(frames) == 1:
        save_picture(path, contact_sheet([[drawn(frames[0]), lit(frames[0])]], cell=560))
        return
    chosen = [frames[i] for i in np.unique(np.linspace(0, len(frames) - 1, 12).round().astype(int))]
    rows = [chosen[i : i + 6] for i in range(0, len(chosen), 6)]
    save_picture(
        path, contact_sheet([[make(f) for f in row] for row in rows for make in (drawn, lit)])
    )
