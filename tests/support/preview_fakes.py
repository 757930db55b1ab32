"""A service without socket, renderer, network or threads: each part does one step when asked."""

from __future__ import annotations

import time
from collections import defaultdict, deque
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lampblack.cache import ArrayCache
from lampblack.normals.prediction import Prediction
from lampblack.pipeline import Pipeline
from lampblack.protocol import (
    MINOR,
    Crop,
    ErrorMessage,
    Hello,
    Image,
    Message,
    NeedFrame,
    Preview,
    PutFrame,
    Received,
    SetScene,
    decode,
    frame_digest,
)
from lampblack.render.passes import LightPasses, Passes
from lampblack.render.request import RenderRequest, Surface
from lampblack.render.wire import Accumulate
from lampblack.scene import Scene
from lampblack.service.handlers import handle
from lampblack.service.service import Service

Floats = NDArray[np.float32]

PAUSE = 0.2
"""Longer than the stillness after which light is refined."""


class FakeRenderer:
    """White light everywhere, of the brightness ``level``, and half of it on the floor where the
    character stands. ``jobs`` are all it was asked to gather for previews, the last on ``surface``;
    ``before`` sees each first, and may raise. So does ``before_frame`` with the frames of finals.
    """

    def __init__(self) -> None:
        self.level = 1.0
        self.jobs: list[Accumulate] = []
        self.surface: Surface | None = None
        self.before: Callable[[Accumulate], None] = lambda job: None
        self.before_frame: Callable[[RenderRequest], None] = lambda request: None
        self.starts = 0
        self.killed = False
        self.alive = True
        self.pid = None
        self.card = ""

    def start(self) -> None:
        self.starts += not self.alive
        self.alive = True

    def accumulate(self, surface: Surface, job: Accumulate) -> tuple[Floats, ...]:
        self.before(job)
        self.jobs.append(job)
        self.surface = surface
        width, height = job.size
        light = np.full((height, width, 3), self.level, np.float32)
        first = light if job.subject == "character" else light / 2
        return (first, light) if job.resolve else ()

    def render(self, request: RenderRequest) -> Passes:
        self.before_frame(request)
        light = LightPasses(*(np.full((1, 1, 3), self.level, np.float32) for _ in range(2)))
        return Passes((light,) * len(request.lights), light)

    def kill(self) -> None:
        self.alive, self.killed = False, True

    def close(self) -> None:
        self.alive = False


class FakePredictor:
    """Sees every drawing flat. ``faults`` are raised by its next predictions."""

    identity = "flat"

    def __init__(self) -> None:
        self.faults: list[Exception] = []

    def predict(self, lines: Floats, mask: NDArray[np.bool_], **_: object) -> Prediction:
        if self.faults:
            raise self.faults.pop(0)
        flat = np.dstack([np.zeros((*mask.shape, 2)), mask]).astype(np.float32)
        return Prediction(flat)


class FakeTransport:
    """Keeps what is sent, decoded as a client decodes it."""

    def __init__(self) -> None:
        self.sent: dict[bytes, list[Received]] = defaultdict(list)
        self.events: deque[Callable[[], None]] = deque()

    def put(self, identity: bytes, frames: Any, *, picture: bool = False) -> None:
        self.sent[identity].append(decode([bytes(frame) for frame in frames], "worker"))

    def try_to_send(self, identity: bytes, frames: Any) -> bool:
        self.put(identity, frames)
        return True

    def forget(self, identity: bytes) -> None:
        """What was sent stays."""

    def post(self, event: Callable[[], None]) -> None:
        self.events.append(event)


