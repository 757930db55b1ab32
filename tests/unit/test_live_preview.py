"""The live preview behind its handlers, with a fake renderer and a fake network."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lampblack.colour import linear, srgb
from lampblack.errors import (
    DrawingError,
    LampblackError,
    NothingDrawnError,
    OutputError,
    RenderError,
    RenderRestartedError,
)
from lampblack.preview import request as requests
from lampblack.protocol import Bye, Cancel, Status
from lampblack.render.wire import Accumulate
from lampblack.scene import Ambient, AreaLight, Floor, Scene, default_scene
from lampblack.service.faults import error_code
from lampblack.service.service import SOON_SECONDS, STATUS_SECONDS
from support.drawings import draw_ball, draw_capsule, layered_cel
from support.preview_fakes import Stage

SIZE = 64
ONE, OTHER = b"one", b"other"


@pytest.fixture
def stage(tmp_path: Path) -> Stage:
    stage = Stage(tmp_path)
    stage.greet(ONE)
    return stage


def scene(*places: float, power: float = 1.0, ambient: float = 0.3) -> Scene:
    lights = tuple(AreaLight(x, 20, 40, 30, power=power) for x in places)
    return replace(default_scene(SIZE, SIZE), lights=lights, ambient=Ambient(strength=ambient))


def look_at_ball(stage: Stage, client: bytes, shown: Scene) -> int:
    """Announce a ball, light it, look at it, and wait until that is done; the request."""
    stage.announce(client, 1, draw_ball(SIZE))
    stage.set_scene(client, shown)
    request = stage.look(client, 1, SIZE)
    stage.settle()
    return request


def test_a_picture_comes_at_once_then_finer_then_none(stage: Stage) -> None:
    request = look_at_ball(stage, ONE, scene(20))
    images = stage.images(ONE)
    assert [image.pass_ for image in images] == list(range(len(images)))
    assert [image.converged for image in images] == [False] * (len(images) - 1) + [True]
    assert {(image.request, image.revision) for image in images} == {(request, 1)}
    assert images[0].spp < images[-1].spp
    stage.settle()
    assert len(stage.images(ONE)) == len(images)
    assert stage.errors(ONE) == []


def test_the_picture_shows_the_light_that_was_traced(stage: Stage) -> None:
    stage.renderer.level = 0.5
    look_at_ball(stage, ONE, scene(20, power=0.5, ambient=0.0))
    drawn = draw_ball(SIZE)[32, 32, :3] / 255
    expected = 255 * srgb(0.25 * linear(drawn.astype(np.float32)))
    assert stage.picture(ONE)[32, 32, :3] == pytest.approx(expected, abs=2)


def test_only_the_light_that_moved_is_traced_again(stage: Stage) -> None:
    look_at_ball(stage, ONE, scene(10, 50))
    assert {job.light and job.light.x for job in stage.renderer.jobs} == {None, 10, 50}
    stage.renderer.jobs.clear()
    stage.set_scene(ONE, scene(30, 50))
    stage.settle()
    assert {job.light and job.light.x for job in stage.renderer.jobs} == {30}
    assert stage.images(ONE)[-1].converged


def test_colour_and_power_are_shown_without_tracing(stage: Stage) -> None:
    look_at_ball(stage, ONE, scene(10, power=0.2))
    dim = stage.picture(ONE).copy()
    stage.renderer.jobs.clear()
    revision = stage.set_scene(ONE, scene(10, power=0.4))
    stage.settle()
    assert stage.renderer.jobs == []
    assert (stage.images(ONE)[-1].revision, stage.images(ONE)[-1].converged) == (revision, True)
    assert (stage.picture(ONE)[32, 32, :3] > dim[32, 32, :3]).all()


def test_the_floor_is_traced_with_the_character_and_without(stage: Stage) -> None:
    look_at_ball(stage, ONE, replace(scene(10), floor=Floor(60)))
    subjects = {(job.subject, job.light is None) for job in stage.renderer.jobs}
    assert subjects == {(s, ambient) for s in ("character", "floor") for ambient in (False, True)}
    assert stage.images(ONE)[-1].converged
    beside = stage.picture(ONE)[60, 4]
    assert beside[3] == pytest.approx(255 * (1 - srgb(np.float32(0.5))), abs=2)
    assert not beside[:3].any()


def test_the_scene_is_resolved_once_for_each_request_and_detail(
    stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    look_at_ball(stage, ONE, scene(10))
    resolved: list[Scene] = []
    original = requests.scene_in_view

    def count(given: Scene, *more: object) -> Scene:
        resolved.append(given)
        return original(given, *more)  # type: ignore[arg-type]

    monkeypatch.setattr(requests, "scene_in_view", count)
    changed = scene(30)
    stage.set_scene(ONE, changed)
    stage.settle()
    stage.now += 5  # for more than one status, which counts the frames that are lit
    stage.settle()
    assert stage.images(ONE)[-1].converged
    assert resolved == [changed]


def test_the_latest_scene_wins(stage: Stage) -> None:
    look_at_ball(stage, ONE, scene(10))
    before = len(stage.images(ONE))
    for x in range(20, 40):
        latest = stage.set_scene(ONE, scene(x))
    stage.settle()
    assert {image.revision for image in stage.images(ONE)[before:]} == {latest}


def test_nothing_older_follows_something_newer(stage: Stage) -> None:
    look_at_ball(stage, ONE, scene(10))
    view = stage.service.sessions[ONE].view()
    assert view is not None
    stage.set_scene(ONE, scene(30))
    stage.settle()
    count = len(stage.images(ONE))
    stage.service.preview.painter.offer(view)
    stage.settle()
    assert len(stage.images(ONE)) == count


def test_nothing_is_sent_twice(stage: Stage) -> None:
    look_at_ball(stage, ONE, scene(10))
    view = stage.service.sessions[ONE].view()
    assert view is not None
    count = len(stage.images(ONE))
    stage.service.preview.painter.offer(view)
    stage.settle()
    assert len(stage.images(ONE)) == count


def test_refinement_is_left_when_something_changes(stage: Stage) -> None:
    look_at_ball(stage, ONE, scene(10))
    stage.renderer.jobs.clear()

    def change(job: Accumulate) -> None:
        if job.spp > 1 and job.light and job.light.x == 30:
            stage.set_scene(ONE, scene(50))
            stage.service.turn()

    stage.renderer.before = change
    stage.set_scene(ONE, scene(30))
    stage.settle()
    assert [job.light and job.light.x for job in stage.renderer.jobs[:3]] == [30, 30, 50]
    assert [job.spp for job in stage.renderer.jobs[:3]] == [1, 4, 1]


def test_a_lost_renderer_is_started_again_and_reported_once(stage: Stage) -> None:
    look_at_ball(stage, ONE, scene(10))
    stage.renderer.alive = False
    stage.settle()
    assert stage.renderer.starts == 1
    revision = stage.set_scene(ONE, scene(30))
    stage.settle()
    assert stage.images(ONE)[-1].revision == revision
    assert stage.images(ONE)[-1].converged
    assert stage.errors(ONE) == ["render_restarted"]


def test_a_renderer_lost_now_and_then_is_no_failure(stage: Stage) -> None:
    for step in range(5):
        look_at_ball(stage, ONE, scene(10 + step))
        stage.renderer.alive = False
    stage.settle()
    assert stage.errors(ONE) == ["render_restarted"] * 5


def test_light_that_cannot_be_traced_is_given_up(stage: Stage) -> None:
    look_at_ball(stage, ONE, scene(10))
    tried: list[Accumulate] = []

    def lose(job: Accumulate) -> None:
        if job.light and job.light.x == 30:
            tried.append(job)
            raise RenderError("lost")

    stage.renderer.before = lose
    stage.set_scene(ONE, scene(30))
    stage.settle()
    assert len(tried) == 3
    assert stage.errors(ONE) == ["render_restarted", "render_restarted", "render_failed"]
    revision = stage.set_scene(ONE, scene(50))
    stage.settle()
    assert (stage.images(ONE)[-1].revision, stage.images(ONE)[-1].converged) == (revision, True)


def test_frames_beside_the_one_in_sight_are_lit_ahead(stage: Stage) -> None:
    for frame, size in ((2, 56), (3, 48)):
        stage.announce(ONE, frame, draw_ball(size, canvas=SIZE))
    look_at_ball(stage, ONE, scene(10))
    assert stage.service.planner.frames_lit(stage.service.sessions[ONE]) == 3
    stage.renderer.jobs.clear()
    stage.look(ONE, 2, SIZE)
    stage.step()
    assert stage.renderer.jobs == []
    assert stage.service.preview.state.lights.full is False
    stage.settle()
    assert stage.images(ONE)[-1].frame == 2


def test_clients_see_their_own(stage: Stage) -> None:
    stage.greet(OTHER)
    look_at_ball(stage, ONE, scene(10, power=1.0))
    look_at_ball(stage, OTHER, scene(10, power=0.1))
    assert stage.picture(ONE)[32, 32, 0] > stage.picture(OTHER)[32, 32, 0] + 50
    count = len(stage.images(OTHER))
    stage.handle(OTHER, Bye())
    stage.set_scene(ONE, scene(40))
    stage.settle()
    assert len(stage.images(OTHER)) == count
    assert stage.images(ONE)[-1].converged


def test_a_cancelled_look_shows_and_traces_nothing_more(stage: Stage) -> None:
    request = look_at_ball(stage, ONE, scene(10))
    count = len(stage.images(ONE))
    stage.handle(ONE, Cancel(request=request))
    stage.renderer.jobs.clear()
    stage.set_scene(ONE, scene(40))
    stage.settle()
    assert stage.renderer.jobs == []
    assert len(stage.images(ONE)) == count


@pytest.mark.parametrize(
    ("fault", "code"),
    [
        (ValueError("odd"), "internal"),
        (MemoryError(), "out_of_memory"),
        (DrawingError("Cannot be lit."), "drawing_unusable"),
    ],
)
def test_a_drawing_that_cannot_be_prepared_is_reported_and_others_go_on(
    stage: Stage, fault: Exception, code: str
) -> None:
    stage.predictor.faults = [fault]
    look_at_ball(stage, ONE, scene(10))
    assert (stage.errors(ONE), stage.images(ONE)) == ([code], [])
    stage.announce(ONE, 2, draw_ball(48, canvas=SIZE))
    stage.look(ONE, 2, SIZE)
    stage.settle()
    assert stage.images(ONE)[-1].converged


@pytest.mark.parametrize(
    ("error", "code"),
    [
        (NothingDrawnError("Blank."), "nothing_drawn"),
        (OutputError("Full."), "output_failed"),
        (RenderRestartedError("Back."), "render_restarted"),
        (RenderError("Gone."), "render_failed"),
        (LampblackError("Odd."), "drawing_unusable"),
        (MemoryError(), "out_of_memory"),
        (KeyError("x"), "internal"),
    ],
)
def test_every_error_has_one_code(error: Exception, code: str) -> None:
    assert error_code(error) == code


@pytest.fixture
def running(tmp_path: Path) -> Iterator[Stage]:
    """The same in threads of its own, by the real clock."""
    stage = Stage(tmp_path, time.monotonic)
    stage.greet(ONE)
    stage.service.preview.start()
    yield stage
    stage.service.close()


def test_threads_report_what_they_meet_and_live_on(running: Stage) -> None:
    running.announce(ONE, 1, draw_ball(SIZE))
    running.set_scene(ONE, scene(10))
    running.look(ONE, 1, SIZE)
    until = time.monotonic() + 30

    def converged(revision: int) -> bool:
        images = running.images(ONE)
        return bool(images) and images[-1].converged and images[-1].revision == revision

    def serve(revision: int) -> None:
        while not converged(revision):
            assert time.monotonic() < until
            running.step_service()
            time.sleep(0.005)

    serve(1)
    faults = [ValueError("odd")]

    def fail(job: Accumulate) -> None:
        if faults:
            raise faults.pop()

    running.renderer.before = fail
    serve(running.set_scene(ONE, scene(30)))
    assert running.errors(ONE) == ["render_restarted"]


def test_layers_that_are_sent_apart_are_bodies(stage: Stage) -> None:
    body = draw_capsule((SIZE, SIZE), (32, 32), (32, 32), 24, (200, 110, 60), line=2)
    arm = draw_capsule((SIZE, SIZE), (20, 30), (58, 28), 6, line=2)
    cel = layered_cel(body=body, arm=arm)
    stage.announce(ONE, 1, cel.pixels, [("body", body), ("arm", arm)])
    stage.set_scene(ONE, scene(20))
    stage.look(ONE, 1, SIZE)
    stage.settle()
    assert stage.renderer.surface is not None
    found = stage.renderer.surface.relief.bodies
    assert found is not None
    assert set(found.tolist()) == {0, 1}
    assert stage.images(ONE)[-1].converged
    assert stage.errors(ONE) == []


def test_a_status_follows_a_change_of_state_soon_and_else_after_a_second(stage: Stage) -> None:
    def told() -> list[str]:
        sent = (received.message for received in stage.transport.sent[ONE])
        return [message.preview for message in sent if isinstance(message, Status)]

    service = stage.service
    service.turn()
    assert service.patience == STATUS_SECONDS
    service.preview.state.renderer = "restarting"
    assert service.patience == pytest.approx(SOON_SECONDS)
    before = len(told())
    service.turn()
    assert len(told()) == before
    stage.now += SOON_SECONDS + 0.01
    service.turn()
    assert told()[before:] == ["restarting"]
    assert service.patience == STATUS_SECONDS
    service.preview.tracer.ready()
    assert len(stage.transport.events) == 1, "the loop wakes, to tell that the renderer is there"
