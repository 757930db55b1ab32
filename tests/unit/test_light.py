"""``lampblack.light`` without a renderer: what it hands on, and what it refuses."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import lampblack
from lampblack.drawing import Drawing
from lampblack.errors import DrawingError, NothingDrawnError, SceneError
from lampblack.pipeline import Pipeline
from lampblack.scene import (
    AreaLight,
    Depth,
    DepthHint,
    DepthPoint,
    LightKey,
    Scene,
    default_scene,
    encode_scene,
)
from support.drawings import draw_ball


@pytest.fixture
def rendered(monkeypatch: pytest.MonkeyPatch) -> list[Scene]:
    scenes: list[Scene] = []

    def render(self: Pipeline, drawing: Drawing, scene: Scene) -> np.ndarray:
        scenes.append(scene)
        return drawing.pixels

    monkeypatch.setattr(Pipeline, "render", render)
    return scenes


def test_files_and_arrays_are_the_same(ball_png: Path, rendered: list[Scene]) -> None:
    keys = (LightKey(1, 30, 20, 60), LightKey(9, 90, 20, 60))
    hints = (DepthHint(1, (DepthPoint(10, 10),)), DepthHint(5, (DepthPoint(20, 20),)))
    scene = replace(
        default_scene(99, 99),
        lights=(AreaLight(0, 0, 60, keys=keys),),
        depth=Depth(hints=hints),
    )
    path = ball_png.with_suffix(".json")
    path.write_bytes(encode_scene(scene))
    assert np.array_equal(lampblack.light(ball_png, path), lampblack.light(draw_ball(), scene))
    assert rendered[0] == rendered[1]
    assert rendered[0].canvas.width == 160
    assert rendered[0].lights[0].x == 30
    assert rendered[0].depth.hints == hints[:1]
    lampblack.light(str(ball_png))
    assert rendered[2] == default_scene(160, 160)


def test_what_cannot_be_lit_is_refused(ball_png: Path, rendered: list[Scene]) -> None:
    with pytest.raises(NothingDrawnError):
        lampblack.light(np.zeros((9, 9, 4), np.uint8))
    for picture in (np.zeros((9, 9, 3), np.uint8), np.zeros((9, 9, 4)), ball_png.parent / "no.png"):
        with pytest.raises(DrawingError):
            lampblack.light(picture)
    with pytest.raises(SceneError):
        lampblack.light(ball_png, "no.json")
    with pytest.raises(DrawingError):
        lampblack.light(ball_png, mask=draw_ball(64))
    with pytest.raises(AttributeError):
        lampblack.dark  # noqa: B018
    assert not rendered
