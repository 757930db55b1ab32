"""The owner of the sockets: takes messages in, hands work out, sends what is ready."""

from __future__ import annotations

import os
import queue
import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import msgspec
import zmq

from ..cache import ArrayCache
from ..drawing import Palette
from ..pipeline import Pipeline
from ..protocol import (
    LIMITS,
    Bye,
    ErrorCode,
    Image,
    NeedFrame,
    Pixels,
    ProtocolError,
    Role,
    Status,
    Swatch,
    answer_to,
    decode,
    encode,
    error_message,
)
from ..protocol import Palette as PaletteMessage
from ..protocol.fields import Message
from .bounded import BoundedStore
from .handlers import handle
from .job import NICENESS, Jobs
from .memory import resident_bytes
from .modeller import Modeller
from .painter import Painter
from .session import Session
from .snapshot import Snapshot
from .source import LOW, sources_of
from .studio import MIB, Studio
from .tracer import Tracer

HIGH_WATER = 4
DRAIN = 64
"""Messages taken in before anything else is looked after."""
STATUS_SECONDS = 1.0
RETRY_SECONDS = 0.02
MAX_ASKED = 2
"""Drawings asked of a client at once, for frames that it does not look at."""

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
    _palettes: BoundedStore[str, Palette] = field(default_factory=lambda: BoundedStore(MIB))
    _notices: BoundedStore[str, list[str]] = field(default_factory=lambda: BoundedStore(MIB))
    _dirty: bool = False
    _told: tuple[object, ...] = ()
    _next_status: float = 0.0

    def __post_init__(self) -> None:
        self._wake = os.eventfd(0, os.EFD_NONBLOCK | os.EFD_CLOEXEC)
        self._began = time.monotonic()
        self.studio = Studio(self._deliver)
        self.painter = Painter(self.studio)
        self.tracer = Tracer(self.studio, self.painter)
        self.jobs = Jobs(self.studio, Pipeline(self.cache, niceness=NICENESS), self._need_later)
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
                if self._dirty:
                    self._refresh()
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
        self.changed()

    def changed(self) -> None:
        """Something that a client set is another."""
        self._dirty = True

    def _refresh(self) -> None:
        """Tell the other threads what is wanted now."""
        self._dirty = False
        wanted = {}
        ahead: list[Snapshot] = []
        models: list[tuple[str, str]] = []
        later: list[tuple[str, str]] = []
        for session in self.sessions.values():
            snapshot = session.snapshot()
            if snapshot is not None:
                wanted[session.name] = snapshot
                models += [(snapshot.digest, "coarse"), (snapshot.digest, "fine")]
                self._need(session, snapshot.digest)
                self._tell_of_drawing(session, snapshot)
            for _, frame in session.palettes:
                digest = session.frames[frame].digest
                models.append((digest, "fine"))
                self._need(session, digest)
            nearest = self._nearest(session)
            ahead += nearest
            later += [(snapshot.digest, "fine") for snapshot in nearest]
        # A fine model makes the coarse one needless.
        orders = [
            o for o in models if not (o[1] == "coarse" and (o[0], "fine") in self.studio.models)
        ]
        before = self.studio.wanted
        fresh = [s for name, s in wanted.items() if before.get(name) != s]
        self.studio.update(
            wanted=wanted,
            ahead=tuple(ahead),
            models_wanted=tuple(dict.fromkeys(orders + later)),
            changed=time.monotonic() if fresh else self.studio.changed,
        )
        for snapshot in wanted.values():
            self.painter.offer(snapshot)
        for session in self.sessions.values():
            self._answer_palettes(session)

    def _nearest(self, session: Session) -> list[Snapshot]:
        """Frames ahead, as many as there is room for; those not held are asked for."""
        snapshot = session.snapshot()
        if snapshot is None or snapshot.look.show != "lit":
            return []
        model = self.studio.models.get((snapshot.digest, "fine"))
        if model is None:
            return []
        room = int(0.7 * self.studio.models.max_bytes / model.nbytes / max(1, len(self.sessions)))
        nearest = [s for s, _ in zip(session.ahead(), range(room), strict=False)]
        for ahead in nearest:
            if len(session.asked) >= MAX_ASKED:
                break
            if (ahead.digest, "fine") not in self.studio.models:
                self._need(session, ahead.digest)
        return nearest

    def _need(self, session: Session, digest: str) -> None:
        """Ask for a drawing that is not held, once."""
        held = digest in self.studio.planes or (digest, "fine") in self.studio.models
        if held or digest in session.asked or digest in self.studio.failed:
            return
        frame = session.frame_showing(digest)
        if frame is not None:
            session.asked.add(digest)
            self.send(session, NeedFrame(frame=frame, digest=digest))

    def _need_later(self, name: str, digest: str) -> None:
        """Ask for a drawing that a job needs; for other threads."""

        def ask() -> None:
            for session in self.sessions.values():
                if session.name == name and digest not in self.studio.planes:
                    frame = session.frame_showing(digest)
                    if frame is not None:
                        self.send(session, NeedFrame(frame=frame, digest=digest))

        self.post(ask)

    def _drawing_done(self, digest: str, palette: Palette | None, noticed: list[str]) -> None:
        """The modeller got on with a drawing."""

        def note() -> None:
            if palette is not None:
                self._palettes.put(digest, palette, 64 * len(palette.swatches) + 64)
                self._notices.put(digest, noticed, 1000)
            self.changed()

        self.post(note)

    def _tell_of_drawing(self, session: Session, snapshot: Snapshot) -> None:
        """Tell, once, what is wrong with the drawing that is looked at."""
        frame, digest = snapshot.look.frame, snapshot.digest
        if digest in session.told:
            return
        failure = self.studio.failed.get(digest)
        notices = self._notices.get(digest)
        if failure is None and notices is None:
            return
        session.told.add(digest)
        if failure is not None:
            self.send(session, failed_frame(failure, frame))
        for sentence in notices or []:
            self.send(session, error_message(ErrorCode.DRAWING_WARNING, what=sentence, frame=frame))

    def _answer_palettes(self, session: Session) -> None:
        waiting, session.palettes = session.palettes, []
        for request, frame in waiting:
            digest = session.frames[frame].digest
            palette, failure = self._palettes.get(digest), self.studio.failed.get(digest)
            if failure is not None:
                self.send(session, failed_frame(failure, frame, request))
            elif palette is None:
                model = self.studio.models.get((digest, "fine"))
                palette = None if model is None else model.sheet.palette
            if palette is not None:
                swatches = tuple(Swatch(colour=s.colour, pixels=s.pixels) for s in palette.swatches)
                self.send(
                    session,
                    PaletteMessage(request=request, frame=frame, digest=digest, swatches=swatches),
                )
            elif failure is None:
                session.palettes.append((request, frame))

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
            digests = {shown.digest for shown in session.frames.values()}
            held = {d for d in digests if d in self.studio.planes or self.studio.model(d)}
            self.send(
                session,
                Status(
                    uptime_ms=int((now - self._began) * 1000),
                    revision=session.revision,
                    preview=self.studio.preview_state,
                    job=self.studio.job_state,
                    jobs_waiting=self.jobs.waiting,
                    frames_held=sum(s.digest in held for s in session.frames.values()),
                    frames_lit=self._frames_lit(session),
                    memory_bytes=memory,
                ),
            )

    def _frames_lit(self, session: Session) -> int:
        """Frames that can be shown at once, at low quality or better."""
        snapshot = session.snapshot()
        lit = set()
        for seen in [*([snapshot] if snapshot else []), *session.ahead()]:
            model = self.studio.models.get((seen.digest, "fine"))
            if model is not None and all(
                self.studio.lights.rung(source) >= LOW for source in sources_of(seen, model)
            ):
                lit.add(seen.digest)
        return sum(shown.digest in lit for shown in session.frames.values())


def failed_frame(message: Message, frame: int, request: int | None = None) -> Message:
    """An error about a drawing, told of a frame that shows it."""
    return msgspec.structs.replace(message, frame=frame, request=request)


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
