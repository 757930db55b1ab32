"""Render jobs: a thread and a renderer of their own, at low priority."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

from ..camera import scene_in_view
from ..drawing import DrawingPlanes, load_picture, save_picture
from ..errors import (
    LampblackError,
    NothingDrawnError,
    OutputError,
    RenderError,
    RenderRestartedError,
)
from ..normals.temporal.neighbours import NeighbourKeys
from ..pipeline import Pipeline
from ..preview import PreviewState, RendererState
from ..protocol import Done, ErrorCode, FrameDone, Progress, error_message
from ..protocol.fields import Message
from ..render import RenderChild
from ..scene import Scene
from ..timeline import scene_at
from ..warning_collector import collect_warnings
from .faults import fault_message
from .session import FrameContent
from .surroundings import Surroundings

NICENESS = 10
MAX_WAITING = 16
PLANES_SECONDS = 20.0
"""How long a client may take to send a drawing that a job needs."""
ATTEMPTS = 3


class _Cancelled(Exception):
    """The job was cancelled."""


@dataclass
class Job:
    """Frames to be written, as they were when the job was asked for.

    Attributes:
        output: a pattern with ``%04d`` for the frame's number.
        around: by digest, the drawings before and after it in the animation.
    """

    session: str
    request: int
    frames: list[tuple[int, FrameContent]]
    scene: Scene
    output: str
    keep_finished: bool
    around: dict[str, NeighbourKeys] = field(default_factory=dict)
    cancelled: bool = False
    done: int = 0
    failed: int = 0

    def path(self, frame: int) -> Path:
        """The file of a frame."""
        return Path(self.output % frame)


@dataclass
class Jobs:
    """Works off jobs one after another.

    Args:
        previews: their planes are used too.
        need: asks the client of a session for the planes of a drawing.
        deliver: sends a message to a session.

    Attributes:
        state: what the renderer of jobs does.
    """

    previews: PreviewState
    pipeline: Pipeline
    need: Callable[[str, str], None]
    deliver: Callable[[str, Message], None]
    state: RendererState = "off"
    _waiting: deque[Job] = field(default_factory=deque)
    _current: Job | None = None
    _condition: threading.Condition = field(default_factory=threading.Condition)

    def __post_init__(self) -> None:
        self._surroundings = Surroundings(self.pipeline)

    @property
    def waiting(self) -> int:
        """Jobs not yet begun."""
        return len(self._waiting)

    def submit(self, job: Job) -> bool:
        """Queue a job; False if too many wait."""
        with self._condition:
            if len(self._waiting) >= MAX_WAITING:
                return False
            self._waiting.append(job)
            self._condition.notify()
        return True

    def cancel(self, session: str, request: int | None = None) -> None:
        """End a job of the session, or all of them."""
        with self._condition:
            for job in [*self._waiting, *([self._current] if self._current else [])]:
                if job.session == session and request in (None, job.request):
                    job.cancelled = True
            if self._current and self._current.cancelled:
                self.pipeline.interrupt()
            self._condition.notify()

    def close(self) -> None:
        """Drop everything; the thread ends with the previews."""
        with self._condition:
            for job in [*self._waiting, *([self._current] if self._current else [])]:
                job.cancelled = True
            self.pipeline.interrupt()
            self._condition.notify()

    @property
    def renderer_pid(self) -> int | None:
        """Process of the renderer, None while there is none."""
        child: RenderChild | None = self.pipeline.__dict__.get("child")
        return None if child is None else child.pid

    def run(self) -> None:
        """Work until the previews close."""
        while True:
            with self._condition:
                self._condition.wait_for(lambda: self._waiting or self.previews.closing)
                if self.previews.closing:
                    break
                job = self._current = self._waiting.popleft()
            self.state = "working"
            self._work(job)
            with self._condition:
                self._current = None
            if not self._waiting:
                self.pipeline.rest()  # a renderer of finals holds much memory
            self.state = "off" if self.pipeline.child.pid is None else "idle"
        self.pipeline.__exit__(None, None, None)

    def _work(self, job: Job) -> None:
        outcome = "finished"
        try:
            for frame, shown in job.frames:
                self._frame(job, frame, shown)
        except _Cancelled:
            outcome = "cancelled"
        except OutputError as error:
            self._report(job, error)
            outcome = "failed"
        self.deliver(
            job.session,
            Done(
                request=job.request,
                outcome=outcome,  # type: ignore[arg-type]
                frames_done=job.done,
                frames_total=len(job.frames),
                frames_failed=job.failed,
            ),
        )

    def _frame(self, job: Job, frame: int, shown: FrameContent) -> None:
        """Make one frame, or tell why not.

        Raises:
            OutputError: it cannot be written. _Cancelled: the job was cancelled.
        """
        target = job.path(frame)
        self._progress(job, frame, 0.0)
        if job.keep_finished and _is_whole(target):
            self._frame_done(job, frame, target, kept=True)
            return
        try:
            planes = self._planes(job, shown.digest)
            with collect_warnings() as warnings:
                try:
                    self._light(job, frame, shown, planes, target)
                except NothingDrawnError as error:
                    self._report(job, error, frame)
                    self._save(target, planes)
            for sentence in warnings:
                code = ErrorCode.DRAWING_WARNING
                message = error_message(code, what=sentence, request=job.request, frame=frame)
                self.deliver(job.session, message)
        except (OutputError, _Cancelled):
            raise
        except Exception as error:  # one frame's trouble must not end the job
            job.failed += 1
            self._report(job, error, frame)
        else:
            self._frame_done(job, frame, target, kept=False)

    def _light(
        self, job: Job, frame: int, shown: FrameContent, planes: DrawingPlanes, target: Path
    ) -> None:
        drawing = planes.decompose()
        scene = scene_in_view(scene_at(job.scene, frame), shown.camera, drawing.size)
        neighbours = self._surroundings.neighbours(
            job.around.get(shown.digest, ((), ())), lambda digest: self._planes(job, digest)
        )
        self.pipeline.height(
            drawing, lambda share: self._progress(job, frame, 0.3 * share), neighbours
        )
        for attempt in range(ATTEMPTS):
            self._progress(job, frame, 0.3)
            try:
                picture = self.pipeline.render(drawing, scene, neighbours)
                break
            except RenderError as error:
                self._check(job)
                if attempt == ATTEMPTS - 1:
                    raise
                self.state = "restarting"
                if attempt == 0:
                    restarted = RenderRestartedError(error.what, error.remedy, error.details)
                    self._report(job, restarted, frame)
        self.state = "working"
        self._progress(job, frame, 0.99)
        _make_folder(target.parent)
        save_picture(target, picture)

    def _save(self, target: Path, planes: DrawingPlanes) -> None:
        _make_folder(target.parent)
        save_picture(target, planes.pixels)

    def _planes(self, job: Job, digest: str) -> DrawingPlanes:
        """The drawing's planes, asked for if they are not held."""
        planes = self.previews.planes.get(digest)
        if planes is None:
            self.need(job.session, digest)
            with self.previews.condition:
                self.previews.condition.wait_for(
                    lambda: digest in self.previews.planes or job.cancelled, PLANES_SECONDS
                )
            self._check(job)
            planes = self.previews.planes.get(digest)
        if planes is None:
            raise LampblackError("The drawing was not sent.", "Render the frame again.")
        return planes

    def _check(self, job: Job) -> None:
        if job.cancelled:
            raise _Cancelled

    def _progress(self, job: Job, frame: int, share: float) -> None:
        self._check(job)
        message = Progress(
            request=job.request,
            frame=frame,
            share=share,
            frames_done=job.done,
            frames_total=len(job.frames),
        )
        self.deliver(job.session, message)

    def _frame_done(self, job: Job, frame: int, path: Path, *, kept: bool) -> None:
        job.done += 1
        message = FrameDone(request=job.request, frame=frame, path=str(path), kept=kept)
        self.deliver(job.session, message)

    def _report(self, job: Job, error: Exception, frame: int | None = None) -> None:
        self.deliver(job.session, fault_message(error, request=job.request, frame=frame))


def job_scene(scene: Scene, quality: str) -> Scene:
    """The scene at the quality that a job asks for."""
    return replace(scene, quality=quality)  # type: ignore[arg-type]


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(
            f"The folder {folder} cannot be made.", "Choose another.", str(error)
        ) from error


def _is_whole(path: Path) -> bool:
    try:
        load_picture(path)
    except LampblackError:
        return False
    return True