class Stage:
    """A service of fakes, and the hands of its clients.

    Args:
        folder: for the cache.
        clock: None is one that stands still but for ``settle``.
    """

    def __init__(self, folder: Path, clock: Callable[[], float] | None = None) -> None:
        self.renderer, self.predictor = FakeRenderer(), FakePredictor()
        self.transport = FakeTransport()
        self.now = 1000.0
        previews, jobs = (Pipeline(ArrayCache(folder), predictor=self.predictor) for _ in range(2))
        self.service = Service(
            self.transport, self.renderer, previews, jobs, clock or (lambda: self.now)
        )
        self._drawings: dict[str, tuple[NDArray[np.uint8], Any]] = {}
        self._numbers: dict[bytes, int] = defaultdict(int)

    def handle(self, client: bytes, message: Message, **planes: NDArray[np.uint8]) -> None:
        handle(self.service, client, Received(message, planes))  # type: ignore[arg-type]

    def greet(self, client: bytes) -> None:
        self.handle(client, Hello(minor=MINOR, client="test", client_version="1"))

    def announce(
        self,
        client: bytes,
        frame: int,
        picture: NDArray[np.uint8],
        layers: Sequence[tuple[str, NDArray[np.uint8]]] = (),
    ) -> str:
        digest = frame_digest({"pixels": picture}, layers)
        self._drawings[digest] = picture, layers
        self.handle(client, PutFrame(frame=frame, digest=digest))
        return digest

    def set_scene(self, client: bytes, scene: Scene) -> int:
        revision = self.next_request(client)
        self.handle(client, SetScene(revision=revision, scene=scene))
        return revision

    def look(self, client: bytes, frame: int, size: int) -> int:
        request = self.next_request(client)
        crop = Crop(x=0, y=0, width=size, height=size)
        self.handle(
            client, Preview(request=request, frame=frame, crop=crop, width=size, height=size)
        )
        return request

    def step_service(self) -> bool:
        """Let the service do what its own thread does; False if nothing had come."""
        events = self.transport.events
        came = bool(events)
        while events:
            events.popleft()()
        self._answer_needs()
        self.service.turn()
        return came

    def step(self) -> bool:
        """Let each part do one thing; False if none had anything to do."""
        preview = self.service.preview
        worked = [self.step_service()]
        worked += [part.step() for part in (preview.preparer, preview.tracer, preview.painter)]
        return any(worked) or bool(self.transport.events)

    def settle(self) -> None:
        """Go on until nothing is left to do, now and after a pause."""
        for _ in range(2):
            for _ in range(1000):
                if not self.step():
                    break
            else:
                raise AssertionError("the service does not come to rest")
            self.now += PAUSE

    def images(self, client: bytes) -> list[Image]:
        return [m.message for m in self.transport.sent[client] if isinstance(m.message, Image)]

    def picture(self, client: bytes) -> NDArray[np.uint8]:
        """The latest."""
        *_, last = (m for m in self.transport.sent[client] if isinstance(m.message, Image))
        return last.planes["picture"]

    def errors(self, client: bytes) -> list[str]:
        sent = (received.message for received in self.transport.sent[client])
        return [message.code for message in sent if isinstance(message, ErrorMessage)]

    def wait_for(self, client: bytes, kind: type[Message]) -> Received:
        """The next message of this kind, which is taken out; also one from another thread."""
        for _ in range(600):
            self.settle()
            for received in self.transport.sent[client]:
                if isinstance(received.message, kind):
                    self.transport.sent[client].remove(received)
                    return received
            time.sleep(0.05)
        raise AssertionError(f"no {kind.__name__} came")

    def next_request(self, client: bytes) -> int:
        self._numbers[client] += 1
        return self._numbers[client]

    def _answer_needs(self) -> None:
        for client, sent in self.transport.sent.items():
            for received in list(sent):
                need = received.message
                if isinstance(need, NeedFrame):
                    sent.remove(received)
                    picture, layers = self._drawings[need.digest]
                    names = tuple(name for name, _ in layers)
                    answer = PutFrame(frame=need.frame, digest=need.digest, layers=names)
                    pixels = tuple(pixels for _, pixels in layers)
                    handle(self.service, client, Received(answer, {"pixels": picture}, pixels))
