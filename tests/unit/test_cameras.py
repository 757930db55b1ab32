"""Cameras of Pencil2D's projects: what each frame shows, as the rules of 0.6 and of 0.7 say."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import ndimage

from lampblack.errors import LampblackWarning
from lampblack.project import read_project
from lampblack.project.camera_layer import Camera
from lampblack.project.easing import CURVES, eased
from lampblack.project.shot import ProjectShot
from support.drawings import draw_ball
from support.projects import (
    document,
    exported,
    image,
    installed_version,
    layer,
    needs_pencil2d,
    png,
    write_project,
)
from support.registration import offset

FILES = {"ball.png": png(draw_ball(90))}
BALL = layer(2, "figure", [image(1, "ball.png")])

MOVES = {
    "pan": '<camera frame="1" dx="-41" dy="18"/><camera frame="9" dx="30"/>',
    "turn and zoom": '<camera frame="1" dx="10" s="1.2"/>'
    '<camera frame="9" r="30" s="1.9" dx="-20" dy="8"/>',
    "roll": '<camera frame="1" s="1.5"/><camera frame="9" r="360" s="1.5"/>',
    "turn": '<camera frame="1" s="1.8"/><camera frame="9" r="120" s="1.8"/>',
}
EASED = {
    "ease and bend": '<camera frame="1" r="-20" s="1.3" dx="10" easing="3" pathCPX="20" '
    'pathCPY="35"/><camera frame="6" r="30" s="1.8" dx="-30" dy="18" easing="12" pathCPX="-10" '
    'pathCPY="5"/><camera frame="11" r="90" s="1.4" dx="20" dy="-8"/>',
}


def speckled(side: int) -> NDArray[np.uint8]:
    noise = np.random.default_rng(5).normal(size=(side, side, 3))
    smooth = ndimage.gaussian_filter(noise, (2.5, 2.5, 0))
    colour = np.clip(smooth / smooth.std() * 50 + 128, 0, 255)
    return np.dstack([colour, np.full((side, side), 255)]).astype(np.uint8)


@needs_pencil2d
@pytest.mark.parametrize("move", [*MOVES, *EASED])
def test_a_moving_camera_shows_what_pencil2d_shows(tmp_path: Path, move: str) -> None:
    """Every part of every frame lies where the installed Pencil2D exports it."""
    version = installed_version()
    if move in EASED and version.startswith("0.6"):
        pytest.skip("this Pencil2D knows no easing")
    keys = (MOVES | EASED)[move]
    far = layer(2, "far", [image(1, "far.png", -350, -350)])
    xml = document([far], camera=keys, version=version)
    path = write_project(tmp_path / "walk.pclx", xml, {"far.png": png(speckled(700))})
    shot = ProjectShot(*read_project(path), {})
    frames = [shot.finish(frame, shot.cel(frame).pixels) for frame in shot.frames]
    for mine, truth in zip(frames, exported(path, 1, len(frames)), strict=True):
        for part in (np.s_[y : y + 60, x : x + 60] for y in (0, 50, 100) for x in (0, 70, 140)):
            assert np.hypot(*offset(truth[part], mine[part])) < 0.5


def camera_of(tmp_path: Path, keys: str, version: str = "v0.7.2") -> Camera:
    xml = document([BALL], camera=keys, version=version)
    project, _ = read_project(write_project(tmp_path / "c.pclx", xml, FILES))
    return project.cameras[0]


def shift(camera: Camera, frame: int) -> tuple[float, float]:
    """Where the middle of the canvas is in the picture, from its middle."""
    a, b, c, d, e, f = camera.at(frame)
    return a * 100 + b * 80 + c - 100, d * 100 + e * 80 + f - 80


@pytest.mark.parametrize("version", ["v0.7.2", "0.0.0.0", "0.8.0", ""])
def test_cameras_of_new_projects_turn_and_grow_evenly(tmp_path: Path, version: str) -> None:
    """Debian's 0.7.0 saves no version that tells, but an attribute that older ones do not."""
    keys = '<camera frame="1"/><camera frame="5" r="90" s="3"/>'
    a, b, _, d, e, _ = camera_of(tmp_path, keys, version).at(3)
    half = 2 * np.sqrt(0.5)
    assert (a, b, d, e) == pytest.approx((half, -half, half, half))


def test_a_camera_of_an_old_project_mixes_matrices(tmp_path: Path) -> None:
    keys = '<camera frame="1"/><camera frame="5" r="90" s="3"/>'
    a, b, _, d, e, _ = camera_of(tmp_path, keys, "0.6.6").at(3)
    assert (a, b, d, e) == pytest.approx((0.5, -1.5, 1.5, 0.5))


def test_a_full_turn_is_a_turn(tmp_path: Path) -> None:
    camera = camera_of(tmp_path, '<camera frame="1"/><camera frame="5" r="360"/>')
    assert camera.at(3)[0] == pytest.approx(-1)
    assert camera.at(2)[1] == pytest.approx(-1)


@pytest.mark.parametrize(
    ("easing", "places"), [(0, (10, 20, 30)), (1, (2.5, 10, 22.5)), (3, (5, 20, 35))]
)
def test_cameras_ease(tmp_path: Path, easing: int, places: tuple[float, ...]) -> None:
    """Measured in Pencil2D 0.7.0, to whole pixels: 3, 10, 23 and 5, 20, 35."""
    keys = f'<camera frame="1" easing="{easing}"/><camera frame="5" dx="40"/>'
    camera = camera_of(tmp_path, keys)
    assert [shift(camera, n)[0] for n in (2, 3, 4)] == pytest.approx(places)


def test_cameras_follow_a_curved_path(tmp_path: Path) -> None:
    """Measured in Pencil2D 0.7.0, to whole pixels: -9, -5, 11 and -22, -30, -22."""
    keys = '<camera frame="1" pathCPX="30" pathCPY="60"/><camera frame="5" dx="40"/>'
    camera = camera_of(tmp_path, keys)
    places = [shift(camera, n) for n in (2, 3, 4)]
    assert np.allclose(places, [(-8.75, -22.5), (-5, -30), (11.25, -22.5)])


def test_easing_curves_are_those_of_qt() -> None:
    """Values at a quarter, computed by QEasingCurve of Qt 5.15."""
    quarter = {
        1: 0.0625, 2: 0.4375, 4: 0.375, 5: 0.015625, 9: 0.00390625, 13: 0.000976562,
        17: 0.076120467, 21: 0.004524272, 22: 0.824046528, 23: 0.015125, 25: 0.031754163,
        29: -0.005524272, 33: -0.064136563, 35: -0.099681841, 37: 0.02734375, 40: 0.265625,
    }  # fmt: skip
    assert {n: eased(n, 0.25) for n in quarter} == pytest.approx(quarter, abs=1e-6)
    assert set(CURVES) == set(range(1, 41))
    for number in CURVES:
        assert eased(number, 0) == pytest.approx(0, abs=1e-3)
        assert eased(number, 1) == pytest.approx(1, abs=1e-3)


def test_an_unknown_easing_is_told(tmp_path: Path) -> None:
    with pytest.warns(LampblackWarning, match="number 99"):
        camera_of(tmp_path, '<camera frame="1" easing="99"/><camera frame="5" dx="40"/>')
