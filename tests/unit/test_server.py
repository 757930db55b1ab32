"""The worker's loop through its real socket, with a fake renderer and a fake network."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import ExitStack

import pytest

from lampblack.protocol import Bye, ErrorMessage, Status
from lampblack.scene import default_scene
from lampblack.service.client import Client
from lampblack.service.handlers import MAX_CLIENTS
from support.drawings import draw_ball
from support.served import Served

SIZE = 64
WHOLE = (0.0, 0.0, float(SIZE), float(SIZE))


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


def test_the_status_names_the_card_that_traces(served: Served, client: Client) -> None:
    assert client.wait_for(Status)[0].card == ""
    served.renderer.card = "Paper Card"
    client.wait_for(Status, 10, lambda status: status.card == "Paper Card")


def test_a_worker_that_leaves_says_goodbye_and_ends_its_renderer(
    served: Served, client: Client
) -> None:
    served.leave()
    client.wait_for(Bye)
    assert not served.renderer.alive
