"""The worker survives what happens to it: lost children, lost clients, nonsense, a full disk."""

from __future__ import annotations

import json
import os
import random
import resource
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
import zmq

from lampblack.protocol import (
    Cancel,
    Done,
    ErrorMessage,
    FrameDone,
    Hello,
    Message,
    NeedFrame,
    Progress,
    PutFrame,
    Render,
    SetScene,
    Status,
    Welcome,
    encode,
    frame_digest,
)
from lampblack.scene import Scene, default_scene
from lampblack.service.client import Client, Worker
from lampblack.service.handlers import MAX_CLIENTS
from support.drawings import draw_ball
from support.hostile import hostile
from support.processes import gone
from support.window import patience

SIZE, LARGE = 160, 2400
WHOLE = (0.0, 0.0, float(SIZE), float(SIZE))


@pytest.fixture
def client(worker: Worker) -> Iterator[Client]:
    with worker.connect() as client:
        client.hello()
        client.announce(1, draw_ball(SIZE))
        yield client


def lit_from(x: float) -> Scene:
    scene = default_scene(SIZE, SIZE)
    return replace(scene, lights=(replace(scene.lights[0], x=x),))


def children_of(pid: int) -> dict[int, int]:
    """Renderers of a worker, by pid, and how much nicer than it they are."""
    found, own = {}, os.getpriority(os.PRIO_PROCESS, pid)
    for entry in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = entry.read_text().rpartition(")")[2].split()
            command = (entry.parent / "cmdline").read_bytes()
        except OSError:
            continue
        if fields[1] == str(pid) and b"lampblack.render.child" in command:
            found[int(entry.parent.name)] = int(fields[16]) - own
    return found


def told(client: Client, code: str) -> int:
    return sum(isinstance(m, ErrorMessage) and m.code == code for m in client.seen)


def drag(client: Client, seconds: float) -> None:
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        client.set_scene(lit_from(client.revision % SIZE))
        client.receive(1 / 60)


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGSTOP])
def test_a_lost_preview_renderer_comes_back_while_dragging(
    worker: Worker, client: Client, number: signal.Signals
) -> None:
    client.set_scene(lit_from(0))
    client.look(1, (SIZE, SIZE), WHOLE)
    client.picture()
    drag(client, 0.5)
    (child,) = (pid for pid, nice in children_of(worker.process.pid).items() if nice == 0)
    os.kill(child, number)
    killed = client.revision
    until = time.monotonic() + 10 * patience()
    while time.monotonic() < until and told(client, "render_restarted") == 0:
        drag(client, 0.1)
    assert gone([child], 3)
    drag(client, 0.5)
    client.picture(30, lambda image: image.revision > killed)
    revision = client.set_scene(lit_from(33))
    client.picture(60, lambda image: image.converged and image.revision == revision)
    assert told(client, "render_restarted") == 1
    assert told(client, "render_failed") == 0


def test_a_lost_job_renderer_does_not_end_the_job(
    worker: Worker, client: Client, tmp_path: Path
) -> None:
    client.announce(2, draw_ball(SIZE - 40, canvas=SIZE))
    client.set_scene(lit_from(40))
    output = str(tmp_path / "%04d.png")
    client.send(Render(request=client.next_request(), frames="1-2", output=output))
    client.wait_for(Progress, 30, lambda progress: progress.share >= 0.3)
    until = time.monotonic() + 30
    while not (nice := [p for p, n in children_of(worker.process.pid).items() if n > 0]):
        assert time.monotonic() < until
    os.kill(nice[0], signal.SIGKILL)
    done, _ = client.wait_for(Done, 120)
    assert (done.outcome, done.frames_done, done.frames_failed) == ("finished", 2, 0)
    assert told(client, "render_restarted") == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["0001.png", "0002.png"]


def test_a_job_is_cancelled_and_its_finished_frames_kept(client: Client, tmp_path: Path) -> None:
    for number in range(2, 9):
        client.announce(number, draw_ball(SIZE - 10 * number, canvas=SIZE))
    client.set_scene(lit_from(40))
    request = client.next_request()
    output = str(tmp_path / "%04d.png")
    client.send(Render(request=request, frames="1-8", output=output, quality="low"))
    client.wait_for(FrameDone, 60)
    client.send(Cancel(request=request))
    done, _ = client.wait_for(Done, 30)
    assert done.outcome == "cancelled"
    kept = sorted(path.name for path in tmp_path.iterdir())
    assert kept == [f"{number:04d}.png" for number in range(1, done.frames_done + 1)]


