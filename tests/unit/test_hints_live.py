"""What the artist says of the depth reaches previews and files."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import msgspec
import numpy as np
import pytest
from numpy.typing import NDArray

from lampblack.cache import ArrayCache
from lampblack.choices import FrontSide
from lampblack.drawing import save_picture
from lampblack.finals.one_frame import first_frame
from lampblack.finals.resolve import resolve_shot
from lampblack.finals.settings import RenderSettings
from lampblack.pipeline import Pipeline
from lampblack.prepared import PreparedDrawing
from lampblack.protocol import GetOverlaps, Overlaps
from lampblack.scene import (
    Depth,
    DepthColour,
    DepthHint,
    DepthPoint,
    DepthStroke,
    Scene,
    default_scene,
    encode_scene,
)
from support.command_line import Run
from support.drawings import draw_ball
from support.preview_fakes import FakePredictor, Stage

SIZE = 96
CLIENT = b"one"


def hint(front: FrontSide, frame: int = 1, x: float = SIZE / 2) -> DepthHint:
    """A stroke up the middle of the ball: its left is the left of the picture."""
    points = tuple(DepthPoint(x, float(y)) for y in np.linspace(SIZE - 8, 8, 9))
    return DepthHint(frame, points, front, 0.2)


def scene(*hints: DepthHint) -> Scene:
    return replace(default_scene(SIZE, SIZE), depth=Depth(hints=hints))


def step_of(prepared: PreparedDrawing, x: float = SIZE / 2) -> float:
    """How much higher the surface is on the left of ``x``, in pixels."""
    left, right = (prepared.height[SIZE // 2, int(x) + side] for side in (-6, 6))
    return float(left - right)


def overlaps(stage: Stage, frame: int) -> Overlaps:
    request = stage.next_request(CLIENT)
    stage.handle(CLIENT, GetOverlaps(request=request, frame=frame))
    stage.settle()
    answers = [sent.message for sent in stage.transport.sent[CLIENT]]
    (answer,) = [m for m in answers if isinstance(m, Overlaps) and m.request == request]
    return answer


def side_in_front(stage: Stage) -> str:
    """The higher side of the surface that was traced last."""
    assert stage.renderer.surface is not None
    x, y, z = stage.renderer.surface.relief.vertices.T
    middle = np.abs(y - SIZE / 2) < SIZE / 6
    left = z[middle & (np.abs(x - SIZE / 2 + 10) < 6)].max()
    right = z[middle & (np.abs(x - SIZE / 2 - 10) < 6)].max()
    return "left" if left > right + 4 else "right" if right > left + 4 else "joined"


def test_a_hint_shapes_the_preview_and_is_undone(tmp_path: Path) -> None:
    stage = Stage(tmp_path)
    stage.greet(CLIENT)
    stage.announce(CLIENT, 1, draw_ball(SIZE))
    stage.set_scene(CLIENT, scene())
    stage.look(CLIENT, 1, SIZE)
    assert overlaps(stage, 1).overlaps == ()
    for front in ("left", "right", "joined"):
        revision = stage.set_scene(CLIENT, scene(hint(front)))
        found = overlaps(stage, 1)
        assert found.revision == revision
        assert all(overlap.hinted for overlap in found.overlaps)
        assert side_in_front(stage) == front
        assert stage.images(CLIENT)[-1].revision == revision
    stage.set_scene(CLIENT, scene())
    assert overlaps(stage, 1).overlaps == ()
    assert side_in_front(stage) == "joined"
    assert stage.errors(CLIENT) == []


def test_a_hint_of_another_frame_is_carried_to_the_one_in_sight(tmp_path: Path) -> None:
    stage = Stage(tmp_path)
    stage.greet(CLIENT)
    stage.announce(CLIENT, 1, draw_ball(SIZE))
    moved = np.roll(draw_ball(SIZE), 7, axis=0)
    stage.announce(CLIENT, 4, moved)
    stage.set_scene(CLIENT, scene(hint("right")))
    stage.look(CLIENT, 4, SIZE)
    (overlap,) = overlaps(stage, 4).overlaps
    assert overlap.hinted
    assert side_in_front(stage) == "right"


def bumped(x: float, frame: int = 1) -> Scene:
    """A scene with a bump at ``x``, in the middle row of the ball."""
    stroke = DepthStroke(frame, (DepthPoint(x, SIZE / 2),), "bump", 9.0, 1.0)
    return replace(default_scene(SIZE, SIZE), depth=Depth(strokes=(stroke,)))


def test_strokes_and_colours_shape_the_preview_and_are_undone(tmp_path: Path) -> None:
    stage = Stage(tmp_path)
    stage.greet(CLIENT)
    stage.announce(CLIENT, 1, draw_ball(SIZE))
    stage.announce(CLIENT, 4, np.roll(draw_ball(SIZE), 3, axis=0))
    near = Depth(colours=(DepthColour("#dc783c", nearer=0.2),))
    for frame in (1, 4):
        stage.set_scene(CLIENT, scene())
        stage.look(CLIENT, frame, SIZE)
        stage.settle()
        assert side_in_front(stage) == "joined"
        assert stage.renderer.surface is not None
        highest = stage.renderer.surface.relief.vertices[:, 2].max()
        stage.set_scene(CLIENT, bumped(SIZE / 2 - 10))
        stage.settle()
        assert side_in_front(stage) == "left"
        stage.set_scene(CLIENT, bumped(SIZE / 2 + 10))
        stage.settle()
        assert side_in_front(stage) == "right"
        stage.set_scene(CLIENT, replace(scene(), depth=near))
        stage.settle()
        assert stage.renderer.surface.relief.vertices[:, 2].max() > highest + 10
    assert stage.errors(CLIENT) == []


def test_strokes_and_colours_shape_files(tmp_path: Path) -> None:
    for number, shift in ((1, 0), (2, 5)):
        save_picture(tmp_path / f"w.{number:04d}.png", np.roll(draw_ball(SIZE), shift, axis=0))
    said = tmp_path / "said.json"
    settings = RenderSettings(inputs=(str(tmp_path / "w.%04d.png"),), output="", steady=False)

    def height(frame: int, depth: Depth) -> NDArray[np.float32]:
        whole = json.loads(encode_scene(replace(scene(), depth=depth)))
        said.write_text(json.dumps(whole["depth"]))
        asked = msgspec.structs.replace(settings, frames=str(frame), depth_hints=str(said))
        with Pipeline(ArrayCache(tmp_path / "cache"), predictor=FakePredictor()) as pipeline:
            prepared = first_frame(resolve_shot(asked), pipeline).prepare(pipeline)
            assert prepared.normals is None
        return prepared.height

    for frame, row in ((1, SIZE // 2), (2, SIZE // 2 + 5)):
        raised = height(frame, bumped(SIZE / 2).depth) - height(frame, Depth())
        assert raised[row, SIZE // 2] > 6
        assert abs(raised[row, SIZE // 2 - 14]) < 0.5
        near = height(frame, Depth(colours=(DepthColour("#dc783c", nearer=0.2),)))
        assert near[row, SIZE // 2] - height(frame, Depth())[row, SIZE // 2] > 10


@pytest.mark.parametrize("front", ["left", "right"])
def test_hints_shape_files_with_the_scene_or_without(
    run: Run, tmp_path: Path, front: FrontSide
) -> None:
    picture, said = tmp_path / "ball.png", tmp_path / "hints.json"
    save_picture(picture, draw_ball(SIZE))
    whole = json.loads(encode_scene(scene(hint(front))))
    said.write_text(json.dumps(whole["depth"]))
    (tmp_path / "scene.json").write_text(json.dumps(whole))
    sign = 1 if front == "left" else -1
    for given in ({"depth_hints": str(said)}, {"scene": str(tmp_path / "scene.json")}):
        settings = RenderSettings(inputs=(str(picture),), output="", **given)
        with Pipeline(ArrayCache(tmp_path / "cache"), predictor=FakePredictor()) as pipeline:
            prepared = first_frame(resolve_shot(settings), pipeline).prepare(pipeline)
        assert sign * step_of(prepared) > 0.1 * SIZE
        assert all(overlap.hinted for overlap in prepared.overlaps)
    height = tmp_path / "h.npy"
    assert run("height", picture, "-o", height, "--depth-hints", said).code == 0
    found = np.load(height)
    assert sign * (found[SIZE // 2, SIZE // 2 - 6] - found[SIZE // 2, SIZE // 2 + 6]) > 5


def test_a_hint_of_another_drawing_is_carried_in_files(tmp_path: Path) -> None:
    for number, shift in ((1, 0), (2, 5)):
        save_picture(tmp_path / f"w.{number:04d}.png", np.roll(draw_ball(SIZE), shift, axis=0))
    (tmp_path / "scene.json").write_bytes(encode_scene(scene(hint("left", frame=1))))
    settings = RenderSettings(
        inputs=(str(tmp_path / "w.%04d.png"),),
        output=str(tmp_path / "lit"),
        scene=str(tmp_path / "scene.json"),
        steady=False,
    )
    with Pipeline(ArrayCache(tmp_path / "cache"), predictor=FakePredictor()) as pipeline:
        shot = resolve_shot(msgspec.structs.replace(settings, frames="2"))
        shown = first_frame(shot, pipeline)
        assert [h.frame for h in shown.hints] == [1]
        assert step_of(shown.prepare(pipeline)) > 0.1 * SIZE
