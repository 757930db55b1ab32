"""A layer named Light: its paint is light, in projects and in live sessions."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lampblack.choices import LayerRole
from lampblack.colour import linear
from lampblack.drawing import DrawingPlanes
from lampblack.drawing.painted import MOST_PX, painted_light
from lampblack.pipeline import Pipeline
from lampblack.project import read_project
from lampblack.project.shot import ProjectShot
from lampblack.protocol import Hello
from lampblack.scene import Ambient, Canvas, PaintedLight, Scene, default_scene
from support.drawings import draw_ball
from support.preview_fakes import Stage
from support.projects import document, image, layer, png, write_project

ONE, OLD = b"one", b"old"


def glow(side: int, colour: tuple[int, int, int, int] = (255, 128, 0, 255)) -> np.ndarray:
    """A painted patch in the upper left quarter."""
    picture = np.zeros((side, side, 4), np.uint8)
    picture[side // 8 : side // 4, side // 8 : side // 4] = colour
    return picture


def shot_of(
    folder: Path, roles: dict[str, LayerRole] | None = None, *, visible: bool = True
) -> ProjectShot:
    layers = [
        layer(2, "hero", [image(1, "hero.png", -40, -40)]),
        layer(3, "Light", [image(1, "glow.png", -40, -40)], visible=visible),
    ]
    pictures = {"hero.png": png(draw_ball(80)), "glow.png": png(glow(80))}
    path = write_project(folder / "a.pclx", document(layers), pictures)
    return ProjectShot(*read_project(path), roles or {})


def test_light_is_no_part_of_the_figure_and_is_not_shown(tmp_path: Path) -> None:
    shot = shot_of(tmp_path)
    frame = shot.frames[0]
    cel = shot.cel(frame)
    assert cel.light is not None
    hidden = shot_of(tmp_path, visible=False)
    plain = hidden.cel(hidden.frames[0])
    assert plain.light is None
    assert np.array_equal(cel.pixels, plain.pixels)
    assert np.array_equal(shot.finish(frame, cel.pixels), hidden.finish(frame, plain.pixels))
    assert frame.drawing != hidden.frames[0].drawing
    painted = painted_light(cel.light)
    assert painted is not None
    assert painted.max(axis=(0, 1)) == pytest.approx(
        linear(np.array([255, 128, 0]) / 255), abs=0.02
    )


def test_a_role_says_that_a_layer_of_this_name_is_a_character(tmp_path: Path) -> None:
    roles: dict[str, LayerRole] = {"Light": "character", "hero": "character"}
    shot = shot_of(tmp_path, roles)
    cel = shot.cel(shot.frames[0])
    assert cel.light is None
    assert tuple(cel.pixels[52, 72]) == (255, 128, 0, 255)
    background = shot_of(tmp_path, {"hero": "character", "Light": "background"})
    assert background.cel(background.frames[0]).light is not None


def test_paint_is_averaged_by_its_alpha() -> None:
    half = painted_light(glow(400, (255, 255, 255, 128)))
    assert half is not None
    assert max(half.shape) == MOST_PX
    assert half.max() == pytest.approx(128 / 255, abs=0.01)
    whole = linear(glow(400)[..., 0] / 255).mean()
    found = painted_light(glow(400))
    assert found is not None
    assert found[..., 0].mean() == pytest.approx(whole, rel=0.01)
    assert painted_light(np.zeros((9, 9, 4), np.uint8)) is None


def test_the_plane_shines_above_the_figure(pipeline: Pipeline) -> None:
    planes = DrawingPlanes(draw_ball(96), light=glow(96))
    scene = replace(
        default_scene(96, 96), lights=(), ambient=Ambient(strength=0),
        painted_light=PaintedLight(height=0.25),
    )  # fmt: skip
    for prepared in (pipeline.prepare(planes.decompose()), pipeline.prepare_quick(planes)):
        assert prepared.glows(scene) == {"painted": 0.25}
        surface = prepared.surface(scene, 2)
        plate = surface.emitters["painted"].vertices
        assert plate[:, 2] == pytest.approx(surface.relief.vertices[:, 2].max() + 12, abs=0.01)
        assert plate[:, :2].min() >= 96 / 8 - 2
        assert plate[:, :2].max() <= 96 / 4 + 2
        dark = replace(scene, painted_light=PaintedLight(power=0))
        assert prepared.glows(dark) == {}
        assert prepared.compact().glows(scene) == prepared.glows(scene)


def test_a_client_sends_light_as_a_layer(tmp_path: Path) -> None:
    ball = draw_ball(64)
    scene = Scene(Canvas(64, 64), (), Ambient(strength=0.1))
    traced = {}
    for client, minor in ((ONE, 3), (OLD, 2)):
        stage = Stage(tmp_path)
        stage.handle(client, Hello(minor=minor, client="test", client_version="1"))
        stage.announce(client, 1, ball, [("ball", ball), ("Light", glow(64))])
        stage.set_scene(client, scene)
        stage.look(client, 1, 64)
        stage.settle()
        assert stage.errors(client) == []
        traced[client] = {job.glow for job in stage.renderer.jobs}
        if client == ONE:
            bright = stage.picture(client).astype(int).sum()
            stage.set_scene(client, replace(scene, painted_light=PaintedLight(power=0.2)))
            stage.renderer.jobs.clear()
            stage.settle()
            assert stage.renderer.jobs == []
            assert stage.picture(client).astype(int).sum() < bright
    assert traced == {ONE: {None, "painted"}, OLD: {None}}
