"""Render jobs through the real socket, with a fake renderer and a fake network."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from lampblack.cache import ArrayCache
from lampblack.choices import ApartKind
from lampblack.drawing import load_picture
from lampblack.errors import RenderError
from lampblack.pipeline import Pipeline
from lampblack.preview import PreviewState
from lampblack.protocol import Cancel, Done, ErrorMessage, FrameDone, Render
from lampblack.render.request import RenderRequest
from lampblack.scene import Depth, LayerBody, default_scene
from lampblack.service.client import Client
from lampblack.service.jobs import MAX_WAITING, Jobs
from lampblack.surface import Relief
from support.command_line import files
from support.drawings import draw_ball, draw_capsule, layered_cel
from support.preview_fakes import FakePredictor, FakeRenderer
from support.served import Served

SIZE = 64
FRAMES = 3


@pytest.fixture
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Served]:
    served = Served(tmp_path_factory.mktemp("w"))
    yield served
    served.close()


@pytest.fixture
def client(served: Served) -> Iterator[Client]:
    """A client that has announced its drawings, each another."""
    with Client(served.endpoint) as client:
        client.hello()
        for number in range(1, FRAMES + 1):
            client.announce(number, draw_ball(SIZE - 4 * number, canvas=SIZE))
        client.set_scene(default_scene(SIZE, SIZE))
        yield client


def render(
    client: Client, folder: Path, *, keep_finished: bool = False, apart: ApartKind = "none"
) -> int:
    request = client.next_request()
    client.send(
        Render(
            request=request,
            frames=f"1-{FRAMES}",
            output=str(folder / "%04d.png"),
            quality="low",
            keep_finished=keep_finished,
            apart=apart,
        )
    )
    return request


def receive_until(client: Client, condition: Callable[[], bool]) -> None:
    """Receive messages, and send the drawings that they ask for."""
    until = time.monotonic() + 10
    while not condition():
        assert time.monotonic() < until
        client.receive(0.02)


def errors(client: Client) -> list[str]:
    return [message.code for message in client.seen if isinstance(message, ErrorMessage)]


def test_a_job_takes_its_frames_apart(client: Client, tmp_path: Path) -> None:
    render(client, tmp_path, apart="png")
    done, _ = client.wait_for(Done)
    assert (done.outcome, done.frames_done) == ("finished", FRAMES)
    names = [f"{number:04d}.png" for number in range(1, FRAMES + 1)]
    for folder in ("drawing", "shade", "light"):
        assert sorted(path.name for path in (tmp_path / folder).iterdir()) == names
    render(client, tmp_path, apart="exr")
    done, _ = client.wait_for(Done)
    assert done.outcome == "failed"
    assert "--apart exr" in client.seen[-2].what  # type: ignore[attr-defined]


def test_a_job_writes_its_frames_and_says_so(client: Client, tmp_path: Path) -> None:
    request = render(client, tmp_path)
    done, _ = client.wait_for(Done)
    assert (done.request, done.outcome, done.frames_done) == (request, "finished", FRAMES)
    assert [m.frame for m in client.seen if isinstance(m, FrameDone)] == [1, 2, 3]
    assert files(tmp_path) >= {"0001.png", "0002.png", "0003.png"}
    assert load_picture(tmp_path / "0001.png").shape == (SIZE, SIZE, 4)
    render(client, tmp_path, keep_finished=True)
    client.wait_for(Done)
    kept = [message.kept for message in client.seen if isinstance(message, FrameDone)]
    assert kept == [False] * FRAMES + [True] * FRAMES


def test_a_job_lights_the_layers_apart_as_the_scene_says(
    served: Served, client: Client, tmp_path: Path
) -> None:
    body = draw_capsule((SIZE, SIZE), (32, 32), (32, 32), 24, (200, 110, 60), line=2)
    arm = draw_capsule((SIZE, SIZE), (20, 30), (58, 28), 6, line=2)
    cel = layered_cel(body=body, arm=arm)
    for number in range(1, FRAMES + 1):
        client.announce(number, cel.pixels, [("body", body), ("arm", arm)])
    reliefs: list[Relief] = []
    served.job_renderer.before_frame = lambda request: reliefs.append(request.surface.relief)
    for choice in ("auto", "below"):
        chosen = Depth(layers=(LayerBody("arm", choice),))  # type: ignore[arg-type]
        client.set_scene(replace(default_scene(SIZE, SIZE), depth=chosen))
        render(client, tmp_path, keep_finished=True)
        done, _ = client.wait_for(Done)
        assert (done.outcome, done.frames_failed) == ("finished", 0)
    apart, together = (relief.bodies for relief in reliefs)
    assert apart is not None
    assert set(apart.tolist()) == {0, 1}
    assert together is None


def test_a_cancelled_job_keeps_what_it_wrote(
    served: Served, client: Client, tmp_path: Path
) -> None:
    reached, go_on = threading.Event(), threading.Event()
    rendered: list[RenderRequest] = []

    def pause(request: RenderRequest) -> None:
        rendered.append(request)
        if len(rendered) == 2:
            reached.set()
            go_on.wait(10)

    served.job_renderer.before_frame = pause
    request = render(client, tmp_path)
    receive_until(client, reached.is_set)
    client.send(Cancel(request=request))
    receive_until(client, lambda: served.job_renderer.killed)
    go_on.set()
    done, _ = client.wait_for(Done)
    assert done.outcome == "cancelled"
    assert {f"{number:04d}.png" for number in range(1, done.frames_done + 1)} <= files(tmp_path)
    assert f"{FRAMES:04d}.png" not in files(tmp_path)


def test_a_lost_renderer_is_reported_once_and_the_frame_made_again(
    served: Served, client: Client, tmp_path: Path
) -> None:
    faults = [RenderError("lost")]

    def lose(request: RenderRequest) -> None:
        if faults:
            raise faults.pop()

    served.job_renderer.before_frame = lose
    render(client, tmp_path)
    done, _ = client.wait_for(Done)
    assert (done.outcome, done.frames_done, done.frames_failed) == ("finished", FRAMES, 0)
    assert errors(client) == ["render_restarted"]


def test_a_frame_that_cannot_be_rendered_does_not_end_the_job(
    served: Served, client: Client, tmp_path: Path
) -> None:
    first: list[object] = []

    def fail(request: RenderRequest) -> None:
        first.append(request.surface)
        if request.surface is first[0]:
            raise RenderError("never")

    served.job_renderer.before_frame = fail
    render(client, tmp_path)
    done, _ = client.wait_for(Done)
    assert (done.outcome, done.frames_done, done.frames_failed) == ("finished", FRAMES - 1, 1)
    assert errors(client) == ["render_restarted", "render_failed"]
    assert "0001.png" not in files(tmp_path)


def test_a_fault_of_the_worker_ends_the_job_but_not_the_next(
    served: Served, client: Client, tmp_path: Path
) -> None:
    def fail(request: RenderRequest) -> None:
        raise ValueError("odd")

    served.job_renderer.before_frame = fail
    render(client, tmp_path)
    assert client.wait_for(Done)[0].frames_done == 0
    assert set(errors(client)) == {"internal"}
    served.job_renderer.before_frame = lambda request: None
    render(client, tmp_path)
    assert client.wait_for(Done)[0].frames_done == FRAMES


def test_only_so_many_jobs_wait(served: Served, client: Client, tmp_path: Path) -> None:
    go_on = threading.Event()
    served.job_renderer.before_frame = lambda request: go_on.wait(10) and None
    for _ in range(MAX_WAITING + 2):
        render(client, tmp_path)
    error, _ = client.wait_for(ErrorMessage)
    assert error.code == "too_many_jobs"
    go_on.set()


def test_closing_ends_the_thread_and_the_renderer(tmp_path: Path) -> None:
    renderer = FakeRenderer()
    pipeline = Pipeline(ArrayCache(tmp_path), predictor=FakePredictor(), renderer=renderer)
    jobs = Jobs(PreviewState(), pipeline, lambda session, digest: None, lambda session, m: None)
    thread = threading.Thread(target=jobs.run, daemon=True)
    thread.start()
    time.sleep(0.05)  # so that it waits
    jobs.close()
    thread.join(5)
    assert not thread.is_alive()
    assert not renderer.alive
