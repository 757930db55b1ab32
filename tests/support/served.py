"""A worker without renderer and network, served through a real socket."""

from __future__ import annotations

import threading
from pathlib import Path

import zmq

from lampblack.cache import ArrayCache
from lampblack.pipeline import Pipeline
from lampblack.service.server import Server
from lampblack.service.service import Service
from lampblack.service.socket import RouterSocket
from support.preview_fakes import FakePredictor, FakeRenderer


class Served:
    """A server in a thread of its own, until ``leave``."""

    def __init__(self, folder: Path) -> None:
        self.endpoint = f"ipc://{folder / 's'}"
        self.renderer, self.job_renderer = FakeRenderer(), FakeRenderer()
        self._context: zmq.Context[zmq.Socket[bytes]] = zmq.Context()
        self._socket = RouterSocket(self._context, self.endpoint)
        previews = Pipeline(ArrayCache(folder), predictor=FakePredictor())
        jobs = Pipeline(ArrayCache(folder), predictor=FakePredictor(), renderer=self.job_renderer)
        self.service = Service(self._socket, self.renderer, previews, jobs)
        self._gone = threading.Event()
        self._thread = threading.Thread(
            target=Server(self._socket, self.service).run, args=(self._gone.is_set,)
        )
        self._thread.start()

    def leave(self) -> None:
        self._gone.set()
        self._socket.post(lambda: None)
        self._thread.join(10)
        assert not self._thread.is_alive()

    def close(self) -> None:
        self.leave()
        self._socket.close()
        self._context.term()
