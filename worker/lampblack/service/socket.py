"""The worker's ROUTER socket: receives and sends messages, and takes events from other threads."""

from __future__ import annotations

import queue
import socket
from collections.abc import Callable, Iterator
from contextlib import suppress

import zmq

from ..protocol import LIMITS
from .keys import KeyPair
from .outbox import Frames, Outbox

HIGH_WATER = 4
DRAIN = 64
"""Most messages received in one iteration."""
RETRY_SECONDS = 0.02
WAKING_BYTES = 4096

Event = Callable[[], None]


class RouterSocket:
    """One thread owns the socket; any thread may ``post``.

    Args:
        context: ZeroMQ context.
        endpoint: address to bind to.
        keys: talk by CURVE, with these keys.

    Raises:
        zmq.ZMQError: it cannot be bound to.
    """

    def __init__(
        self,
        context: zmq.Context[zmq.Socket[bytes]],
        endpoint: str,
        keys: KeyPair | None = None,
    ) -> None:
        self._router = context.socket(zmq.ROUTER)
        if keys is not None:
            self._router.curve_publickey, self._router.curve_secretkey = keys.public, keys.secret
            self._router.curve_server = True
        self._router.setsockopt(zmq.LINGER, 0)
        self._router.setsockopt(zmq.ROUTER_MANDATORY, 1)
        self._router.setsockopt(zmq.SNDHWM, HIGH_WATER)
        self._router.setsockopt(zmq.RCVHWM, HIGH_WATER)
        self._router.setsockopt(zmq.MAXMSGSIZE, LIMITS.plane_bytes)
        try:
            self._router.bind(endpoint)
        except zmq.ZMQError:
            self._router.close(0)  # the context would wait for it at its end
            raise
        # A pair of sockets, because every system has them, and can wait for them.
        self._wake, self._waker = socket.socketpair()
        for end in (self._wake, self._waker):
            end.setblocking(False)
        self._events: queue.SimpleQueue[Event] = queue.SimpleQueue()
        self._outboxes: dict[bytes, Outbox] = {}

    def close(self) -> None:
        """Close the socket; unsent messages are lost."""
        self._router.close(0)
        self._waker.close()
        self._wake.close()

    def post(self, event: Event) -> None:
        """Run ``event`` in the owner's thread; any thread may call this."""
        self._events.put(event)
        with suppress(OSError):  # it is full, and so wakes the owner; or the worker is closing
            self._waker.send(b"!")

    def wait(self, seconds: float, watched: int | None = None) -> None:
        """Wait for a message, an event, ``watched`` to become readable, or ``seconds``; shorter if
        sending to a client must be retried."""
        poller = zmq.Poller()
        for thing in (self._router, self._wake, *([] if watched is None else [watched])):
            poller.register(thing, zmq.POLLIN)
        if any(outbox.first() for outbox in self._outboxes.values()):
            seconds = min(seconds, RETRY_SECONDS)
        poller.poll(int(max(0.0, seconds) * 1000) + 1)
        with suppress(BlockingIOError):
            self._wake.recv(WAKING_BYTES)

    def messages(self) -> Iterator[tuple[bytes, list[bytes]]]:
        """Some of the received messages, each with the identity of its sender."""
        for _ in range(DRAIN):
            try:
                identity, *frames = self._router.recv_multipart(zmq.NOBLOCK)
            except zmq.Again:
                return
            yield identity, frames

    def events(self) -> Iterator[Event]:
        """The events that other threads have posted."""
        while not self._events.empty():
            yield self._events.get()

    def put(self, identity: bytes, frames: Frames, *, picture: bool = False) -> None:
        """Queue a message. A picture replaces an unsent picture."""
        self._outboxes.setdefault(identity, Outbox()).put(frames, picture=picture)

    def forget(self, identity: bytes) -> None:
        """Drop all messages queued for a client."""
        self._outboxes.pop(identity, None)

    def flush(self) -> list[bytes]:
        """Send messages. Returns the clients that have gone or do not read."""
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
        """Send without the queue; False if the client must read first, None if it has gone."""
        try:
            self._router.send_multipart([identity, *frames], zmq.NOBLOCK)
        except zmq.Again:
            return False
        except zmq.ZMQError as error:
            if error.errno == zmq.EHOSTUNREACH:
                return None
            raise
        return True
