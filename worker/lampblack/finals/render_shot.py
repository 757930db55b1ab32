"""Rendering the frames of a shot into files. Each distinct drawing is lit once.

Three stages overlap: the next drawing is prepared, the current one is traced, and the previous one
is composited and written.
"""

from __future__ import annotations

import warnings
from collections import Counter
from collections.abc import Callable, Generator, Sequence
from contextlib import closing
from dataclasses import dataclass, field

from ..choices import DeviceKind
from ..errors import LampblackError, LampblackWarning, OutputError, RenderError
from ..pipeline import Pipeline
from ..shot import ShotFrame
from .frame_files import LitCel, copy_frame, save_frame
from .prefetch import prefetch
from .resolve import ResolvedJob
from .targets import device_stamp
from .tasks import Blank, Failed, Ready, RenderTask, StampedFrame, Traced, UpToDate, plan

ATTEMPTS = 3
"""Attempts to trace a drawing before its frames fail, because the renderer may crash."""
OVERLAP_PX = 4_000_000
"""The stages of larger drawings do not overlap, to limit memory."""


@dataclass
class Outcome:
    """The result of every frame.

    Attributes:
        done: frames whose file exists. kept: those whose file existed before.
        unlit: blank frames, written as drawn. failed: frames with their errors.
        devices: number of lit frames by the device that traced them.
    """

    done: list[ShotFrame] = field(default_factory=list)
    kept: list[ShotFrame] = field(default_factory=list)
    unlit: list[ShotFrame] = field(default_factory=list)
    failed: list[tuple[ShotFrame, LampblackError]] = field(default_factory=list)
    devices: Counter[DeviceKind] = field(default_factory=Counter)


class RenderListener:
    """Receives the events of a job. An exception from a method ends the job. By default it does
    nothing.

    ``on_progress`` and ``on_renderer_lost`` may be called from the tracing thread, the others from
    the caller's.
    """

    def on_frame(self, frame: ShotFrame, error: LampblackError | None, *, kept: bool) -> None:
        """The file of ``frame`` exists (``kept``: it existed before), or the frame failed."""

    def on_blank(self, frame: ShotFrame, reason: LampblackError) -> None:
        """``frame`` is blank, and is written as drawn."""
        words = f"{frame.name}: {reason.what} Passed through unlit."
        warnings.warn(words, LampblackWarning, stacklevel=2)

    def on_warning(self, frame: ShotFrame, sentence: str) -> None:
        """There was a warning while the drawing of ``frame`` was prepared."""

    def on_progress(self, frame: ShotFrame, share: float) -> None:
        """``share``, 0 to 1, of ``frame`` is done."""

    def on_renderer_lost(self, frame: ShotFrame, error: RenderError) -> None:
        """The renderer crashed; the drawing of ``frame`` is traced again."""


def render_shot(
    job: ResolvedJob,
    pipeline: Pipeline,
    frames: Sequence[ShotFrame] | None = None,
    listener: RenderListener | None = None,
    check: Callable[[], None] = lambda: None,
) -> Outcome:
    """Render ``frames`` (None: all of the job) into their files.

    A frame is kept if its file was made from the same drawing, neighbours and scene, so a job that
    was stopped continues. A frame that fails is reported, and the job continues. If nothing can be
    written, all remaining frames fail. ``pipeline`` is used from other threads until this returns.

    Args:
        check: called often, from any thread of the job; an exception from it ends the job.

    Raises:
        RenderError: the job names a device that ``pipeline`` cannot use.
    """
    if job.device != "auto":
        pipeline.renderer.require_device()
    wanted = job.frames if frames is None else frames
    run = _Run(job, pipeline, listener or RenderListener(), check)
    tasks = plan(job, pipeline, wanted, run.check)
    if _overlapping(job, wanted):
        traced = prefetch(run.traced(prefetch(tasks)), run.stop)
    else:
        traced = run.traced(tasks)
    with closing(traced):
        for task in traced:
            run.finish(task)
    return run.outcome


