"""Light frames of a shot into files: each distinct drawing once, however often it is held.

Three things go on at once: the surface of the next drawing is made, the renderer traces this one,
and the last is composited and written.
"""

from __future__ import annotations

import shutil
import warnings
from collections.abc import Callable, Generator, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..atomic import atomic_path
from ..composite import composite
from ..errors import LampblackError, LampblackWarning, OutputError, RenderError
from ..pipeline import Pipeline
from ..shot import ShotFrame
from .ahead import ahead
from .exr import save_exr
from .layers import Layers, make_layers, seen_layers
from .png import save_png
from .resolve import ResolvedJob
from .work import Work, plan

ATTEMPTS = 2
"""Traces of one drawing before its frames have failed: a renderer may be lost."""
OVERLAP_PX = 4_000_000
"""Larger drawings are made one after another: several at once would take too much memory."""


@dataclass
class Outcome:
    """What became of the frames.

    Attributes:
        done: written, or there already. kept: those that were there.
        unlit: passed through, since nothing is drawn. failed: with the error of each.
    """

    done: list[ShotFrame] = field(default_factory=list)
    kept: list[ShotFrame] = field(default_factory=list)
    unlit: list[ShotFrame] = field(default_factory=list)
    failed: list[tuple[ShotFrame, LampblackError]] = field(default_factory=list)


Listener = Callable[[ShotFrame, LampblackError | None], None]
"""Told of each frame that is done, or failed with an error."""


def light_frames(
    order: ResolvedJob,
    pipeline: Pipeline,
    frames: Sequence[ShotFrame] | None = None,
    listener: Listener = lambda frame, error: None,
) -> Outcome:
    """Light ``frames`` (None: all of the job) into their files.

    A frame whose file was made from the same drawing, surroundings and scene is left alone, so
    a job that was stopped goes on where it was. A frame that fails is told and passed over;
    when nothing can be written, the rest fails too. ``pipeline`` is used from other threads
    until this returns.
    """
    wanted = order.frames if frames is None else frames
    job = _Job(order, pipeline, listener)
    works = plan(order, pipeline, wanted, job.check)
    if _overlapping(order, wanted):
        works = ahead(job.traced(ahead(works)), job.stop)
    else:
        works = job.traced(works)
    with closing(works):
        for work in works:
            job.finish(work)
    return job.outcome


def _overlapping(order: ResolvedJob, wanted: Sequence[ShotFrame]) -> bool:
    if order.shot.canvas is not None:
        return order.shot.canvas.width * order.shot.canvas.height <= OVERLAP_PX
    try:
        return order.shot.cel(wanted[0]).pixels[..., 0].size <= OVERLAP_PX if wanted else False
    except LampblackError:
        return True  # told when its turn comes


class _Stopped(Exception):
    """Ends the threads of a job that was interrupted."""


@dataclass
class _Job:
    order: ResolvedJob
    pipeline: Pipeline
    listener: Listener
    outcome: Outcome = field(default_factory=Outcome)
    full: OutputError | None = None
    stopped: bool = False

    def stop(self) -> None:
        """Nobody waits for the light any more."""
        self.stopped = True
        self.pipeline.interrupt()

    def check(self) -> None:
        """Raise if nobody waits any more."""
        if self.stopped:
            raise _Stopped

    def traced(self, works: Generator[Work, None, None]) -> Generator[Work, None, None]:
        """``works`` with their light."""
        with closing(works):
            for work in works:
                self._trace(work)
                yield work

    def _trace(self, work: Work) -> None:
        if work.model is None or work.scene is None:
            return
        drawing, surface = work.model.drawing, work.model.surface
        for _ in range(ATTEMPTS):
            if self.full is not None or self.stopped:
                return
            try:
                work.passes = self.pipeline.light(drawing, work.scene, surface=surface)
                work.error = None
                return
            except RenderError as error:
                work.error = error

    def finish(self, work: Work) -> None:
        """Write what was lit, and tell what became of each frame."""
        lit: NDArray[np.uint8] | Layers | None = None
        written: dict[str, Path] = {}
        for frame, stamp in work.frames:
            error = self.full or work.error
            try:
                if error is None and not work.kept:
                    target = self.order.targets.path(frame)
                    if stamp in written:
                        _copy(written[stamp], target)
                    else:
                        lit = self._lit(work) if lit is None else lit
                        self._write(frame, lit, stamp)
                        written[stamp] = target
            except LampblackError as fault:
                error = fault
                if isinstance(error, OutputError):
                    self.full = error
            self._tell(work, frame, error)

    def _tell(self, work: Work, frame: ShotFrame, error: LampblackError | None) -> None:
        if error is not None:
            self.outcome.failed.append((frame, error))
        else:
            self.outcome.done.append(frame)
            if work.kept:
                self.outcome.kept.append(frame)
            elif work.blank is not None:
                self.outcome.unlit.append(frame)
                words = f"{frame.name}: {work.blank} Passed through unlit."
                warnings.warn(words, LampblackWarning, stacklevel=2)
        self.listener(frame, error)

    def _lit(self, work: Work) -> NDArray[np.uint8] | Layers:
        """The cel, lit; as it is if nothing is drawn on it."""
        model = work.model
        if model is None:
            assert work.pixels is not None
            return work.pixels
        assert work.scene is not None
        assert work.passes is not None
        if self.order.targets.kind == "png":
            return composite(model.drawing, work.passes, work.scene)
        assert model.normals is not None
        assert model.height is not None
        return make_layers(model.drawing, work.scene, work.passes, model.normals, model.height)

    def _write(self, frame: ShotFrame, lit: NDArray[np.uint8] | Layers, stamp: str) -> None:
        shot, target = self.order.shot, self.order.targets.path(frame)
        if self.order.targets.kind == "exr":
            save_exr(target, seen_layers(shot, frame, lit), stamp)
        else:
            assert not isinstance(lit, Layers)
            save_png(target, shot.finish(frame, lit), stamp)


def _copy(source: Path, target: Path) -> None:
    """Frames that are made from the same are the same, to the last byte."""
    with atomic_path(target) as temporary:
        shutil.copyfile(source, temporary)
