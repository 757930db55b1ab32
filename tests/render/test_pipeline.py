"""The whole chain on small drawings: previews agree with finals, light comes from where it is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from lampblack.drawing import decompose_drawing
from lampblack.pipeline import Pipeline
from lampblack.scene import Ambient, AreaLight, Scene, default_scene
from lampblack.surface_maker import MAX_SURFACE_PX, surface_step
from support.drawings import draw_ball


def lit_from(x: float, y: float, size: int) -> Scene:
    light = AreaLight(x=x, y=y, z=size / 2, size=size / 5)
    return replace(default_scene(size, size), lights=(light,), ambient=Ambient(strength=0.1))


def brightness(picture: NDArray[np.uint8]) -> NDArray[np.float64]:
    result: NDArray[np.float64] = picture[..., :3].mean(axis=2) * (picture[..., 3] / 255)
    return result


def test_the_side_towards_the_light_is_brighter(pipeline: Pipeline) -> None:
    drawing = decompose_drawing(draw_ball(160))
    for x in (0, 160):
        lit = brightness(pipeline.render(drawing, lit_from(x, 80, 160)))
        left, right = lit[60:100, 40:60].mean(), lit[60:100, 100:120].mean()
        assert (left > 1.2 * right) if x == 0 else (right > 1.2 * left)
    for y in (0, 160):
        lit = brightness(pipeline.render(drawing, lit_from(80, y, 160)))
        above, below = lit[40:60, 60:100].mean(), lit[100:120, 60:100].mean()
        assert (above > 1.2 * below) if y == 0 else (below > 1.2 * above)


def test_alpha_and_line_are_the_artists_own(pipeline: Pipeline) -> None:
    picture = draw_ball(160)
    lit = pipeline.render(decompose_drawing(picture), lit_from(40, 40, 160))
    assert np.array_equal(lit[..., 3], picture[..., 3])
    ink = (picture[..., 3] == 255) & (picture[..., :3] == [20, 16, 24]).all(axis=2)
    assert ink.sum() > 100
    assert np.abs(lit[ink].astype(int) - picture[ink]).max() <= 2


def test_large_pictures_are_solved_small_and_composited_whole(pipeline: Pipeline) -> None:
    size = MAX_SURFACE_PX + 400
    picture = draw_ball(300, canvas=size)
    drawing = decompose_drawing(picture)
    assert surface_step(drawing) == 2
    assert pipeline.prepare(drawing).height.shape == (size // 2, size // 2)
    vertices = pipeline.prepare(drawing).relief(stride=2).vertices
    assert np.allclose(vertices[:, :2].mean(axis=0), size / 2, atol=2)
    assert np.ptp(vertices[:, 0]) == pytest.approx(240, abs=6)
    lit = pipeline.render(drawing, lit_from(size / 2 - 200, size / 2, size))
    assert lit.shape == picture.shape
    assert np.array_equal(lit[..., 3], picture[..., 3])
