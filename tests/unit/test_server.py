"""The worker's loop through its real socket, with a fake renderer and a fake network."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest
import zmq

from lampblack.protocol import Bye, ErrorMessage
from lampblack.scene import default_scene
from lampblack.service.client import Client
from lampblack.service.handlers import MAX_CLIENTS
from lampblack.service.server import Server
from lampblack.service.service import Service
from lampblack.service.socket import RouterSocket
from support.drawings import draw_ball
from support.preview_fakes import FakePredictor, FakeRenderer, pipeline_with

SIZE = 64
WHOLE = (0.0, 0.0, float(SIZE), float(SIZE))


class Served:
    """A server in a thread of its own, until ``leave``."""

    def __init__(self, folder: Path) -> None:
        self.endpoint = f"ipc://{folder / 's'}"
        self.renderer = FakeRenderer()
        self._context: zmq.Context[zmq.Socket[bytes]] = zmq.Context()
        self._socket = RouterSocket(self._context, self.endpoint)
        previews, jobs = (pipeline_with(FakePredictor(), folder) for _ in range(2))
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


@pytest.fixture
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Served]:
    served = Served(tmp_path_factory.mktemp("w"))
    yield served
    served.close()


@pytest.fixture
def client(served: Served) -> Iterator[Client]:
    with Client(served.endpoint) as client:
        client.hello()
        yield client


def test_a_drawing_comes_back_lit_until_it_converges(client: Client) -> None:
    client.announce(1, draw_ball(SIZE))
    revision = client.set_scene(default_scene(SIZE, SIZE))
    request = client.look(1, (SIZE, SIZE), WHOLE)
    image, picture = client.picture(30, lambda image: image.converged)
    assert (image.request, image.revision) == (request, revision)
    assert picture.shape == (SIZE, SIZE, 4)
    assert picture[32, 32, 3] == 255


def test_nonsense_is_answered_and_the_next_message_served(client: Client) -> None:
    client.socket.send_multipart([b"nonsense"])
    assert client.wait_for(ErrorMessage)[0].code == "not_lampblack"
    client.hello()


def test_no_more_clients_than_there_is_room_for(served: Served, client: Client) -> None:
    with ExitStack() as stack:
        for _ in range(MAX_CLIENTS - 1):
            guest = stack.enter_context(Client(served.endpoint))
            guest.hello()
        late = stack.enter_context(Client(served.endpoint))
        with pytest.raises(TimeoutError):
            late.hello(0.2)
        assert isinstance(late.seen[0], ErrorMessage)
        assert late.seen[0].code == "too_many_clients"
        guest.send(Bye())
        until = time.monotonic() + 10
        while len(served.service.sessions) == MAX_CLIENTS:
            assert time.monotonic() < until
            time.sleep(0.01)
        late.hello()


def test_a_worker_that_leaves_says_goodbye_and_ends_its_renderer(
    served: Served, client: Client
) -> None:
    served.leave()
    client.wait_for(Bye)
    assert not served.renderer.alive
