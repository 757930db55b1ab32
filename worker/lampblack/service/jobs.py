"""Render jobs: a queue, and a thread with its own renderer."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from ..drawing import DrawingPlanes
from ..errors import (
    DrawingError,
    LampblackError,
    OutputError,
    RenderError,
    RenderRestartedError,
)
from ..finals.render_shot import RenderListener, render_shot
from ..finals.resolve import ResolvedJob, resolve_job
from ..finals.scene_overrides import SceneOverrides
from ..finals.settings import RenderSettings
from ..finals.targets import Targets
from ..normals.temporal.neighbours import REACH
from ..pipeline import Pipeline
from ..preview import PreviewState, RendererState
from ..protocol import Done, ErrorCode, FrameDone, Progress, Render, error_message
from ..protocol.fields import Message
from ..scene import Scene
from ..shot import ShotFrame
from .faults import fault_message
from .session import FrameContent
from .session_shot import SessionShot

NICENESS = 10
MAX_WAITING = 16
PLANES_SECONDS = 20.0
"""Seconds that a client may take to send a drawing for a job."""


class _Cancelled(Exception):
    """The job was cancelled."""


@dataclass
class Job:
    """A render message, with the scene and the frames at the time of the message."""

    session: str
    message: Render
    scene: Scene
    contents: Mapping[int, FrameContent]
    frames: list[int]
    cancelled: bool = False
    done: int = 0
    failed: int = 0


@dataclass
class Jobs:
    """Renders jobs one after another.

    Args:
        previews: state of the preview, whose planes are used too.
        need: requests the planes of a drawing from the client of a session.
        deliver: sends a message to a session.
        for_others: clients are on other machines: nothing is written into folders that are not
            there, because what the client made a folder for is then not seen here.

    Attributes:
        state: state of the renderer of jobs.
    """

    previews: PreviewState
    pipeline: Pipeline
    need: Callable[[str, str], None]
    deliver: Callable[[str, Message], None]
    for_others: bool = False
    state: RendererState = "off"
    _waiting: deque[Job] = field(default_factory=deque)
    _current: Job | None = None
    _condition: threading.Condition = field(default_factory=threading.Condition)
    _closing: bool = False

    @property
    def waiting(self) -> int:
        """Number of jobs that have not begun."""
        return len(self._waiting)

    @property
    def renderer_pid(self) -> int | None:
        """Process ID of the renderer; None if it does not run."""
        return self.pipeline.renderer.pid

    def submit(self, job: Job) -> bool:
        """Queue a job; False if too many jobs wait."""
        with self._condition:
            if len(self._waiting) >= MAX_WAITING:
                return False
            self._waiting.append(job)
            self._condition.notify()
        return True

    def cancel(self, session: str, request: int | None = None) -> None:
        """Cancel a job of the session, or all of them."""
        self._cancel(lambda job: job.session == session and request in (None, job.message.request))

    def close(self) -> None:
        """Drop all jobs, and end the thread."""
        self._closing = True
        self._cancel(lambda job: True)

    def _cancel(self, which: Callable[[Job], bool]) -> None:
        with self._condition:
            for job in [*self._waiting, *([self._current] if self._current else [])]:
                job.cancelled = job.cancelled or which(job)
            if self._current and self._current.cancelled:
                self.pipeline.interrupt()
            self._condition.notify()
        with self.previews.condition:
            self.previews.condition.notify_all()  # a job that waits for planes

    def run(self) -> None:
        """Render jobs until closed."""
        while True:
            with self._condition:
                self._condition.wait_for(lambda: self._waiting or self._closing)
                if self._closing:
                    break
                job = self._current = self._waiting.popleft()
            self.state = "working"
            self._work(job)
            with self._condition:
                self._current = None
            if not self._waiting:
                self.pipeline.close()  # a renderer of finals takes much memory
            self.state = "off" if self.renderer_pid is None else "idle"
        self.pipeline.close()

    def _work(self, job: Job) -> None:
        def check() -> None:
            if job.cancelled:
                raise _Cancelled

        outcome = "finished"
        try:
            check()
            render_shot(self._resolve(job), self.pipeline, None, _Reporter(self, job), check)
        except _Cancelled:
            outcome = "cancelled"
        except Exception as error:  # an error of one job must not end the thread
            self.report(job, error)
            outcome = "failed"
        self.deliver(
            job.session,
            Done(
                request=job.message.request,
                outcome=outcome,  # type: ignore[arg-type]
                frames_done=job.done,
                frames_total=len(job.frames),
                frames_failed=job.failed,
            ),
        )

    def _resolve(self, job: Job) -> ResolvedJob:
        """Raises OutputError: files cannot be written there. LampblackError: the project cannot be
        read."""
        message = job.message
        folder = Path(message.output).parent
        if self.for_others and not folder.is_dir():
            raise OutputError(
                f"The computer that renders does not see the folder {folder}.",
                "Save the project in a folder that both computers see under the same name. "
                "Or render on your own computer.",
            )
        if message.project:
            settings = RenderSettings(
                inputs=(message.project,),
                output=message.output,
                quality=message.quality,
                frames=message.frames,
                layers="lit",
                apart=message.apart,
                again=not message.keep_finished,
            )
            resolved = resolve_job(settings, job.scene)
            job.frames = [frame.number for frame in resolved.frames if frame.number is not None]
            return resolved
        shot = SessionShot(
            job.contents,
            job.scene.canvas,
            message.output,
            lambda digest: self._planes(job, digest),
        )
        wanted = set(job.frames)
        frames = [frame for frame in shot.frames if frame.number in wanted]
        try:
            targets = Targets(message.output, apart=message.apart)
            targets.prepare(frames, [])
        except LampblackError as error:
            raise OutputError(error.what, error.remedy, error.details) from error
        return ResolvedJob(
            shot=shot,
            frames=frames,
            overrides=SceneOverrides(job.scene, quality=message.quality),
            sources=[],
            single=False,
            reach=REACH,
            targets=targets,
            options=self.pipeline.surfaces.options,
            device="auto",
            again=not message.keep_finished,
        )

    def _planes(self, job: Job, digest: str) -> DrawingPlanes:
        """The drawing's planes, requested from the client if they are not stored."""
        planes = self.previews.planes.get(digest)
        if planes is None:
            self.need(job.session, digest)
            with self.previews.condition:
                self.previews.condition.wait_for(
                    lambda: digest in self.previews.planes or job.cancelled, PLANES_SECONDS
                )
            planes = self.previews.planes.get(digest)
        if job.cancelled:
            raise _Cancelled
        if planes is None:
            raise DrawingError("The drawing was not sent.", "Render the frame again.")
        return planes

    def report(self, job: Job, error: Exception, frame: int | None = None) -> None:
        """Send an error to the client."""
        self.deliver(job.session, fault_message(error, request=job.message.request, frame=frame))


