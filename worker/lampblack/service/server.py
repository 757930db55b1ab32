"""The owner of the sockets: takes messages in, hands work out, sends what is ready."""

from __future__ import annotations

import os
import queue
import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import zmq

from ..cache import ArrayCache
from ..drawing import Palette
from ..pipeline import Pipeline
from ..protocol import (
    LIMITS,
    Bye,
    ErrorCode,
    Image,
    Pixels,
    ProtocolError,
    Role,
    Status,
    answer_to,
    decode,
    encode,
    error_message,
)
from ..protocol.fields import Message
from .handlers import handle
from .job import NICENESS, Jobs
from .memory import resident_bytes
from .modeller import Modeller
from .painter import Painter
from .planner import Planner
from .session import Session
from .studio import Studio
from .tracer import Tracer

HIGH_WATER = 4
DRAIN = 64
"""Messages taken in before anything else is looked after."""
STATUS_SECONDS = 1.0
RETRY_SECONDS = 0.02

Event = Callable[[], None]


@dataclass
class Server:
    """The worker behind one ROUTER socket. ``run`` owns the socket; all else is other threads'.

    Args:
        router: bound; closed by its owner.
        cache: of surfaces.
    """

    router: zmq.Socket[bytes]
    cache: ArrayCache
    sessions: dict[bytes, Session] = field(default_factory=dict)
    _events: queue.SimpleQueue[Event] = field(default_factory=queue.SimpleQueue)
    _told: tuple[object, ...] = ()
    _next_status: float = 0.0

    def __post_init__(self) -> None:
        self._wake = os.eventfd(0, os.EFD_NONBLOCK | os.EFD_CLOEXEC)
        self._began = time.monotonic()
        self.studio = Studio(self._deliver)
        self.painter = Painter(self.studio)
        self.planner = Planner(self.studio, self.painter, self.sessions, self.send)
        self.tracer = Tracer(self.studio, self.painter)
        self.jobs = Jobs(self.studio, Pipeline(self.cache, niceness=NICENESS), self._need)
        self.modeller = Modeller(self.studio, Pipeline(self.cache), self._drawing_done)
        self._threads = [
            threading.Thread(target=part.run, name=type(part).__name__, daemon=True)
            for part in (self.painter, self.tracer, self.jobs, self.modeller)
        ]

    def run(self, gone: Callable[[], bool] = lambda: False, watched: int | None = None) -> None:
        """Serve until ``gone`` says that there is nobody left to serve.

        Args:
            gone: asked at every tick.
            watched: a descriptor that becomes readable when ``gone`` may have changed.
        """
        for thread in self._threads:
            thread.start()
        poller = zmq.Poller()
        for thing in (self.router, self._wake, *([] if watched is None else [watched])):
            poller.register(thing, zmq.POLLIN)
        try:
            while not gone():
                ready = dict(poller.poll(self._patience()))
                if self._wake in ready:
                    os.eventfd_read(self._wake)
                if self.router in ready:
                    self._take_in()
                while not self._events.empty():
                    self._events.get()()
                self.planner.plan()
                self._tick()
                self._flush()
        finally:
            self._close()

    def _close(self) -> None:
        for session in list(self.sessions.values()):
            self.send(session, Bye(reason="The worker leaves."))
        self._flush()
        self.studio.update(closing=True)
        self.painter.close()
        self.jobs.close()
        self.tracer.child.kill()
        for thread in self._threads:
            thread.join(2)
        os.close(self._wake)

    def _patience(self) -> int:
        """Milliseconds until something is due."""
        due = max(0.0, self._next_status - time.monotonic())
        if any(session.outbox.first() for session in self.sessions.values()):
            due = min(due, RETRY_SECONDS)
        return int(due * 1000) + 1

    def _take_in(self) -> None:
        for _ in range(DRAIN):
            try:
                identity, *frames = self.router.recv_multipart(zmq.NOBLOCK)
            except zmq.Again:
                return
            try:
                self._receive(identity, frames)
            except Exception as error:  # whatever a message does, the others are served
                self.answer(identity, error_message(ErrorCode.INTERNAL, details=repr(error)))

    def _receive(self, identity: bytes, frames: list[bytes]) -> None:
        try:
            message, planes = decode(frames, "client")
        except ProtocolError as error:
            self.answer(identity, answer_to(error))
            return
        handle(self, identity, message, planes)

    def answer(self, identity: bytes, message: Message) -> None:
        """Answer a client, greeted or not."""
        session = self.sessions.get(identity)
        if session is not None:
            self.send(session, message)
        else:
            self._try_to_send(identity, encode(message))

    def _deliver(
        self, name: str, message: Message, planes: Mapping[Role, Pixels] | None = None
    ) -> None:
        """Send to the session ``name``; for other threads."""
        frames = encode(message, planes)
        picture = isinstance(message, Image)

        def put() -> None:
            for session in self.sessions.values():
                if session.name == name:
                    session.outbox.put(frames, picture=picture)

        self.post(put)

    def send(self, session: Session, message: Message) -> None:
        session.outbox.put(encode(message))

    def post(self, event: Event) -> None:
        """Have ``event`` happen in the owner's thread."""
        self._events.put(event)
        try:
            os.eventfd_write(self._wake, 1)
        except OSError:
            return  # the worker is closing

    def _flush(self) -> None:
        for session in list(self.sessions.values()):
            while (frames := session.outbox.first()) is not None:
                sent = self._try_to_send(session.identity, frames)
                if sent is None or session.outbox.overflows:
                    self.part_with(session)
                    break
                if not sent:
                    break
                session.outbox.sent()

    def _try_to_send(self, identity: bytes, frames: list[bytes | memoryview]) -> bool | None:
        """False if the client must read first, None if it is gone."""
        try:
            self.router.send_multipart([identity, *frames], zmq.NOBLOCK)
        except zmq.Again:
            return False
        except zmq.ZMQError as error:
            if error.errno == zmq.EHOSTUNREACH:
                return None
            raise
        return True

    def part_with(self, session: Session) -> None:
        """Let go of a client and of what it asked for."""
        self.sessions.pop(session.identity, None)
        self.jobs.cancel(session.name)
        self.painter.forget(session.name)
        self.planner.changed()

    def _need(self, name: str, digest: str) -> None:
        """Ask for a drawing that a job needs; for other threads."""

        def ask() -> None:
            for session in self.sessions.values():
                if session.name == name and digest not in self.studio.planes:
                    self.planner.ask(session, digest)

        self.post(ask)

    def _drawing_done(self, digest: str, palette: Palette | None, noticed: list[str]) -> None:
        """The modeller got on with a drawing; for other threads."""
        self.post(lambda: self.planner.note(digest, palette, noticed))

    def hurry_status(self) -> None:
        """Send the next tick at once."""
        self._next_status = 0.0

    def _tick(self) -> None:
        state = self.studio.preview_state, self.studio.job_state, self.jobs.waiting
        now = time.monotonic()
        if now < self._next_status and (state == self._told or now < self._next_status - 0.8):
            return
        self._told, self._next_status = state, now + STATUS_SECONDS
        memory = resident_bytes([self.tracer.child.pid, self.jobs.renderer_pid])
        for session in self.sessions.values():
            self.send(
                session,
                Status(
                    uptime_ms=int((now - self._began) * 1000),
                    revision=session.revision,
                    preview=self.studio.preview_state,
                    job=self.studio.job_state,
                    jobs_waiting=self.jobs.waiting,
                    frames_held=self.planner.frames_held(session),
                    frames_lit=self.planner.frames_lit(session),
                    memory_bytes=memory,
                ),
            )


def bind(context: zmq.Context[zmq.Socket[bytes]], endpoint: str) -> zmq.Socket[bytes]:
    """The worker's socket, within its limits."""
    router = context.socket(zmq.ROUTER)
    router.setsockopt(zmq.LINGER, 0)
    router.setsockopt(zmq.ROUTER_MANDATORY, 1)
    router.setsockopt(zmq.SNDHWM, HIGH_WATER)
    router.setsockopt(zmq.RCVHWM, HIGH_WATER)
    router.setsockopt(zmq.MAXMSGSIZE, LIMITS.plane_bytes)
    router.bind(endpoint)
    return router
