"""Scenes for Blender, opened again by it."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from lampblack.drawing import load_picture, save_picture
from lampblack.scene import Ambient, AreaLight, Floor, Material, default_scene, encode_scene
from support.command_line import Run, files
from support.drawings import draw_ball

SIZE = (96, 80)


OPEN_AND_RENDER = """
import sys, bpy
bpy.ops.wm.open_mainfile(filepath=sys.argv[1])
scene = bpy.context.scene
assert scene.camera.data.type == "ORTHO"
assert {thing.name for thing in scene.objects} == {
    "figure", "floor", "camera", "light 1", "light 2"}
assert scene.objects["floor"].is_shadow_catcher
scene.objects["floor"].hide_render = True
scene.render.filepath = sys.argv[2]
scene.render.threads_mode, scene.render.threads = "FIXED", 1
bpy.ops.render.render(write_still=True)
"""


def test_a_blend_renders_as_the_picture_does(run: Run, tmp_path: Path) -> None:
    width, height = SIZE
    drawing = np.zeros((height, width, 4), np.uint8)
    drawing[8:72, 16:80] = draw_ball(64)
    drawing[8:40, 16:80, :3][draw_ball(64)[:32, :, 0] == 220] = (60, 120, 220)
    save_picture(tmp_path / "ball.png", drawing)
    scene = replace(
        default_scene(*SIZE),
        lights=(
            AreaLight(10, 10, 50, colour="#ffd0a0", power=0.7),
            AreaLight(90, 70, 40, colour="#a0c0ff", power=0.4),
        ),
        ambient=Ambient(colour="#fff0e0", strength=0.25),
        materials={"#3c78dc": Material(diffuse=False)},
        floor=Floor(72),
    )
    (tmp_path / "scene.json").write_bytes(encode_scene(scene))
    words = ("--scene", tmp_path / "scene.json", "--quality", "final")
    blend, shown = tmp_path / "ball.blend", tmp_path / "shown.png"
    assert run("export", tmp_path / "ball.png", "-o", blend, *words).code == 0
    assert files(tmp_path) == {"ball.png", "scene.json", "ball.blend"}
    subprocess.run(
        [sys.executable, "-c", OPEN_AND_RENDER, str(blend), str(shown)],
        check=True, capture_output=True, timeout=240,
    )  # fmt: skip
    assert run("render", tmp_path / "ball.png", "-o", tmp_path / "lit", *words).code == 0
    theirs, ours = load_picture(shown), load_picture(tmp_path / "lit" / "ball.png")
    inside = (drawing[..., 3] == 255) & (theirs[..., 3] == 255)
    assert inside.sum() > 1500
    off = np.abs(theirs[inside][:, :3].astype(int) - ours[inside][:, :3])
    assert np.median(off) <= 6
    assert off.mean() < 10