def _overlapping(job: ResolvedJob, wanted: Sequence[ShotFrame]) -> bool:
    if job.shot.canvas is not None:
        return job.shot.canvas.width * job.shot.canvas.height <= OVERLAP_PX
    try:
        return job.shot.cel(wanted[0]).pixels[..., 0].size <= OVERLAP_PX if wanted else False
    except LampblackError:
        return True  # reported when its turn comes


class _Stopped(Exception):
    """Ends the threads of an interrupted job."""


@dataclass
class _Run:
    job: ResolvedJob
    pipeline: Pipeline
    listener: RenderListener
    caller_check: Callable[[], None]
    outcome: Outcome = field(default_factory=Outcome)
    full: OutputError | None = None
    stopped: bool = False

    def stop(self) -> None:
        """End the threads and the current render."""
        self.stopped = True
        self.pipeline.interrupt()

    def check(self) -> None:
        """Raise an exception if the job is to end."""
        self.caller_check()
        if self.stopped:
            raise _Stopped

    def traced(
        self, tasks: Generator[RenderTask, None, None]
    ) -> Generator[UpToDate | Failed | Blank | Traced, None, None]:
        """Trace ``tasks``, one after another."""
        with closing(tasks):
            for task in tasks:
                yield self._trace(task) if isinstance(task, Ready) else task

    def _trace(self, task: Ready) -> Traced | Failed:
        frame, _ = task.frames[0]
        self.listener.on_progress(frame, 0.3)
        for attempt in range(1, ATTEMPTS + 1):
            self.check()
            if self.full is not None:
                return Failed(task.frames, self.full)
            try:
                passes = self.pipeline.light(
                    task.prepared, task.scene, task.surface, mixed=task.mixed
                )
                return Traced(task, passes)
            except RenderError as error:
                self.check()
                if attempt == ATTEMPTS:
                    return Failed(task.frames, error)
                if attempt == 1:
                    self.listener.on_renderer_lost(frame, error)
        raise AssertionError

    def finish(self, task: UpToDate | Failed | Blank | Traced) -> None:
        """Writes lit frames and reports their results."""
        match task:
            case UpToDate(frame, device):
                self.outcome.devices[device] += 1
                self.outcome.done.append(frame)
                self.outcome.kept.append(frame)
                self.listener.on_frame(frame, None, kept=True)
            case Failed(frames, error):
                for frame, _ in frames:
                    self._fail(frame, error)
            case Blank(frames, pixels, reason):
                for frame in self._write(frames, lambda: LitCel.blank(pixels, self.job.targets)):
                    if not frame.blank:
                        self.outcome.unlit.append(frame)
                        self.listener.on_blank(frame, reason)
                    self.listener.on_frame(frame, None, kept=False)
            case Traced(ready, passes):
                first, _ = ready.frames[0]
                for sentence in ready.warnings:
                    self.listener.on_warning(first, sentence)
                stamped = [(f, device_stamp(stamp, passes.device)) for f, stamp in ready.frames]
                for frame in self._write(stamped, lambda: LitCel.of(task, self.job.targets)):
                    self.outcome.devices[passes.device] += 1
                    self.listener.on_frame(frame, None, kept=False)

    def _write(
        self,
        frames: Sequence[StampedFrame],
        lit: Callable[[], LitCel],
    ) -> Generator[ShotFrame, None, None]:
        """Write the frames of one lit cel; yields those whose files exist."""
        made: LitCel | None = None
        written: dict[str, ShotFrame] = {}
        for frame, stamp in frames:
            self.listener.on_progress(frame, 0.9)
            try:
                if self.full is not None:
                    raise self.full
                if stamp in written:
                    copy_frame(written[stamp], frame, self.job.targets)
                else:
                    made = lit() if made is None else made
                    save_frame(self.job.shot, frame, made, self.job.targets, stamp)
                    written[stamp] = frame
            except LampblackError as error:
                if isinstance(error, OutputError):
                    self.full = error
                self._fail(frame, error)
            else:
                self.outcome.done.append(frame)
                yield frame

    def _fail(self, frame: ShotFrame, error: LampblackError) -> None:
        self.outcome.failed.append((frame, error))
        self.listener.on_frame(frame, error, kept=False)
