"""The previews' composite agrees with the finals', to the byte's rounding."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from lampblack.composite import composite
from lampblack.composite.byte_layers import byte_layers_of, premultiplied
from lampblack.composite.illumination import Illumination
from lampblack.drawing import decompose_drawing
from lampblack.render.passes import LightPasses, Passes
from lampblack.scene import Floor, Material, default_scene
from support.drawings import draw_ball

SIZE = 96
WHOLE = (0.0, 0.0, float(SIZE), float(SIZE))


def smooth(seed: int, low: float, high: float) -> NDArray[np.float32]:
    found = np.random.default_rng(seed).uniform(low, high, (12, 12, 3))
    return found.astype(np.float32)


def passes(floor: bool) -> LightPasses:
    cast = (smooth(3, 0.1, 0.6), smooth(4, 0.6, 0.9)) if floor else (None, None)
    return LightPasses(smooth(1, 0, 2), smooth(2, 0, 1.5), *cast)


@pytest.mark.parametrize("floor", [False, True])
@pytest.mark.parametrize("paper", [None, (200, 190, 150)])
@pytest.mark.parametrize(
    "material", [Material(), Material(glossy=True), Material(False, True), Material(False, False)]
)
def test_agrees_with_the_composite(
    floor: bool, paper: tuple[int, int, int] | None, material: Material
) -> None:
    picture = draw_ball(SIZE)
    if paper is not None:
        alpha = picture[..., 3:] / 255
        over = picture[..., :3] * alpha + np.array(paper) * (1 - alpha)
        picture = np.dstack([np.rint(over), np.full(alpha.shape, 255)]).astype(np.uint8)
    scene = default_scene(SIZE, SIZE)
    scene = replace(
        scene,
        ambient=replace(scene.ambient, strength=0.0),
        default_material=material,
        floor=Floor(80.0) if floor else None,
    )
    drawing = decompose_drawing(picture)
    given = passes(floor)
    dark = LightPasses(np.zeros((1, 1, 3), np.float32), np.zeros((1, 1, 3), np.float32))
    light = Passes((given,), dark)
    wanted = premultiplied(composite(drawing, light, scene))
    found = composite(byte_layers_of(drawing), light, scene)
    apart = np.abs(found.astype(int) - wanted)
    assert apart.max() <= 4
    assert apart.mean() < 0.6


@pytest.mark.parametrize("floor", [False, True])
def test_clear_line_art_agrees_too(floor: bool) -> None:
    rows, columns = np.mgrid[:SIZE, :SIZE] + 0.5 - SIZE / 2
    line = np.clip(1.4 - np.abs(np.hypot(rows, columns) - 36), 0, 1)
    picture = np.dstack([np.full((SIZE, SIZE, 3), 20), np.rint(255 * line)]).astype(np.uint8)
    drawing, given = decompose_drawing(picture), passes(floor)
    assert drawing.coverage[48, 48] == 1
    scene = default_scene(SIZE, SIZE)
    dim = replace(scene.lights[0], power=0.4)
    ambient = replace(scene.ambient, strength=0.0)
    scene = replace(scene, lights=(dim,), ambient=ambient, floor=Floor(80.0) if floor else None)
    dark = LightPasses(np.zeros((1, 1, 3), np.float32), np.zeros((1, 1, 3), np.float32))
    light = Passes((given,), dark)
    wanted = premultiplied(composite(drawing, light, scene))
    found = composite(byte_layers_of(drawing), light, scene)
    assert wanted[48, 48, 3] > 10
    assert np.abs(found.astype(int) - wanted).max() <= 4


def test_a_crop_is_that_part_of_the_whole() -> None:
    drawing = decompose_drawing(draw_ball(SIZE))
    scene = default_scene(SIZE, SIZE)
    given, weight = passes(False), np.ones(3, np.float32)
    light = Illumination([(weight, given.diffuse, given.glossy)], character_area=WHOLE)
    layers = byte_layers_of(drawing)
    whole = composite(layers, light, scene).astype(int)
    crop = (16.0, -8.0, 40.0, 48.0)
    part = composite(layers.cut(crop, (40, 48)), light, scene, crop).astype(int)
    assert not part[:8].any()
    assert np.abs(part[8:] - whole[:40, 16:56]).max() <= 3


def test_small_pictures_average_and_large_ones_stay_in_register() -> None:
    layers = byte_layers_of(decompose_drawing(draw_ball(SIZE)))
    half = layers.cut(WHOLE, (48, 48))
    averaged = layers.pixels.reshape(48, 2, 48, 2, 4).mean(axis=(1, 3))
    assert np.abs(half.pixels - averaged).max() <= 1
    twice = layers.cut(WHOLE, (192, 192))
    back = twice.coverage.reshape(96, 2, 96, 2).mean(axis=(1, 3))
    assert np.abs(back - layers.coverage).mean() < 2
    nothing = layers.cut((500.0, 500.0, 10.0, 10.0), (20, 20))
    assert not nothing.pixels.any()
    assert (nothing.labels == -1).all()
