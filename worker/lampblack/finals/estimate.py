"""What a shot will cost, from a few of its drawings that are lit for it.

The cost of a shot grows with its distinct drawings, and little with frames that repeat one. So some
consecutive drawings are lit, as the whole shot would be, and the times between them are counted.
Consecutive, because each drawing is steadied by its neighbours, whose normals are shared.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from msgspec import structs

from ..cache import ArrayCache
from ..errors import LampblackError
from ..pipeline import Pipeline
from ..shot import ShotFrame, by_drawing
from .render_shot import RenderListener, render_shot
from .resolve import resolve_job
from .settings import RenderSettings

SAMPLES = 4
"""Drawings that are lit for an estimate."""
REPEATED = 3
"""Frames of each that are lit: where lights move, a repeated drawing is traced again."""


@dataclass(frozen=True)
class Estimate:
    """The cost of a shot on this machine, nothing cached.

    Attributes:
        frames: of the shot. drawings: distinct ones among them.
        start: seconds to the first file.
        drawing: seconds for each further drawing. repeated: for each further frame of one.
        disk: bytes of all files.
    """

    frames: int
    drawings: int
    start: float
    drawing: float
    repeated: float
    disk: int

    def seconds(self, machines: int = 1) -> float:
        """Wall seconds until the last of so many like machines has finished its share."""
        frames, drawings = (-(-count // machines) for count in (self.frames, self.drawings))
        repeated = max(0, frames - drawings)
        return self.start + (drawings - 1) * self.drawing + repeated * self.repeated


def estimate(
    settings: RenderSettings, progress: Callable[[float], None] = lambda share: None
) -> Estimate:
    """Light a few frames of the shot into a temporary folder, and conclude from them.

    Args:
        settings: as for a render; its output is left alone.
        progress: receives the share of the work that is done, 0 to 1.

    Raises:
        LampblackError: the shot cannot be read, none of these frames can be lit, or the device
            that the settings name cannot be used.
    """
    with TemporaryDirectory() as folder:
        job = resolve_job(structs.replace(settings, output=f"{folder}/lit"))
        groups = by_drawing(job.frames)
        middle = max(0, (len(groups) - SAMPLES) // 2)
        sample = [frame for group in groups[middle:][:SAMPLES] for frame in group[:REPEATED]]
        clock = _Clock(len(sample), progress)
        with Pipeline(
            ArrayCache(Path(folder) / "cache"), job.options, device=job.device
        ) as pipeline:
            clock.start()
            outcome = render_shot(job, pipeline, sample, clock)
        if outcome.failed and not outcome.done:
            raise outcome.failed[0][1]
        if not outcome.done:
            raise LampblackError("This frame does not exist.", "See which ones the input has.")
        disk = sum(path.stat().st_size for path in Path(folder, "lit").rglob("*") if path.is_file())
    first, further, repeated = clock.means()
    size = round(disk / len(outcome.done) * len(job.frames))
    return Estimate(len(job.frames), len(groups), first, further, repeated, size)


class _Clock(RenderListener):
    """Notes when each frame was finished."""

    def __init__(self, frames: int, progress: Callable[[float], None]) -> None:
        self._frames, self._progress = frames, progress
        self._began = 0.0
        self._finished: list[tuple[str, float]] = []

    def start(self) -> None:
        self._began = time.perf_counter()

    def on_frame(self, frame: ShotFrame, error: LampblackError | None, *, kept: bool) -> None:
        self._finished.append((frame.drawing, time.perf_counter() - self._began))
        self._progress(len(self._finished) / self._frames)

    def means(self) -> tuple[float, float, float]:
        """Seconds to the first frame; of a further drawing; of a repeated frame."""
        first = self._finished[0][1]
        spent: dict[bool, list[float]] = {True: [], False: []}
        for (drawing, before), (name, now) in zip(self._finished, self._finished[1:], strict=False):
            spent[name != drawing].append(now - before)
        further, repeated = (_mean(spent[new]) for new in (True, False))
        return first, further, repeated


def _mean(seconds: Sequence[float]) -> float:
    return sum(seconds) / len(seconds) if seconds else 0.0
