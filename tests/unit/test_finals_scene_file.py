"""Scenes for other programs, opened again by one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import trimesh

from support.command_line import Run, files


def test_a_glb_has_the_relief_in_its_drawing(run: Run, tmp_path: Path, ball_png: Path) -> None:
    target = tmp_path / "ball.glb"
    assert run("export", ball_png, "-o", target).code == 0
    mesh = trimesh.load_mesh(target)
    # The ball's radius is 0.4 of a canvas whose half is 1; it looks at the viewer.
    assert np.allclose(mesh.bounds[:, :2], [[-0.8, -0.8], [0.8, 0.8]], atol=0.05)
    assert 0.2 < mesh.bounds[1, 2] < 1.2
    front = mesh.vertices[:, 2].argmax()
    u, v = mesh.visual.uv[front]
    picture = np.asarray(mesh.visual.material.baseColorTexture.convert("RGB"))
    colour = picture[int((1 - v) * picture.shape[0]), int(u * picture.shape[1])]
    assert np.abs(colour.astype(int) - [220, 120, 60]).max() <= 2
    places = mesh.vertices[:, :2] / 2 + 0.5
    assert np.allclose(mesh.visual.uv, places, atol=1e-3)


def test_scenes_that_cannot_be_written_are_told(run: Run, tmp_path: Path, ball_png: Path) -> None:
    assert run("export", ball_png, "-o", tmp_path / "ball.fbx").code == 1
    assert run("export", ball_png, "-o", tmp_path / "nowhere" / "ball.glb").code == 1
    assert run("export", ball_png, "-o", tmp_path / "ball.glb", "--frame", 3).code == 1
    assert files(tmp_path) == {"ball.png"}
