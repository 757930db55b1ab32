"""Direct light, reflected light and cast shadows are told apart by the form of the surface."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from lampblack.composite import composite
from lampblack.composite.byte_layers import byte_layers_of, premultiplied
from lampblack.composite.form import Form
from lampblack.composite.illumination import Illumination
from lampblack.drawing import Drawing, decompose_drawing
from lampblack.render.passes import LightPasses, Passes
from lampblack.scene import Ambient, AreaLight, Canvas, Floor, Look, Scene

SIZE = 200
RADIUS = 60.0
TONE = 0.5
LOOK = Look(tones=(TONE,), softness=0.0, cast_strength=1.0, cast_colour="#802020")
SUN = AreaLight(-300, SIZE / 2, 400, kind="sun")
Floats = NDArray[np.float32]


def scene(look: Look = LOOK, floor: bool = False) -> Scene:
    plain = Scene(Canvas(SIZE, SIZE), lights=(SUN,), ambient=Ambient(strength=0.2), look=look)
    return replace(plain, floor=Floor(190.0) if floor else None)


@pytest.fixture(scope="module")
def pipe() -> Drawing:
    """An upright pipe of one colour."""
    picture = np.zeros((SIZE, SIZE, 4), np.uint8)
    picture[20:180, 40:160] = 200, 180, 160, 255
    return decompose_drawing(picture)


@pytest.fixture(scope="module")
def form(pipe: Drawing) -> Form:
    return Form.of(height(), pipe.mask, 1.0)


def height() -> Floats:
    across = np.abs(np.arange(SIZE) + 0.5 - SIZE / 2)
    rise = np.sqrt(np.maximum(RADIUS**2 - across**2, 0))
    return np.tile(rise.astype(np.float32), (SIZE, 1))


def cosine() -> Floats:
    """(SIZE, SIZE) light of the sun on the pipe, in closed form."""
    across = np.clip((np.arange(SIZE) + 0.5 - SIZE / 2) / RADIUS, -1, 1)
    way = np.array([-400.0, 400.0]) / np.hypot(400, 400)
    light = np.maximum(across * way[0] + np.sqrt(1 - across**2) * way[1], 0)
    return np.tile(light.astype(np.float32), (SIZE, 1))


def lit(drawing: Drawing, scene: Scene, light: Floats, form: Form | None) -> NDArray[np.uint8]:
    """The lit drawing; previews agree with it."""
    coarse = light.reshape(SIZE // 2, 2, SIZE // 2, 2).mean(axis=(1, 3))
    grey = np.repeat(coarse[..., None], 3, axis=2)
    dark = np.zeros((1, 1, 3), np.float32)
    passes = Passes((LightPasses(grey, dark),), LightPasses(np.ones_like(dark), dark))
    found = Illumination.of(passes, scene, form)
    picture = composite(drawing, found, scene)
    preview = composite(byte_layers_of(drawing), found, scene)
    assert np.abs(preview.astype(int) - premultiplied(picture)).max() <= 4
    return picture


def test_open_light_is_lamberts_cosine(form: Form) -> None:
    whole = form.within((0, 0, SIZE, SIZE))
    found = whole.open_light(scene(), (0, 0), None)
    step = SIZE / found.shape[1]
    columns = ((np.arange(found.shape[1]) + 0.5) * step).astype(int)
    inside = np.abs(columns - SIZE / 2) < 0.85 * RADIUS
    wanted = cosine()[100, columns]
    assert np.abs(found[found.shape[0] // 2] - wanted)[inside].max() < 0.06
    half = form.within((100, 0, 100, SIZE))
    beside = half.open_light(scene(), (100, 0), None)
    assert abs(beside[beside.shape[0] // 2, 2] - wanted[len(wanted) // 2 + 3]) < 0.08


def test_a_lamp_at_its_default_height_fully_lights_what_faces_it() -> None:
    flat = Form.of(np.zeros((50, 50), np.float32), np.ones((50, 50), bool), 2.0)
    lamp = AreaLight(51, 51, 50, power=0.7)
    lit = Scene(Canvas(100, 100), lights=(lamp,))
    assert flat.open_light(lit, (0, 0), None)[25, 25] == pytest.approx(0.7, abs=0.01)


def test_light_that_the_floor_reflects_leaves_the_tones_as_they_are(
    pipe: Drawing, form: Form
) -> None:
    plain = Look(tones=(TONE,), softness=0.0)
    bright = scene(plain, floor=True)
    noise = np.random.default_rng(1).normal(0, 0.02, (40, 40)).repeat(5, 0).repeat(5, 1)
    reflected = cosine() + np.float32(TONE**2) + noise.astype(np.float32)
    wanted = lit(pipe, replace(bright, floor=None), cosine(), form)
    found = lit(pipe, bright, reflected, form)
    apart = np.abs(found.astype(int) - wanted).max(axis=2)[20:180, 40:160] > 8
    assert apart.mean() < 0.03
    without = lit(pipe, bright, reflected, None)
    assert (np.abs(without.astype(int) - wanted).max(axis=2)[20:180, 40:160] > 8).mean() > 0.1


def test_cast_shadows_have_a_tone_of_their_own(pipe: Drawing, form: Form) -> None:
    light = cosine()
    light[80:130] = 0  # something is in the way
    picture = lit(pipe, scene(), light, form)
    shade, cast, bright = picture[50, 150], picture[105, 70], picture[50, 70]
    assert len({tuple(shade), tuple(cast), tuple(bright)}) == 3
    assert cast[0] > 1.5 * cast[1]
    assert np.array_equal(picture[105, 150], shade)
    # Each of the three is one flat area: nothing else lies between, also where they meet.
    inner = picture[24:176, 44:156, :3].reshape(-1, 3).astype(int)
    near = np.min([np.abs(inner - tone[:3]).max(axis=1) for tone in (shade, cast, bright)], axis=0)
    assert (near > 3).mean() < 0.04
    plain = lit(pipe, scene(replace(LOOK, cast_strength=0.0)), light, form)
    assert np.array_equal(plain[105, 70], plain[50, 150])


def test_no_cast_shadow_lies_along_the_terminator(pipe: Drawing, form: Form) -> None:
    noise = np.random.default_rng(2).normal(0, 0.01, (SIZE, SIZE)).astype(np.float32)
    light = cosine() * np.float32(0.93) + noise  # the traced light never is quite the open light
    plain, cast = (
        lit(pipe, scene(replace(LOOK, cast_strength=strength)), light, form)
        for strength in (0.0, 1.0)
    )
    assert np.array_equal(plain, cast)
