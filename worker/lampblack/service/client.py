"""A client of the worker, for tests and benchmarks, and as an example."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
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
from .keys import KeyPair

Kind = TypeVar("Kind", bound=Message)
NamedLayers = Sequence[tuple[str, Pixels]]


class Client:
    """A connection to a worker, used by one thread. Use as a context manager.

    It keeps the drawings that it announced, and answers need_frame itself.

    Args:
        endpoint: address from the connection file, or of a worker that listens.
        keys: of this client, and ``worker_key`` the public key of the worker, if it listens.
    """

    def __init__(
        self, endpoint: str, keys: KeyPair | None = None, worker_key: bytes | None = None
    ) -> None:
        self._context: zmq.Context[zmq.Socket[bytes]] = zmq.Context()
        self.socket = self._context.socket(zmq.DEALER)
        self.socket.setsockopt(zmq.LINGER, 0)
        self.socket.setsockopt(zmq.RCVHWM, 4)
        self.socket.setsockopt(zmq.MAXMSGSIZE, LIMITS.plane_bytes)
        if keys is not None and worker_key is not None:
            self.socket.curve_publickey, self.socket.curve_secretkey = keys.public, keys.secret
            self.socket.curve_serverkey = worker_key
        self.socket.connect(endpoint)
        self.welcome: Welcome | None = None
        self.revision = 0
        self.request = 0
        self.seen: list[Message] = []
        self._drawings: dict[str, tuple[dict[Role, Pixels], NamedLayers]] = {}
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

    def send(
        self,
        message: Message,
        planes: Mapping[Role, Pixels] | None = None,
        layers: Sequence[Pixels] = (),
    ) -> None:
        """Send one message."""
        self.socket.send_multipart(encode(message, planes, layers))

    def receive(self, seconds: float) -> Received | None:
        """The next message; None if none arrives in time. need_frame is answered."""
        if not self.socket.poll(max(0, round(seconds * 1000))):
            return None
        received = decode(self.socket.recv_multipart(), "worker")
        message = received.message
        if isinstance(message, NeedFrame) and self._shown.get(message.frame) == message.digest:
            planes, layers = self._drawings[message.digest]
            names = tuple(name for name, _ in layers)
            put = PutFrame(frame=message.frame, digest=message.digest, layers=names)
            self.send(put, planes, [pixels for _, pixels in layers])
        if isinstance(message, Welcome):
            self.welcome = message
        self.seen.append(message)
        return received

    def wait_for(
        self, kind: type[Kind], seconds: float = 30, where: Callable[[Kind], bool] = lambda m: True
    ) -> tuple[Kind, dict[Role, Pixels]]:
        """The next message of a kind, and its planes; other messages are skipped.

        Raises:
            TimeoutError: none arrived in time.
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
        """Send hello and wait for welcome."""
        self.send(Hello(minor=MINOR, client="lampblack", client_version=__version__))
        return self.wait_for(Welcome, seconds)[0]

    def announce(
        self,
        frame: int,
        pixels: NDArray[np.uint8],
        layers: NamedLayers = (),
        **more: NDArray[np.uint8],
    ) -> str:
        """Announce that ``frame`` shows a drawing, (H, W, 4) uint8; planes are sent on request.
        ``layers`` are its layers, bottom first, each as large as the drawing."""
        planes: dict[Role, Pixels] = {"pixels": pixels}
        planes |= {role: more[role] for role in ("mask", "ink") if role in more}
        digest = frame_digest(planes, layers)
        self._drawings[digest], self._shown[frame] = (planes, layers), digest
        self.send(PutFrame(frame=frame, digest=digest))
        return digest

    def set_scene(self, scene: Scene) -> int:
        """Replace the scene. Returns its revision."""
        self.revision += 1
        self.send(SetScene(revision=self.revision, scene=scene))
        return self.revision

    def next_request(self) -> int:
        """A new request number."""
        self.request += 1
        return self.request

    def look(
        self, frame: int, size: tuple[int, int], crop: tuple[float, float, float, float]
    ) -> int:
        """Set the viewport to a crop of a frame, at ``size`` device pixels. Returns the request's
        number."""
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
        """The next matching image and its picture, (H, W, 4) uint8 premultiplied."""
        image, planes = self.wait_for(Image, seconds, where)
        return image, planes["picture"]


class Worker:
    """A worker in its own process. Use as a context manager.

    Args:
        folder: folder for its connection file.
        parent: process ID; the worker ends when this process ends.
        environment: additional environment variables.
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
        """Its connection, when it is ready.

        Raises:
            LampblackError: the worker ended, or is not ready in time.
        """
        until = time.monotonic() + seconds
        while time.monotonic() < until and self.process.poll() is None:
            try:
                return read_connection(self.connection).endpoint
            except (OSError, msgspec.DecodeError):
                time.sleep(0.02)
        raise LampblackError("The worker did not get ready.", details=f"{self.process.poll()}")

    def connect(self) -> Client:
        """A new client, before hello."""
        return Client(self.endpoint())
