"""A worker for other machines: encrypted, and only for those it admits."""

from __future__ import annotations

import socket
import stat
import threading
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import zmq
from zmq.utils.monitor import recv_monitor_message

from lampblack.errors import LampblackError, OutputError
from lampblack.render.client import RenderChild
from lampblack.service.client import Client
from lampblack.service.keys import KeyPair, make_keys, only_admitted, read_keys, read_public_key
from lampblack.service.serve import Listening, serve_forever
from lampblack.service.socket import RouterSocket
from support.command_line import Run

HELLO = b'{"lampblack":1,"type":"hello"}'
DRAWN = np.arange(64 * 64 * 4, dtype=np.uint8).reshape(64, 64, 4)
REFUSED = zmq.EVENT_HANDSHAKE_FAILED_AUTH | zmq.EVENT_HANDSHAKE_FAILED_NO_DETAIL
REFUSED |= zmq.EVENT_HANDSHAKE_FAILED_PROTOCOL


class Listener:
    """The socket of a worker that admits ``ana``."""

    def __init__(self, folder: Path) -> None:
        make_keys(folder, "studio")
        make_keys(folder, "ana")
        admitted = folder / "admitted"
        admitted.mkdir()
        (admitted / "ana.key").write_bytes((folder / "ana.key").read_bytes())
        self.ana = read_keys(folder / "ana.key_secret")
        self.studio = read_public_key(folder / "studio.key")
        self._context: zmq.Context[zmq.Socket[bytes]] = zmq.Context()
        self._door = only_admitted(self._context, admitted)
        self._door.__enter__()
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self.endpoint = f"tcp://127.0.0.1:{self.port}"
        keys = read_keys(folder / "studio.key_secret")
        self.socket = RouterSocket(self._context, self.endpoint, keys)

    def heard(self, seconds: float = 5) -> list[bytes]:
        """The next message; empty if there is none."""
        self.socket.wait(seconds)
        return next((frames for _, frames in self.socket.messages()), [])

    def close(self) -> None:
        self.socket.close()
        self._door.__exit__(None, None, None)
        self._context.term()


@pytest.fixture
def listener(tmp_path: Path) -> Iterator[Listener]:
    listener = Listener(tmp_path)
    yield listener
    listener.close()


class Wire:
    """A cable between a client and a port, on which somebody listens."""

    def __init__(self, port: int) -> None:
        self.seen = bytearray()
        self._port = port
        self._entry = socket.create_server(("127.0.0.1", 0))
        self._ends: list[socket.socket] = []
        self.endpoint = f"tcp://127.0.0.1:{self._entry.getsockname()[1]}"
        self._threads = [threading.Thread(target=self._run)]
        self._threads[0].start()

    def _run(self) -> None:
        near, _ = self._entry.accept()
        far = socket.create_connection(("127.0.0.1", self._port))
        self._ends = [near, far]
        back = threading.Thread(target=self._carry, args=(far, near))
        self._threads.append(back)
        back.start()
        self._carry(near, far)

    def _carry(self, source: socket.socket, target: socket.socket) -> None:
        try:
            while data := source.recv(1 << 16):
                self.seen += data
                target.sendall(data)
        except OSError:
            return

    def close(self) -> None:
        for end in self._ends:
            end.shutdown(socket.SHUT_RDWR)
        for thread in self._threads:
            thread.join(5)
        for end in (*self._ends, self._entry):
            end.close()


def test_who_listens_on_the_wire_sees_neither_words_nor_pictures(listener: Listener) -> None:
    wire = Wire(listener.port)
    with Client(wire.endpoint, listener.ana, listener.studio) as client:
        client.socket.send_multipart([HELLO, DRAWN.tobytes()])
        assert listener.heard() == [HELLO, DRAWN.tobytes()]
        assert len(wire.seen) > DRAWN.nbytes
        assert b"lampblack" not in wire.seen
        assert DRAWN[3].tobytes() not in wire.seen
        wire.close()


def outcome(client: Client, endpoint: str) -> int:
    """How the next handshake of a client ends: the event of its socket that says so."""
    monitor = client.socket.get_monitor_socket(REFUSED | zmq.EVENT_HANDSHAKE_SUCCEEDED)
    try:
        client.socket.connect(endpoint)
        assert monitor.poll(10_000), "no end of the handshake"
        return int(recv_monitor_message(monitor)["event"])
    finally:
        client.socket.disable_monitor()
        monitor.close(0)


@pytest.mark.parametrize("who", ["ana", "a stranger", "ana, of another worker", "none"])
def test_only_those_who_are_admitted_are_heard(
    listener: Listener, who: str, tmp_path: Path
) -> None:
    keys: KeyPair | None = listener.ana
    worker: bytes | None = listener.studio
    if who == "a stranger":
        make_keys(tmp_path, "stranger")
        keys = read_keys(tmp_path / "stranger.key_secret")
    elif who == "ana, of another worker":
        worker = listener.ana.public
    elif who == "none":
        keys = worker = None
    with Client(listener.endpoint, keys, worker) as client:
        client.socket.send(b"hello")
        if who == "ana":
            assert listener.heard() == [b"hello"]
        if who == "a stranger":
            assert outcome(client, listener.endpoint) & REFUSED
        if who != "ana":
            assert listener.heard(0.5) == []


def test_only_its_owner_reads_a_secret_key(tmp_path: Path) -> None:
    public, secret = make_keys(tmp_path / "keys", "ana")
    assert stat.S_IMODE(secret.stat().st_mode) == 0o600
    assert read_keys(secret).public == read_public_key(public) == read_public_key(secret)
    assert read_keys(secret).secret not in public.read_bytes()
    before = secret.read_bytes()
    with pytest.raises(OutputError, match="there already"):
        make_keys(tmp_path / "keys", "ana")
    assert secret.read_bytes() == before


@pytest.mark.parametrize("name", ["", "a/b", "..", ".hidden"])
def test_a_key_has_a_plain_name(tmp_path: Path, name: str) -> None:
    with pytest.raises(LampblackError, match="name of a key"):
        make_keys(tmp_path, name)
    assert list(tmp_path.iterdir()) == []


def test_a_worker_does_not_listen_without_knowing_for_whom(tmp_path: Path) -> None:
    _, secret = make_keys(tmp_path, "studio")
    (tmp_path / "nobody").mkdir()
    (tmp_path / "bad.key_secret").write_bytes(b"not a key")
    for key, admitted, words in (
        (secret, tmp_path / "nobody", "no public keys"),
        (tmp_path / "bad.key_secret", tmp_path, "no secret key"),
        (tmp_path / "studio.key", tmp_path, "no secret key"),
        (tmp_path / "missing", tmp_path, "no secret key"),
    ):
        with pytest.raises(LampblackError, match=words):
            serve_forever(Listening("127.0.0.1:0", key, admitted), RenderChild())
    with pytest.raises(LampblackError, match="cannot listen on"):
        serve_forever(Listening("203.0.113.9:1", secret, tmp_path), RenderChild())


@pytest.mark.parametrize(
    "options",
    [(), ("--listen", "127.0.0.1:7100"), ("--connection", "c.json", "--listen", "127.0.0.1:7100")],
)
def test_serve_says_whom_it_can_serve(run: Run, options: tuple[str, ...]) -> None:
    said = run("serve", *options)
    assert said.code != 0
    assert "not clear whom to serve" in said.err