@dataclass
class _Reporter(RenderListener):
    """Sends the events of a job to its client."""

    jobs: Jobs
    job: Job

    def on_frame(self, frame: ShotFrame, error: LampblackError | None, *, kept: bool) -> None:
        if isinstance(error, OutputError):
            raise error
        assert frame.number is not None
        self.jobs.state = "working"
        if error is not None:
            self.job.failed += 1
            self.jobs.report(self.job, error, frame.number)
            return
        self.job.done += 1
        message = self.job.message
        self.jobs.deliver(
            self.job.session,
            FrameDone(
                request=message.request,
                frame=frame.number,
                path=message.output % frame.number,
                kept=kept,
            ),
        )

    def on_blank(self, frame: ShotFrame, reason: LampblackError) -> None:
        self.jobs.report(self.job, reason, frame.number)

    def on_warning(self, frame: ShotFrame, sentence: str) -> None:
        message = error_message(
            ErrorCode.DRAWING_WARNING,
            what=sentence,
            request=self.job.message.request,
            frame=frame.number,
        )
        self.jobs.deliver(self.job.session, message)

    def on_progress(self, frame: ShotFrame, share: float) -> None:
        assert frame.number is not None
        message = Progress(
            request=self.job.message.request,
            frame=frame.number,
            share=share,
            frames_done=self.job.done,
            frames_total=len(self.job.frames),
        )
        self.jobs.deliver(self.job.session, message)

    def on_renderer_lost(self, frame: ShotFrame, error: RenderError) -> None:
        self.jobs.state = "restarting"
        restarted = RenderRestartedError(error.what, error.remedy, error.details)
        self.jobs.report(self.job, restarted, frame.number)
