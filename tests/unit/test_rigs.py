"""Rigs: placed on canvases and figures, in files, on the command line, and in small pictures."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lampblack.camera import box_on_canvas
from lampblack.drawing import DrawingPlanes
from lampblack.errors import SceneError
from lampblack.finals.resolve import resolve_shot
from lampblack.finals.settings import RenderSettings
from lampblack.pipeline import Pipeline
from lampblack.preview.rig_pictures import placed_presets, rig_pictures
from lampblack.preview.sketch import SketchedSurface
from lampblack.protocol import ErrorMessage, GetNormals, GetRigs, Normals, Rigs
from lampblack.rigs import PRESETS, find_rig, preset, preset_name, rig_of, with_rig
from lampblack.scene import (
    Ambient,
    AreaLight,
    Canvas,
    LightKey,
    Look,
    Rig,
    Rim,
    Scene,
    decode_rig,
    default_scene,
    encode_rig,
    encode_scene,
)
from support.command_line import Run
from support.drawings import draw_ball
from support.preview_fakes import Stage

LAMP = AreaLight(300, 200, 400, 150, "#ffaa00", 1.5)
SUN = replace(LAMP, kind="sun")
RIG = Rig(Canvas(1000, 800), "Dusk", (LAMP, SUN), Ambient("#334455", 0.2))
ONE = b"one"


def irradiance(light: AreaLight, canvas: Canvas, at: tuple[float, float]) -> float:
    """Of a facing surface on the axis of a lamp, at the height 0."""
    radius = light.size / 2 / canvas.default_height
    distance = np.linalg.norm([light.x - at[0], light.y - at[1], light.z]) / canvas.default_height
    return float(light.power * (1 + radius**2) / (distance**2 + radius**2))


def test_a_rig_on_its_own_canvas_is_the_scene_it_came_from() -> None:
    scene = Scene(Canvas(640, 480), (LAMP, SUN), Ambient("#334455", 0.2))
    again = with_rig(replace(scene, lights=(), ambient=Ambient()), rig_of(scene, "mine"))
    assert again == scene
    rimmed = replace(RIG, rim=Rim(width=12))
    smaller = with_rig(Scene(Canvas(500, 400), look=Look(tones=(0.4,))), rimmed)
    assert (smaller.look, smaller.rim) == (Look(tones=(0.4,)), Rim(width=6))


@pytest.mark.parametrize("box", [None, (30, 40, 200, 100), (-50, 300, 100, 700)])
def test_light_on_the_figure_is_that_on_the_rigs_canvas(
    box: tuple[float, float, float, float] | None,
) -> None:
    canvas = Canvas(900, 1400)
    lit = with_rig(Scene(canvas), RIG, box)
    lamp, sun = lit.lights
    x, y, width, height = box or (0, 0, 900, 1400)
    scale = max(width, height) / 1000
    middle = x + width / 2, y + height / 2
    assert (lamp.x, lamp.y) == pytest.approx(
        (middle[0] + scale * (300 - 500), middle[1] + scale * (200 - 400))
    )
    beneath = irradiance(replace(LAMP, x=0, y=0), RIG.canvas, (0, 0))
    assert irradiance(replace(lamp, x=0, y=0), canvas, (0, 0)) == pytest.approx(beneath)
    # A sun has its direction and angle from wherever the box lies.
    assert (sun.x - 450, sun.y - 700, sun.z) == pytest.approx(
        (scale * (300 - 500), scale * (200 - 400), scale * 400)
    )
    assert (sun.power, sun.size) == pytest.approx((1.5, scale * 150))
    assert lit.ambient == RIG.ambient


def test_keys_are_placed_too() -> None:
    keyed = replace(LAMP, keys=(LightKey(5, 500, 400, 100, 50, power=2),))
    lit = with_rig(Scene(Canvas(500, 400)), replace(RIG, lights=(keyed,)))
    (key,) = lit.lights[0].keys
    assert (key.frame, key.x, key.y, key.z, key.size) == (5, 250, 200, 50, 25)
    assert key.power == pytest.approx(2)


@pytest.mark.parametrize("name", PRESETS)
def test_every_preset_is_a_whole_rig(name: str) -> None:
    rig = preset(name)
    assert preset_name(rig.name) == name
    assert rig.lights
    assert all(light.name for light in rig.lights)
    assert rig.extra == {}
    assert decode_rig(encode_rig(rig)) == rig
    assert find_rig(f" {rig.name.upper()} ") is rig


def test_a_file_may_have_unknown_fields_but_no_wrong_ones(tmp_path: Path) -> None:
    path = tmp_path / "mine.json"
    tree = json.loads(encode_rig(RIG))
    path.write_text(json.dumps({**tree, "fog": 1}))
    assert find_rig(str(path)) == replace(RIG, extra={"fog": 1})
    for wrong in (
        {"lights": tree["lights"] * 5},
        {"canvas": {"width": 0, "height": 1}},
        {"version": 2},
        {"name": "x" * 81},
    ):
        path.write_text(json.dumps({**tree, **wrong}))
        with pytest.raises(SceneError):
            find_rig(str(path))
    path.write_bytes(b" " * (2 << 20))
    with pytest.raises(SceneError, match="cannot be read: Larger than 1024 KiB"):
        find_rig(str(path))
    with pytest.raises(SceneError, match="There is no rig"):
        find_rig(str(tmp_path / "none.json"))
    with pytest.raises(SceneError, match="cannot be read: Is a directory"):
        find_rig(str(tmp_path))


def test_the_command_line_lights_with_a_rig(ball_png: Path, tmp_path: Path, run: Run) -> None:
    def scene_with(**fields: object) -> Scene:
        settings = RenderSettings(inputs=(str(ball_png),), output="o", **fields)  # type: ignore[arg-type]
        return resolve_shot(settings.absolute()).overrides.scene(Canvas(500, 500))

    moon = scene_with(rig="moon")
    assert moon.lights[0].kind == "sun"
    assert moon == with_rig(default_scene(500, 500), preset("moon"))
    assert len(scene_with(rig="moon", lights=("1,2,3",)).lights) == 1
    scene, rig = tmp_path / "scene.json", tmp_path / "rig.json"
    scene.write_bytes(encode_scene(Scene(Canvas(300, 300), (LAMP,))))
    assert run("rig", "save", scene, "-o", rig, "--name", "Mine").code == 0
    assert decode_rig(rig.read_bytes()) == Rig(Canvas(300, 300), "Mine", (LAMP,))
    assert scene_with(rig=str(rig)).lights[0].x == pytest.approx(500)
    shown = run("rig", "show", rig)
    assert decode_rig(shown.out.encode()) == decode_rig(rig.read_bytes())
    assert all(name in run("rig", "list").out for name in PRESETS)
    assert "There is no rig" in run("render", ball_png, "-o", tmp_path / "lit", "--rig", "nix").err


def test_sketched_light_is_lamberts(pipeline: Pipeline) -> None:
    """On a flat surface in the open, for a sun and for a lamp."""
    prepared = pipeline.prepare_quick(DrawingPlanes(draw_ball(128)))
    assert prepared.normals is not None
    tilt = np.array([0.6, 0.0, 0.8], np.float32)
    flat = replace(
        prepared,
        height=np.zeros_like(prepared.height),
        mask=np.ones_like(prepared.mask),
        normals=np.broadcast_to(tilt, prepared.normals.shape).copy(),
    )
    canvas = Canvas(128, 128)
    sun = AreaLight(64 + 30, 64, 40, 5, kind="sun")
    lamp = AreaLight(64, 64, 100, 30)
    scene = Scene(canvas, (sun, lamp, replace(sun, on=False)))
    found = SketchedSurface.of(flat, (0, 0, 128, 128), (64, 64)).passes(scene)
    assert found.lights[0].diffuse[8:-8, 8:-8] == pytest.approx(0.6 * 0.6 + 0.8 * 0.8, abs=1e-3)
    axis = found.lights[1].diffuse[32, 32, 0]
    assert axis == pytest.approx(0.8 * irradiance(replace(lamp, power=1), canvas, (64, 64)), 0.03)
    assert not found.lights[2].diffuse.any()


def test_a_sketched_shadow_lies_behind_what_throws_it(pipeline: Pipeline) -> None:
    prepared = pipeline.prepare_quick(DrawingPlanes(draw_ball(128)))
    height = np.zeros_like(prepared.height)
    rows, columns = height.shape
    middle = np.s_[rows // 2 - 3 : rows // 2 + 3, columns // 2 - 3 : columns // 2 + 3]
    height[middle] = 16
    post = replace(
        prepared,
        height=height,
        mask=np.ones_like(prepared.mask),
        normals=np.broadcast_to(np.array([0, 0, 1], np.float32), prepared.normals.shape).copy(),
    )
    scene = Scene(Canvas(128, 128), (AreaLight(64 - 60, 64, 50, 5, kind="sun"),))
    light = SketchedSurface.of(post, (0, 0, 128, 128), (64, 64)).passes(scene).lights[0].diffuse
    assert light[32, 36:40].mean() < 0.6 * light[32, 22:26].mean()
    assert light[20, 32].mean() == pytest.approx(light[32, 24].mean(), rel=0.05)


def test_pictures_follow_their_rigs_and_the_camera(pipeline: Pipeline) -> None:
    ball = draw_ball(128)
    prepared = pipeline.prepare_quick(DrawingPlanes(ball)).compact()
    scene = default_scene(256, 256)
    camera = (0.5, 0.0, 0.0, 0.0, 0.5, 0.0)
    rigs = placed_presets(prepared, scene, camera)
    left, top, width, _ = box_on_canvas(prepared.box, camera)
    assert (left, top) == (2 * prepared.box[0], 2 * prepared.box[1])
    lantern = rigs[PRESETS.index("lantern")].lights[0]
    assert lantern.x > left + 0.6 * width
    left_lit = Rig(scene.canvas, "", (AreaLight(0, 128, 60, 20, kind="sun"),), Ambient(strength=0))
    dark = replace(left_lit, lights=())
    found = rig_pictures(prepared, scene, camera, [*rigs, left_lit, dark], 96)
    pictures = found.reshape(len(rigs) + 2, 96, 96, 4).astype(int)
    assert (pictures[:, 48, 48, 3] == 255).all()
    assert (pictures[:, 0, 0, 3] == 0).all()
    lit = pictures[-2]
    assert lit[48, 24, :3].sum() > 2 * lit[48, 72, :3].sum()
    assert pictures[-1][48, 48, :3].max() < 10
    orange, blue = (pictures[PRESETS.index(name)].sum(axis=(0, 1)) for name in ("sunset", "moon"))
    assert orange[0] / orange[2] > 1.5 * blue[0] / blue[2]


def test_a_client_gets_the_normals_of_a_drawing(tmp_path: Path) -> None:
    stage = Stage(tmp_path)
    stage.greet(ONE)
    stage.set_scene(ONE, default_scene(64, 64))
    digest = stage.announce(ONE, 1, draw_ball(64))
    request = stage.next_request(ONE)
    stage.handle(ONE, GetNormals(request=request, frame=1, side=32))
    answer = stage.wait_for(ONE, Normals)
    assert (answer.message.request, answer.message.digest) == (request, digest)
    picture = answer.planes["picture"].astype(float)
    assert picture.shape == (32, 32, 4)
    assert not picture[0, 0].any()
    assert picture[16, 16, 3] == 255
    x, y, z = picture[16, 16, :3] / 127.5 - 1
    assert z > 0.7
    assert x**2 + y**2 + z**2 == pytest.approx(1, abs=0.1)


def test_a_client_gets_rigs_that_it_can_use_and_their_pictures(tmp_path: Path) -> None:
    stage = Stage(tmp_path)
    stage.greet(ONE)
    digest = stage.announce(ONE, 1, draw_ball(64))
    own = encode_rig(RIG).decode().strip()
    request = stage.next_request(ONE)
    stage.handle(ONE, GetRigs(request=request, frame=1))
    assert stage.wait_for(ONE, ErrorMessage).message.code == "no_scene"
    stage.set_scene(ONE, default_scene(64, 64))
    answers: list[tuple[Rigs, np.ndarray]] = []
    for asked in (GetRigs, lambda **fields: GetRigs(presets=False, side=32, **fields)):
        request = stage.next_request(ONE)
        stage.handle(ONE, asked(request=request, frame=1, rigs=(own,)))
        answer = stage.wait_for(ONE, Rigs)
        assert (answer.message.request, answer.message.digest) == (request, digest)
        answers.append((answer.message, answer.planes["picture"]))
    (everything, pictures), (mine, picture) = answers
    assert everything.names == (*PRESETS, "")
    assert pictures.shape == (96 * (len(PRESETS) + 1), 96, 4)
    assert decode_rig(everything.rigs[-1].encode()).lights[0].x == pytest.approx(300 * 0.064)
    assert (mine.names, picture.shape) == (("",), (32, 32, 4))
    request = stage.next_request(ONE)
    stage.handle(ONE, GetRigs(request=request, frame=1, rigs=("{}",)))
    fault = stage.wait_for(ONE, ErrorMessage).message
    assert (fault.code, fault.request) == ("bad_field", request)