def test_a_full_disk_ends_a_job_that_is_then_resumed(
    worker: Worker, client: Client, tmp_path: Path
) -> None:
    client.announce(2, draw_ball(SIZE - 40, canvas=SIZE))
    client.set_scene(lit_from(40))
    output = str(tmp_path / "%04d.png")
    pid, limit = worker.process.pid, resource.RLIMIT_FSIZE
    client.send(Render(request=client.next_request(), frames="1", output=output, quality="low"))
    client.wait_for(Done, 60)
    before = resource.prlimit(pid, limit)
    resource.prlimit(pid, limit, (1000, before[1]))
    again = Render(
        request=client.next_request(),
        frames="1-2",
        output=output,
        quality="low",
        keep_finished=True,
    )
    client.send(again)
    error, _ = client.wait_for(ErrorMessage, 60)
    assert error.code == "output_failed"
    done, _ = client.wait_for(Done, 60)
    assert (done.outcome, done.frames_done) == ("failed", 1)
    assert [path.name for path in tmp_path.iterdir()] == ["0001.png"]
    resource.prlimit(pid, limit, before)
    client.send(
        Render(
            request=client.next_request(),
            frames="1-2",
            output=output,
            quality="low",
            keep_finished=True,
        )
    )
    done, _ = client.wait_for(Done, 60)
    assert (done.outcome, done.frames_done) == ("finished", 2)


def test_a_lost_worker_is_replaced_and_asks_for_what_it_needs(tmp_path: Path) -> None:
    picture = draw_ball(SIZE)
    cache = {"XDG_CACHE_HOME": str(tmp_path / "cache"), "XDG_RUNTIME_DIR": str(tmp_path)}
    sessions = []
    for start in range(2):
        with Worker(tmp_path, environment=cache) as worker, worker.connect() as client:
            sessions.append(client.hello().session)
            client.announce(1, picture)
            client.announce(2, draw_ball(SIZE - 20, canvas=SIZE))
            revision = client.set_scene(lit_from(40))
            client.look(1, (SIZE, SIZE), WHOLE)
            client.picture(60, lambda image: image.revision == revision)  # noqa: B023
            first = next(m for m in client.seen if isinstance(m, NeedFrame))
            assert first.frame == 1
            if start == 0:
                (child,) = children_of(worker.process.pid)
                worker.process.kill()
                worker.process.wait()
                assert gone([child], 3)
                worker.connection.unlink()  # what kill -9 leaves behind
    assert sessions[0] != sessions[1]


@pytest.mark.parametrize("busy", [False, True])
def test_nothing_stays_behind_when_the_parent_goes(
    tmp_path: Path, tmp_path_factory: pytest.TempPathFactory, busy: bool
) -> None:
    """Also while a network predicts the normals of a large drawing, for a preview and for a job:
    nothing can interrupt it."""
    runtime = tmp_path_factory.mktemp("run")  # a socket does not go into a folder of a long name
    environment = {"XDG_CACHE_HOME": str(tmp_path / "cache"), "XDG_RUNTIME_DIR": str(runtime)}
    parent = subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE)
    worker = Worker(tmp_path, parent.pid, environment)
    with worker.connect() as client:
        client.hello()
        client.wait_for(Status, 60, lambda status: status.preview == "idle")
        if busy:
            client.announce(1, draw_ball(LARGE))
            client.set_scene(lit_from(0))
            client.look(1, (SIZE, SIZE), (0.0, 0.0, float(LARGE), float(LARGE)))
            output = str(tmp_path / "%04d.png")
            client.send(Render(request=client.next_request(), frames="1", output=output))
            client.wait_for(NeedFrame)
            client.wait_for(Status, 60, lambda status: status.preview == "working")
        children = children_of(worker.process.pid)
        assert children
        assert list(runtime.iterdir())
        parent.communicate()
        assert worker.process.wait(3) == 0
    assert not list(runtime.iterdir())
    assert not worker.connection.exists()
    assert gone(children, 3)


def test_a_client_that_never_reads_harms_nobody(worker: Worker, client: Client) -> None:
    still_serves(client)  # it has loaded what it needs
    with worker.connect() as deaf:
        deaf.hello()
        deaf.announce(1, draw_ball(SIZE))
        deaf.send(PutFrame(frame=1, digest=frame_digest({"pixels": draw_ball(SIZE)})))
        deaf.look(1, (1024, 1024), WHOLE)
        before, _ = client.wait_for(Status)
        for step in range(300):
            deaf.set_scene(lit_from(step % SIZE))
            client.receive(0.01)
        client.set_scene(lit_from(20))
        client.look(1, (SIZE, SIZE), WHOLE)
        client.picture(60, lambda image: image.converged)
        after, _ = client.wait_for(Status)
        assert after.memory_bytes - before.memory_bytes < 300 << 20


