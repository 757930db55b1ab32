"""The command line as people meet it: what each command makes."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import trimesh

from lampblack.drawing import load_picture, save_picture
from lampblack.scene import decode_scene
from support.command_line import Run, files
from support.drawings import draw_ball


def test_held_frames_cost_nothing(run: Run, tmp_path: Path, unrendered: list[str]) -> None:
    drawings = tmp_path / "in"
    drawings.mkdir()
    for number in range(1, 7):
        save_picture(drawings / f"{number}.png", draw_ball(96, (200, 40 + number // 4 * 90, 60)))
    assert run("render", drawings, "-o", tmp_path / "lit").code == 0
    assert len(unrendered) == 2
    assert len(files(tmp_path / "lit")) == 6


def test_frames_are_chosen_by_number(run: Run, tmp_path: Path, unrendered: list[str]) -> None:
    for number in range(1, 8):
        save_picture(tmp_path / f"a{number:04d}.png", draw_ball(64, (30 * number, 40, 60)))
    pattern, out = tmp_path / "a%04d.png", tmp_path / "lit"
    assert run("render", pattern, "-o", out, "--frames", "1-5x2,7").code == 0
    assert files(out) == {f"a{n:04d}.png" for n in (1, 3, 5, 7)}
    partly = run("render", pattern, "-o", out, "--frames", "6-9")
    assert partly.code == 0
    assert "8, 9" in partly.err
    missed = run("render", pattern, "-o", out, "--frames", "90")
    assert missed.code == 1
    assert "1 to 7" in missed.err


def test_normals_mesh_palette_and_scene(run: Run, tmp_path: Path, ball_png: Path) -> None:
    array = tmp_path / "ball.npy"
    assert run("normals", ball_png, "-o", array, "--grids", 1).code == 0
    normals = np.load(array, allow_pickle=False)
    mask = draw_ball()[..., 3] > 127
    assert normals.shape == (160, 160, 3)
    assert normals.dtype == np.float32
    assert np.allclose(np.linalg.norm(normals[mask], axis=1), 1, atol=1e-5)
    # A ball: the left looks left, the top looks up.
    assert normals[80, 25, 0] < -0.3 < 0.3 < normals[80, 135, 0]
    assert normals[25, 80, 1] > 0.3 > -0.3 > normals[135, 80, 1]

    assert run("normals", ball_png, "-o", tmp_path / "ball.normals.png").code == 0
    assert (load_picture(tmp_path / "ball.normals.png")[..., 3] > 0).sum() > 0.95 * mask.sum()

    mesh = tmp_path / "ball.glb"
    assert run("mesh", ball_png, "-o", mesh, "--stride", 4).code == 0
    assert trimesh.load_mesh(mesh).is_watertight

    height = tmp_path / "ball.height.npy"
    assert run("height", ball_png, "-o", height).code == 0
    found = np.load(height, allow_pickle=False)
    assert (found.shape, found.dtype) == ((160, 160), np.float32)
    assert np.array_equal(np.isfinite(found), mask)
    assert found[80, 80] > found[80, 40] + 5 > found[80, 20] + 10
    depth = tmp_path / "ball.depth.png"
    assert run("depth", ball_png, "-o", depth).code == 0
    seen = load_picture(depth).astype(int)
    assert seen[80, 80, 0] > seen[80, 40, 0] > seen[80, 20, 0]
    assert np.array_equal(seen[..., 3] > 0, mask)

    listed = run("palette", ball_png, "--json")
    assert json.loads(listed.out)[0]["colour"] == "#dc783c"
    assert "#dc783c" in run("palette", ball_png).out

    scene = tmp_path / "ball.json"
    assert run("scene", ball_png, "-o", scene).code == 0
    assert decode_scene(scene.read_bytes()).canvas.width == 160
    assert "#dc783c" in decode_scene(scene.read_bytes()).materials


def test_the_number_of_a_pattern_may_stand_anywhere(
    run: Run, tmp_path: Path, unrendered: list[str]
) -> None:
    for number in (2, 10):
        save_picture(tmp_path / f"w_{number}_final.png", draw_ball(64, (9 * number, 40, 60)))
    out = tmp_path / "lit"
    assert run("render", tmp_path / "w_%d_final.png", "-o", out, "--frames", "10").code == 0
    assert files(out) == {"w_10_final.png"}
