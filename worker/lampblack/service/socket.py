"""The worker's ROUTER socket: messages in, messages out, and events from other threads."""

from __future__ import annotations

import os
import queue
from collections.abc import Callable, Iterator

import zmq

from ..protocol import LIMITS
from .outbox import Frames, Outbox

HIGH_WATER = 4
DRAIN = 64
"""Messages taken in before anything else is looked after."""
RETRY_SECONDS = 0.02

Event = Callable[[], None]


class RouterSocket:
    """One thread owns it; any other may ``post``.

    Args:
        context: of the socket.
        endpoint: to bind to.
    """

    def __init__(self, context: zmq.Context[zmq.Socket[bytes]], endpoint: str) -> None:
        self._router = context.socket(zmq.ROUTER)
        self._router.setsockopt(zmq.LINGER, 0)
        self._router.setsockopt(zmq.ROUTER_MANDATORY, 1)
        self._router.setsockopt(zmq.SNDHWM, HIGH_WATER)
        self._router.setsockopt(zmq.RCVHWM, HIGH_WATER)
        self._router.setsockopt(zmq.MAXMSGSIZE, LIMITS.plane_bytes)
        self._router.bind(endpoint)
        self._wake = os.eventfd(0, os.EFD_NONBLOCK | os.EFD_CLOEXEC)
        self._events: queue.SimpleQueue[Event] = queue.SimpleQueue()
        self._outboxes: dict[bytes, Outbox] = {}

    def close(self) -> None:
        """Close the socket; what was not sent is lost."""
        self._router.close(0)
        os.close(self._wake)

    def post(self, event: Event) -> None:
        """Have ``event`` happen in the owner's thread; any thread may call this."""
        self._events.put(event)
        try:
            os.eventfd_write(self._wake, 1)
        except OSError:
            return  # the worker is closing

    def wait(self, seconds: float, watched: int | None = None) -> None:
        """Return when there is a message or an event, when ``watched`` becomes readable, or
        after ``seconds``; sooner if a client is to be tried again."""
        poller = zmq.Poller()
        for thing in (self._router, self._wake, *([] if watched is None else [watched])):
            poller.register(thing, zmq.POLLIN)
        if any(outbox.first() for outbox in self._outboxes.values()):
            seconds = min(seconds, RETRY_SECONDS)
        if self._wake in dict(poller.poll(int(max(0.0, seconds) * 1000) + 1)):
            os.eventfd_read(self._wake)

    def messages(self) -> Iterator[tuple[bytes, list[bytes]]]:
        """Some of the messages that have come, each with the identity of its sender."""
        for _ in range(DRAIN):
            try:
                identity, *frames = self._router.recv_multipart(zmq.NOBLOCK)
            except zmq.Again:
                return
            yield identity, frames

    def events(self) -> Iterator[Event]:
        """What other threads have posted."""
        while not self._events.empty():
            yield self._events.get()

    def put(self, identity: bytes, frames: Frames, *, picture: bool = False) -> None:
        """Queue a message; a picture takes the place of one that was not sent yet."""
        self._outboxes.setdefault(identity, Outbox()).put(frames, picture=picture)

    def forget(self, identity: bytes) -> None:
        """Drop what was queued for a client."""
        self._outboxes.pop(identity, None)

    def flush(self) -> list[bytes]:
        """Send what can be sent; the clients that are gone, or have not read for far too long."""
        return [
            identity
            for identity, outbox in self._outboxes.items()
            if not self._flush(identity, outbox)
        ]

    def _flush(self, identity: bytes, outbox: Outbox) -> bool:
        while (frames := outbox.first()) is not None:
            sent = self.try_to_send(identity, frames)
            if sent is None or outbox.overflows:
                return False
            if not sent:
                return True
            outbox.sent()
        return True

    def try_to_send(self, identity: bytes, frames: Frames) -> bool | None:
        """Send past the queue; False if the client must read first, None if it is gone."""
        try:
            self._router.send_multipart([identity, *frames], zmq.NOBLOCK)
        except zmq.Again:
            return False
        except zmq.ZMQError as error:
            if error.errno == zmq.EHOSTUNREACH:
                return None
            raise
        return True
