"""The service of a worker: sessions, preview and render jobs, without the socket."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import Protocol

from ..drawing import Palette
from ..lasting import join_all, lasting_thread
from ..pipeline import Pipeline
from ..preview import LivePreview, PreviewImage, PreviewRenderer
from ..protocol import (
    Bye,
    Crop,
    ErrorCode,
    Image,
    Pixels,
    Role,
    Status,
    encode,
    error_message,
)
from ..protocol.fields import Message
from .faults import fault_message
from .jobs import Jobs
from .memory import resident_bytes
from .outbox import Frames
from .planner import Planner
from .rig_sketches import RigSketches
from .session import Session

STATUS_SECONDS = 1.0
SOON_SECONDS = 0.2
"""After the last status, if a state has changed."""
END_SECONDS = 1.0
"""Seconds that all threads together get to end."""


class Transport(Protocol):
    """Sends messages to clients; see ``RouterSocket``."""

    def put(self, identity: bytes, frames: Frames, *, picture: bool = False) -> None: ...

    def try_to_send(self, identity: bytes, frames: Frames) -> bool | None: ...

    def forget(self, identity: bytes) -> None: ...

    def post(self, event: Callable[[], None]) -> None: ...


class Service:
    """Everything that clients share. Only the thread that owns the transport may call its methods,
    except ``deliver``, ``request_planes``, ``tell_slow`` and those of ``PreviewListener``.

    Args:
        renderer, pipeline: for previews.
        job_pipeline: for render jobs, and closed with them.
        for_others: clients are on other machines.
        clock: monotonic seconds.
    """

    def __init__(
        self,
        transport: Transport,
        renderer: PreviewRenderer,
        pipeline: Pipeline,
        job_pipeline: Pipeline,
        clock: Callable[[], float] = time.monotonic,
        *,
        for_others: bool = False,
    ) -> None:
        self.sessions: dict[bytes, Session] = {}
        self.preview = LivePreview(renderer, pipeline, self, clock)
        self.sketches = RigSketches(self.deliver)
        self.planner = Planner(
            self.preview.state, self.preview.painter, self.sessions, self.send, self.sketches.ask
        )
        self.jobs = Jobs(
            self.preview.state, job_pipeline, self.request_planes, self.deliver, for_others
        )
        self._transport = transport
        self._clock = clock
        self._began = clock()
        self._next_status = 0.0
        self._states: tuple[object, ...] = ()
        self._job_thread = lasting_thread("Jobs", self.jobs.run, self._report_to_all)

    def start(self) -> None:
        """Start all threads."""
        self.preview.start()
        self._job_thread.start()

    def close(self) -> None:
        """End all renderers and threads; a thread that computes is not waited for."""
        self.jobs.close()
        self.sketches.stop()
        self.preview.stop()
        join_all([*self.preview.threads, self._job_thread], END_SECONDS)

    def turn(self) -> None:
        """Plan after changes, and send the status when it is due."""
        self.planner.plan()
        self._send_status()

    @property
    def patience(self) -> float:
        """Seconds until the next status is due."""
        return max(0.0, self._status_due - self._clock())

    def send(self, session: Session, message: Message) -> None:
        """Queue a message for a session."""
        self._transport.put(session.identity, encode(message))

    def answer(self, identity: bytes, message: Message) -> None:
        """Answer a client, with or without a session."""
        if identity in self.sessions:
            self._transport.put(identity, encode(message))
        else:
            self._transport.try_to_send(identity, encode(message))

    def deliver(
        self, name: str, message: Message, planes: Mapping[Role, Pixels] | None = None
    ) -> None:
        """Send to the session ``name``; any thread may call this."""
        frames = encode(message, planes)
        picture = isinstance(message, Image)

        def put() -> None:
            for session in self.sessions.values():
                if session.name == name:
                    self._transport.put(session.identity, frames, picture=picture)

        self._transport.post(put)

    def request_planes(self, name: str, digest: str) -> None:
        """Request a drawing for a job from the session ``name``; any thread may call this."""

        def ask() -> None:
            for session in self.sessions.values():
                if session.name == name and digest not in self.preview.state.planes:
                    self.planner.ask(session, digest)

        self._transport.post(ask)

    def on_picture(self, image: PreviewImage) -> None:
        """Send a picture of the preview."""
        request, viewport = image.request, image.request.viewport
        x, y, width, height = viewport.crop
        message = Image(
            request=viewport.request,
            frame=viewport.frame,
            digest=request.digest,
            revision=request.revision,
            show=viewport.show,
            pass_=image.passes,
            spp=image.spp,
            converged=image.converged,
            crop=Crop(x=x, y=y, width=width, height=height),
        )
        self.deliver(request.session, message, {"picture": image.picture})

    def on_drawing(self, digest: str, palette: Palette | None, warnings: list[str]) -> None:
        """Handle a finished step of a drawing."""
        self._transport.post(lambda: self.planner.note(digest, palette, warnings))

    def on_preview_error(self, session: str, error: Exception) -> None:
        """Send an error of the preview."""
        self.deliver(session, fault_message(error))

    def on_renderer_ready(self) -> None:
        """Send the status soon."""
        self._transport.post(lambda: None)

    def tell_slow(self) -> None:
        """Tell all clients that a renderer hardly gets to work; any thread may call this."""
        self._tell_all(error_message(ErrorCode.RENDER_SLOW))

    def _report_to_all(self, error: Exception) -> None:
        self._tell_all(fault_message(error))

    def _tell_all(self, message: Message) -> None:
        for session in list(self.sessions.values()):
            self.deliver(session.name, message)

    def part_with(self, session: Session) -> None:
        """Drop a client with its requests."""
        self.sessions.pop(session.identity, None)
        self._transport.forget(session.identity)
        self.jobs.cancel(session.name)
        self.preview.painter.forget(session.name)
        self.planner.changed()

    def say_goodbye(self) -> None:
        """Send bye to every client."""
        for session in self.sessions.values():
            self.send(session, Bye(reason="The worker leaves."))

    def hurry_status(self) -> None:
        """Make the next status due at once."""
        self._next_status = 0.0

    @property
    def _current_states(self) -> tuple[object, ...]:
        card = self.preview.renderer.card[:64]
        return self.preview.state.renderer, self.jobs.state, self.jobs.waiting, card

    @property
    def _status_due(self) -> float:
        changed = self._current_states != self._states
        return self._next_status - (STATUS_SECONDS - SOON_SECONDS if changed else 0)

    def _send_status(self) -> None:
        now = self._clock()
        if now < self._status_due:
            return
        self._states, self._next_status = self._current_states, now + STATUS_SECONDS
        memory = resident_bytes([self.preview.renderer.pid, self.jobs.renderer_pid])
        for session in self.sessions.values():
            status = Status(
                uptime_ms=int((now - self._began) * 1000),
                revision=session.revision,
                preview=self.preview.state.renderer,
                job=self.jobs.state,
                jobs_waiting=self.jobs.waiting,
                frames_held=self.planner.frames_held(session),
                frames_lit=self.planner.frames_lit(session),
                memory_bytes=memory,
                card=self.preview.renderer.card[:64],
            )
            self.send(session, status)
