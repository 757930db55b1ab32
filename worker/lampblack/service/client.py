"""A client of the worker: what tests and benchmarks drive it with, and an example of one."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from types import TracebackType
from typing import Self, TypeVar

import msgspec
import numpy as np
import zmq
from numpy.typing import NDArray

from .. import __version__
from ..errors import LampblackError
from ..protocol import (
    LIMITS,
    MINOR,
    Crop,
    Hello,
    Image,
    NeedFrame,
    Pixels,
    Preview,
    PutFrame,
    Received,
    Role,
    SetScene,
    Welcome,
    decode,
    encode,
    frame_digest,
)
from ..protocol.fields import Message
from ..scene import Scene
from .endpoint import read_connection

Kind = TypeVar("Kind", bound=Message)


class Client:
    """One connection to a worker; of one thread. Use as a context manager.

    It holds the drawings it announced, and answers need_frame by itself.

    Args:
        endpoint: from the connection file.
    """

    def __init__(self, endpoint: str) -> None:
        self._context: zmq.Context[zmq.Socket[bytes]] = zmq.Context()
        self.socket = self._context.socket(zmq.DEALER)
        self.socket.setsockopt(zmq.LINGER, 0)
        self.socket.setsockopt(zmq.RCVHWM, 4)
        self.socket.setsockopt(zmq.MAXMSGSIZE, LIMITS.plane_bytes)
        self.socket.connect(endpoint)
        self.welcome: Welcome | None = None
        self.revision = 0
        self.request = 0
        self.seen: list[Message] = []
        self._drawings: dict[str, dict[Role, Pixels]] = {}
        self._shown: dict[int, str] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.socket.close(0)
        self._context.term()

    def send(self, message: Message, planes: Mapping[Role, Pixels] | None = None) -> None:
        """Send one message."""
        self.socket.send_multipart(encode(message, planes))

    def receive(self, seconds: float) -> Received | None:
        """The next message, None if none comes in time; need_frame is answered on the way."""
        if not self.socket.poll(max(0, round(seconds * 1000))):
            return None
        received = decode(self.socket.recv_multipart(), "worker")
        message = received.message
        if isinstance(message, NeedFrame) and self._shown.get(message.frame) == message.digest:
            planes = self._drawings[message.digest]
            self.send(PutFrame(frame=message.frame, digest=message.digest), planes)
        if isinstance(message, Welcome):
            self.welcome = message
        self.seen.append(message)
        return received

    def wait_for(
        self, kind: type[Kind], seconds: float = 30, where: Callable[[Kind], bool] = lambda m: True
    ) -> tuple[Kind, dict[Role, Pixels]]:
        """The next message of a kind, and its planes; others are passed over.

        Raises:
            TimeoutError: none came in time.
        """
        until = time.monotonic() + seconds
        while (left := until - time.monotonic()) > 0:
            received = self.receive(left)
            if received is None or not isinstance(received.message, kind):
                continue
            if where(received.message):
                return received.message, received.planes
        raise TimeoutError(f"no {kind.__name__} within {seconds} s; seen: {self.seen[-5:]}")

    def hello(self, seconds: float = 30) -> Welcome:
        """Greet the worker."""
        self.send(Hello(minor=MINOR, client="lampblack", client_version=__version__))
        return self.wait_for(Welcome, seconds)[0]

    def announce(self, frame: int, pixels: NDArray[np.uint8], **more: NDArray[np.uint8]) -> str:
        """Say that ``frame`` shows a drawing, (H, W, 4) uint8; its planes go when asked for."""
        planes: dict[Role, Pixels] = {"pixels": pixels}
        planes |= {role: more[role] for role in ("mask", "ink") if role in more}
        digest = frame_digest(planes)
        self._drawings[digest], self._shown[frame] = planes, digest
        self.send(PutFrame(frame=frame, digest=digest))
        return digest

    def set_scene(self, scene: Scene) -> int:
        """Replace the scene; its revision."""
        self.revision += 1
        self.send(SetScene(revision=self.revision, scene=scene))
        return self.revision

    def next_request(self) -> int:
        """A request number of its own."""
        self.request += 1
        return self.request

    def look(
        self, frame: int, size: tuple[int, int], crop: tuple[float, float, float, float]
    ) -> int:
        """Look at a crop of a frame, at ``size`` device pixels; the request's number."""
        x, y, width, height = crop
        request = self.next_request()
        self.send(
            Preview(
                request=request,
                frame=frame,
                crop=Crop(x=x, y=y, width=width, height=height),
                width=size[0],
                height=size[1],
            )
        )
        return request

    def picture(
        self, seconds: float = 30, where: Callable[[Image], bool] = lambda image: True
    ) -> tuple[Image, Pixels]:
        """The next picture that fits, (H, W, 4) uint8 premultiplied."""
        image, planes = self.wait_for(Image, seconds, where)
        return image, planes["picture"]


class Worker:
    """A worker in a process of its own. Use as a context manager.

    Args:
        folder: for its connection file.
        parent: it leaves when this process does.
        environment: variables of its own.
    """

    def __init__(
        self,
        folder: Path,
        parent: int | None = None,
        environment: Mapping[str, str] | None = None,
    ) -> None:
        self.connection = folder.absolute() / "connection.json"
        command = [
            sys.executable, "-I", "-m", "lampblack", "serve", "--connection", str(self.connection)
        ]  # fmt: skip
        if parent is not None:
            command += ["--parent-pid", str(parent)]
        self.process = subprocess.Popen(
            command, cwd=os.sep, env={**os.environ, **(environment or {})}
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.process.terminate()
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()

    def endpoint(self, seconds: float = 60) -> str:
        """Where it is to be found, once it is ready.

        Raises:
            LampblackError: it ended, or is not ready in time.
        """
        until = time.monotonic() + seconds
        while time.monotonic() < until and self.process.poll() is None:
            try:
                return read_connection(self.connection).endpoint
            except (OSError, msgspec.DecodeError):
                time.sleep(0.02)
        raise LampblackError("The worker did not get ready.", details=f"{self.process.poll()}")

    def connect(self) -> Client:
        """A client that has not said hello yet."""
        return Client(self.endpoint())