def test_clients_that_vanish_leave_their_places_to_others(worker: Worker) -> None:
    visit = "import sys, time; from lampblack.service.client import Client\n"
    visit += "guest = Client(sys.argv[1]); guest.hello(); print(flush=True); time.sleep(60)"
    for _ in range(MAX_CLIENTS + 1):
        command = [sys.executable, "-c", visit, worker.endpoint()]
        with subprocess.Popen(command, stdout=subprocess.PIPE) as guest:
            assert guest.stdout is not None
            assert guest.stdout.readline() == b"\n"
            guest.kill()  # its socket open, without a goodbye
    until = time.monotonic() + 10
    while time.monotonic() < until:
        with worker.connect() as late:
            late.send(Hello(minor=0, client="late", client_version="1"))
            if isinstance(late.wait_for(Message)[0], Welcome):
                return
        time.sleep(0.5)
    pytest.fail("the places of dead clients were not given away")


@pytest.mark.skipif(os.geteuid() != 0, reason="becoming another user needs root")
def test_another_user_is_refused(worker: Worker) -> None:
    path = worker.endpoint().removeprefix("ipc://")
    knock = "import socket, sys; socket.socket(socket.AF_UNIX).connect(sys.argv[1])"
    for user, met in ((None, 0), (65534, 1)):
        tried = subprocess.run(
            ["/usr/bin/env", "python3", "-c", knock, path], user=user, capture_output=True
        )
        assert tried.returncode == met
        assert (b"PermissionError" in tried.stderr) == bool(met)
    assert not worker.connection.stat().st_mode & 0o077


def pester(worker: Worker, count: int) -> None:
    context: zmq.Context[zmq.Socket[bytes]] = zmq.Context()
    socket = context.socket(zmq.DEALER)
    socket.setsockopt(zmq.LINGER, 0)
    socket.connect(worker.endpoint())
    for number, frames in enumerate(hostile(random.Random(7), count)):
        socket.send_multipart(frames)
        while socket.poll(1 if number % 16 == 0 else 0):
            socket.recv_multipart()
    socket.close(0)
    context.term()


def still_serves(client: Client) -> None:
    revision = client.set_scene(lit_from(70))
    client.look(1, (SIZE, SIZE), WHOLE)
    client.picture(60, lambda image: image.converged and image.revision == revision)


def test_nonsense_is_answered_and_harms_nobody(worker: Worker, client: Client) -> None:
    pester(worker, 400)
    still_serves(client)


@pytest.mark.slow
def test_ten_thousand_hostile_messages(worker: Worker, client: Client) -> None:
    pester(worker, 10_000)
    still_serves(client)


@pytest.mark.slow
def test_memory_stays_flat_over_two_thousand_changes(worker: Worker, client: Client) -> None:
    client.set_scene(lit_from(0))
    client.look(1, (SIZE, SIZE), WHOLE)
    drag(client, 10)
    before, _ = client.wait_for(Status)
    while client.revision < 2600:
        drag(client, 1)
    after, _ = client.wait_for(Status)
    assert after.memory_bytes - before.memory_bytes < 64 << 20
    assert children_of(worker.process.pid)


def test_scenes_beyond_all_bounds_are_refused(client: Client) -> None:
    sound, *_ = encode(SetScene(revision=1, scene=default_scene(32, 32)))
    tree = json.loads(bytes(sound))
    light = tree["scene"]["lights"][0]
    for change, code in (
        (json.dumps({**light, "x": 1e30}), "bad_number"),
        (json.dumps({**light, "x": 2e5}), "bad_scene"),
        (json.dumps({**light, "x": 0}).replace(": 0", ": NaN"), "bad_json"),
        (",".join([json.dumps(light)] * 500), "bad_scene"),
    ):
        text = bytes(sound).decode().replace(json.dumps(light, separators=(",", ":")), change)
        assert change in text
        client.socket.send_multipart([text.encode()])
        error, _ = client.wait_for(ErrorMessage)
        assert error.code == code


def test_messages_before_hello_are_refused(worker: Worker) -> None:
    with worker.connect() as stranger:
        stranger.set_scene(lit_from(1))
        assert stranger.wait_for(ErrorMessage)[0].code == "not_greeted"
