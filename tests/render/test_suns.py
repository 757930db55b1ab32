"""Suns in Cycles: their irradiance, that they light all of the canvas alike, and their shadows."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from lampblack.camera import on_canvas, scene_in_view
from lampblack.colour import linear
from lampblack.composite import composite
from lampblack.render.client import RenderChild
from lampblack.render.passes import Passes
from lampblack.render.quality import Quality, Sampling
from lampblack.render.request import RenderRequest
from lampblack.scene import Ambient, AreaLight, Canvas, Scene
from support.drawings import draw_ball
from support.surfaces import height_relief, plane, surface

CANVAS = Canvas(96, 64)
MIDDLE = 48.0, 32.0


def quality(spp: int = 64) -> Quality:
    sampling = Sampling(1, 512, spp)
    return Quality(sampling, sampling, Sampling(0.5, 512, 16), 1, "high")


def sun(across: float, down: float, up: float, size: float = 10) -> AreaLight:
    """A sun that stands this far from the middle of the canvas."""
    x, y, z = MIDDLE[0] + across, MIDDLE[1] + down, up
    return AreaLight(x, y, z, size, kind="sun")


def lit(child: RenderChild, light: AreaLight, tilt: float = 0) -> np.ndarray:
    """Light on a plane that rises to the right by ``tilt`` degrees, away from its edges."""
    column = np.mgrid[: CANVAS.height, : CANVAS.width][1]
    rise = math.tan(math.radians(tilt)) * column
    relief = height_relief(rise, np.ones(rise.shape, bool))
    request = RenderRequest(surface(relief, 0.0), CANVAS, (light,), False, quality=quality())
    return child.render(request).lights[0].diffuse[8:-8, 8:-8]


@pytest.mark.parametrize("size", [1, 40, 120])
@pytest.mark.parametrize("distance", [20, 4000])
def test_a_facing_surface_has_its_drawn_colour(
    child: RenderChild, size: float, distance: float
) -> None:
    seen = lit(child, sun(0, 0, distance, size))
    assert seen.mean() == pytest.approx(1, abs=0.003)
    assert seen == pytest.approx(np.ones_like(seen), abs=0.06)


@pytest.mark.parametrize(("degrees", "tilt"), [(60, 0), (60, 30), (-50, 30), (0, 45)])
def test_light_is_the_cosine_of_the_angle_and_the_same_everywhere(
    child: RenderChild, degrees: float, tilt: float
) -> None:
    """``degrees`` from the view's axis to the right; the plane's normal leans to the left."""
    angle = math.radians(degrees)
    seen = lit(child, sun(300 * math.sin(angle), 0, 300 * math.cos(angle)), tilt)
    expected = max(0.0, math.cos(angle + math.radians(tilt)))
    assert seen == pytest.approx(np.full_like(seen, expected), abs=0.01)


def test_a_sun_behind_the_paper_leaves_its_front_dark(child: RenderChild) -> None:
    assert lit(child, sun(30, 0, -100)).max() < 1e-3


@pytest.mark.parametrize(("across", "down"), [(100, 0), (0, -100), (-70, 70)])
def test_the_shadow_of_a_post_points_away_from_the_sun(
    child: RenderChild, across: float, down: float
) -> None:
    """As long as the post is high, at 45 degrees."""
    row, column = np.mgrid[: CANVAS.height, : CANVAS.width]
    post = np.where((abs(row - 32) < 3) & (abs(column - 48) < 3), 14.0, 0.0)
    relief = height_relief(post, np.ones(post.shape, bool))
    up = math.hypot(across, down)
    request = RenderRequest(
        surface(relief, 0.0), CANVAS, (sun(across, down, up),), False, quality=quality()
    )
    light = child.render(request).lights[0].diffuse[..., 1]
    dark = (light < 0.2) & (post == 0) & (np.minimum(column, 95 - column) > 4)
    dark &= np.minimum(row, 63 - row) > 4
    away = np.array([column[dark].mean() - 47.5, row[dark].mean() - 31.5])
    towards = np.array([across, down]) / up
    assert away @ -towards > 0.98 * np.hypot(*away)
    reach = (np.stack([column[dark] - 47.5, row[dark] - 31.5], axis=1) @ -towards).max()
    assert reach == pytest.approx(14 + 3, abs=3)


def test_a_sun_over_a_drawing_gives_the_drawing_back(child: RenderChild) -> None:
    """Through the whole composite: power 1, straight from the front, on a flat surface."""
    from lampblack.drawing import decompose_drawing

    drawing = decompose_drawing(draw_ball(64))
    scene = Scene(Canvas(64, 64), (AreaLight(32, 32, 90, 20, kind="sun"),), Ambient(strength=0))
    request = RenderRequest(
        plane(64, 64), scene.canvas, scene.lights, ambient=False, quality=quality()
    )
    found = child.render(request)
    picture = composite(drawing, Passes(found.lights, found.ambient), scene)
    inside = drawing.coverage == 1
    assert linear(picture[inside] / 255) == pytest.approx(
        linear(drawing.pixels[inside] / 255), abs=0.03
    )


@pytest.mark.parametrize(
    "camera", [(1, 0, -30, 0, 1, 12.5), (2, 0, 5, 0, 2, 7), (0, -1, 64, 1, 0, 0)]
)
def test_a_camera_turns_a_sun_but_does_not_shift_it(camera: tuple[float, ...]) -> None:
    scene = Scene(CANVAS, (sun(40, -20, 60, 30),))
    seen = scene_in_view(scene, camera, (200, 100))  # type: ignore[arg-type]
    light, scale = seen.lights[0], math.sqrt(camera[0] * camera[4] - camera[1] * camera[3])
    offset = np.array([light.x - seen.canvas.width / 2, light.y - seen.canvas.height / 2])
    turned = np.array([[camera[0], camera[1]], [camera[3], camera[4]]]) @ [40, -20]
    assert offset == pytest.approx(turned)
    assert (light.z, light.size) == pytest.approx((60 * scale, 30 * scale))


def test_a_sun_shines_from_the_same_side_on_another_canvas() -> None:
    scene = Scene(CANVAS, (sun(40, -20, 60), replace(sun(40, -20, 60), kind="lamp")))
    moved = on_canvas(scene, Canvas(200, 100)).lights
    assert (moved[0].x, moved[0].y) == (140, 30)
    assert (moved[1].x, moved[1].y) == (88, 12)
