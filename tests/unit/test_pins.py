"""Lights that follow a place of the drawing or a layer, in files and in live sessions."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lampblack.drawing import DrawingPlanes, save_picture
from lampblack.finals.resolve import resolve_job
from lampblack.finals.settings import RenderSettings
from lampblack.finals.tasks import Ready, plan
from lampblack.normals.temporal.temporal_filter import TemporalFilter
from lampblack.pins import carried_place, followed, pins_of
from lampblack.pipeline import Pipeline
from lampblack.scene import (
    Ambient,
    AreaLight,
    Canvas,
    LightKey,
    Pin,
    Scene,
    decode_scene,
    default_scene,
    encode_scene,
)
from support.drawings import draw_ball, layered_cel
from support.preview_fakes import Stage

ONE = b"one"
SIDE = 160
PIN = Pin(1, 60, 60)


def shifted(picture: np.ndarray, right: int, down: int) -> np.ndarray:
    return np.roll(picture, (down, right), (0, 1))


def figure() -> np.ndarray:
    """A ball that leaves room to move."""
    return np.pad(draw_ball(100), ((10, 50), (10, 50), (0, 0)))


@pytest.mark.parametrize("layer", ["", "nowhere"])
@pytest.mark.parametrize("move", [(0, 0), (30, 12), (-6, 40)])
def test_a_place_goes_where_the_drawing_goes(move: tuple[int, int], layer: str) -> None:
    here = DrawingPlanes(figure()).decompose()
    there = DrawingPlanes(shifted(figure(), *move)).decompose()
    found = carried_place((60, 60), layer, here, there, TemporalFilter())
    assert found == pytest.approx((60 + move[0], 60 + move[1]), abs=2)


def test_a_layer_goes_by_itself() -> None:
    """The body stays, and the arm moves."""
    ball = np.pad(draw_ball(120), ((20, 20), (20, 20), (0, 0)))
    arm = np.zeros_like(ball)
    arm[60:80, 12:70] = 30, 160, 60, 255
    arm[60:62, 12:70] = arm[78:80, 12:70] = 0, 0, 0, 255

    def drawn(move: tuple[int, int]) -> DrawingPlanes:
        cel = layered_cel(body=ball, arm=shifted(arm, *move))
        return DrawingPlanes(cel.pixels, layers=cel.layers)

    here, there = drawn((0, 0)).decompose(), drawn((20, 30)).decompose()
    assert [body.name for body in here.bodies] == ["body", "arm"]
    found = carried_place((40, 70), "arm", here, there, TemporalFilter())
    assert found == pytest.approx((60, 100), abs=2)
    found = carried_place((40, 70), "body", here, there, TemporalFilter())
    assert found == pytest.approx((40, 70), abs=2)


def scene(**fields: object) -> Scene:
    lamp = AreaLight(50, 40, 80, 30, pin=PIN, **fields)  # type: ignore[arg-type]
    return Scene(Canvas(SIDE, SIDE), (lamp, AreaLight(20, 20, 90)), Ambient(strength=0.2))


def test_only_lamps_with_a_pin_are_moved() -> None:
    moved = followed(scene(), {PIN: (5, -3)})
    assert [(light.x, light.y) for light in moved.lights] == [(55, 37), (20, 20)]
    assert pins_of(scene()) == (PIN,)
    assert pins_of(scene(kind="sun")) == ()
    assert followed(scene(kind="sun"), {PIN: (5, -3)}) == scene(kind="sun")


def test_pins_survive_a_file() -> None:
    pinned = replace(scene().lights[0], pin=Pin(7, 1, 2, "arm", {"new": 1}))
    lit = replace(scene(), lights=(pinned,))
    assert decode_scene(encode_scene(lit)) == lit
    assert decode_scene(encode_scene(default_scene(9, 9))).lights[0].pin is None


def test_files_follow_the_drawing_beside_the_keys(tmp_path: Path, pipeline: Pipeline) -> None:
    moves = {1: (0, 0), 2: (20, 10), 3: (40, 20)}
    for number, move in moves.items():
        save_picture(tmp_path / f"walk.{number:04d}.png", shifted(figure(), *move))
    keys = (LightKey(1, 50, 40, 80, 30), LightKey(3, 90, 40, 80, 30))
    settings = RenderSettings(inputs=(str(tmp_path),), output=str(tmp_path / "lit"), steady=False)
    places = {}
    for keyed in (False, True):
        lit = scene(keys=keys if keyed else ())
        job = resolve_job(settings, lit)
        for task in plan(job, pipeline, job.frames):
            assert isinstance(task, Ready)
            light = task.scene.lights[0]
            places[keyed, task.frames[0][0].number] = light.x, light.y
    for number, (right, down) in moves.items():
        assert places[False, number] == pytest.approx((50 + right, 40 + down), abs=2)
        along = 50 + 20 * (number - 1)
        assert places[True, number] == pytest.approx((along + right, 40 + down), abs=2)


def test_a_preview_follows_the_drawing_too(tmp_path: Path) -> None:
    stage = Stage(tmp_path)
    stage.greet(ONE)
    stage.announce(ONE, 1, figure())
    stage.announce(ONE, 2, shifted(figure(), 30, 12))
    stage.set_scene(ONE, scene())
    for frame, place in ((1, (50, 40)), (2, (80, 52))):
        stage.look(ONE, frame, SIDE)
        stage.settle()
        seen = stage.service.planner.sessions[ONE].view()
        assert seen is not None
        drawing = stage.service.preview.state.drawing(seen.shape)
        assert drawing is not None
        resolved = seen.resolve(drawing)
        assert resolved is not None
        light = resolved.scene.lights[0]
        assert (light.x, light.y) == pytest.approx(place, abs=2)
        traced = [(job.light.x, job.light.y) for job in stage.renderer.jobs if job.light]
        assert (light.x, light.y) in traced
    assert stage.errors(ONE) == []
