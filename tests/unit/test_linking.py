"""Lights for some colours and layers, and colours that give light, in both kernels."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from lampblack.colour import hex_linear, linear, srgb
from lampblack.composite import composite
from lampblack.composite.byte_layers import byte_layers_of, premultiplied
from lampblack.composite.illumination import EMITTED
from lampblack.drawing import DrawingPlanes
from lampblack.drawing.drawing import Drawing
from lampblack.drawing.palette import Palette, Swatch
from lampblack.render.passes import LightPasses, Passes
from lampblack.scene import (
    Ambient,
    AreaLight,
    Canvas,
    Floor,
    Look,
    Material,
    Scene,
    decode_scene,
    encode_scene,
)
from support.drawings import draw_ball, layered_cel
from support.preview_fakes import Stage

WIDTH, HEIGHT = 40, 24
RED, BLUE = "#c83228", "#2846b4"
ONE = b"one"
LIGHT = AreaLight(20, 12, 20)


def split(soft: bool = False) -> Drawing:
    """Red on the left and blue on the right, of two layers: above and below."""
    row, column = np.mgrid[:HEIGHT, :WIDTH]
    share = np.clip(column - 19 if not soft else (column - 17.5) / 5, 0, 1)[..., None]
    red, blue = hex_linear(RED), hex_linear(BLUE)
    albedo = srgb(red + share * (blue - red)).astype(np.float32)
    labels = (column >= 20).astype(np.int16)
    everywhere = np.ones((HEIGHT, WIDTH), bool)
    none = np.zeros((HEIGHT, WIDTH), np.float32)
    pixels = np.dstack([np.rint(albedo * 255), np.full((HEIGHT, WIDTH), 255)]).astype(np.uint8)
    palette = Palette((Swatch(RED, 480), Swatch(BLUE, 480)))
    return Drawing(
        pixels, everywhere, none + 1, none, none, np.zeros((HEIGHT, WIDTH, 3), np.float32),
        albedo, labels, palette, owners=(row >= 12).astype(np.int8), layers=("above", "below"),
    )  # fmt: skip


def flat(diffuse: float, glossy: float = 0) -> LightPasses:
    shape = (HEIGHT, WIDTH, 3)
    return LightPasses(np.full(shape, diffuse, np.float32), np.full(shape, glossy, np.float32))


def scene(*lights: AreaLight, **fields: object) -> Scene:
    ambient = fields.pop("ambient", Ambient(strength=0))
    return Scene(Canvas(WIDTH, HEIGHT), lights, ambient, **fields)  # type: ignore[arg-type]


def both(drawing: Drawing, passes: Passes, lit: Scene) -> NDArray[np.float32]:
    """The picture of finals, scene-linear, after a check that that of previews is alike."""
    fine = composite(drawing, passes, lit)
    fast = composite(byte_layers_of(drawing), passes, lit)
    assert abs(premultiplied(fine).astype(int) - fast.astype(int)).max() <= 4
    return linear(fine[..., :3] / 255)


@pytest.mark.parametrize(
    ("fields", "lit"),
    [
        ({"colours": (RED,)}, [[1, 0], [1, 0]]),
        ({"colours": (BLUE, RED)}, [[1, 1], [1, 1]]),
        ({"colours": ("#123456",)}, [[0, 0], [0, 0]]),
        ({"layers": ("below",)}, [[0, 0], [1, 1]]),
        ({"layers": ("above", "below")}, [[1, 1], [1, 1]]),
        ({"layers": ("other",)}, [[0, 0], [0, 0]]),
        ({"colours": (BLUE,), "layers": ("above",)}, [[0, 1], [0, 0]]),
    ],
)
def test_a_light_lights_only_what_it_is_linked_to(
    fields: dict[str, tuple[str, ...]], lit: list[list[int]]
) -> None:
    drawing = split()
    linked = replace(LIGHT, **fields)  # type: ignore[arg-type]
    seen = both(drawing, Passes((flat(0.3), flat(0.5)), flat(0)), scene(LIGHT, linked))
    drawn = linear(drawing.albedo)
    for row, at in ((4, lit[0]), (20, lit[1])):
        for column, here in ((4, at[0]), (34, at[1])):
            expected = drawn[row, column] * (0.3 + 0.5 * here)
            assert seen[row, column] == pytest.approx(expected, abs=0.006)


def test_a_mixed_pixel_is_lit_as_its_parts_are() -> None:
    drawing = split(soft=True)
    linked = replace(LIGHT, colours=(BLUE,))
    seen = both(drawing, Passes((flat(0.2), flat(0.6)), flat(0)), scene(LIGHT, linked))[8]
    share = np.clip((np.arange(WIDTH) - 17.5) / 5, 0, 1)[:, None]
    expected = 0.2 * (1 - share) * hex_linear(RED) + 0.8 * share * hex_linear(BLUE)
    near = np.s_[19:21]  # a pixel beside both colours
    assert seen[near] == pytest.approx(expected[near], abs=0.02)
    away = np.r_[0:15, 25:WIDTH]
    assert seen[away] == pytest.approx(expected[away], abs=0.006)


def test_linked_lights_add_up_and_have_their_colours() -> None:
    drawing = split()
    warm = replace(LIGHT, colour="#ff8000", power=0.5, colours=(RED,))
    cold = replace(LIGHT, colour="#0080ff", power=0.4, layers=("above",))
    seen = both(drawing, Passes((flat(0.6), flat(0.8)), flat(0)), scene(warm, cold))
    light = 0.3 * hex_linear("#ff8000") + 0.32 * hex_linear("#0080ff")
    assert seen[4, 4] == pytest.approx(hex_linear(RED) * light, abs=0.006)
    assert seen[20, 4] == pytest.approx(hex_linear(RED) * 0.3 * hex_linear("#ff8000"), abs=0.006)
    assert seen[20, 34] == pytest.approx(np.zeros(3), abs=1e-4)


def test_a_linked_light_shines_on_glossy_colours_too() -> None:
    drawing = split()
    shiny = Material(glossy=True, gloss=0.5)
    lit = scene(replace(LIGHT, colours=(RED,)), default_material=shiny)
    seen = both(drawing, Passes((flat(0.2, 0.4),), flat(0)), lit)
    assert seen[4, 4] == pytest.approx(0.2 * hex_linear(RED) + 0.2, abs=0.006)
    assert seen[4, 34] == pytest.approx(np.zeros(3), abs=1e-4)


def test_a_linked_light_in_tones_agrees_in_both_kernels() -> None:
    drawing = split()
    linked = replace(LIGHT, colours=(RED,))
    lit = scene(LIGHT, linked, look=Look(tones=(0.4,)), ambient=Ambient(strength=0.2))
    seen = both(drawing, Passes((flat(0.9), flat(0.3)), flat(1)), lit)
    alone = both(drawing, Passes((flat(0.9), flat(0)), flat(1)), lit)
    assert seen[4, 4].max() > alone[4, 4].max()
    assert seen[4, 34] == pytest.approx(alone[4, 34])


def test_a_linked_light_leaves_the_floor_alone() -> None:
    drawing = split()
    empty = replace(drawing, coverage=drawing.coverage * 0, mask=drawing.mask & False)
    shape = (HEIGHT, WIDTH, 3)
    dark, white = np.full(shape, 0.2, np.float32), np.ones(shape, np.float32)
    traced = LightPasses(white, dark * 0, dark, white)
    plain = scene(LIGHT, floor=Floor(12))
    linked = scene(replace(LIGHT, colours=(RED,)), floor=Floor(12))
    ambient = flat(0)
    assert composite(empty, Passes((traced,), ambient), plain).mean() < 200
    assert np.array_equal(composite(empty, Passes((traced,), ambient), linked), drawing.pixels)


def test_layers_of_a_cel_are_known_by_name() -> None:
    ball = draw_ball(96)
    arm = np.zeros_like(ball)
    arm[40:56, 10:90] = ball[48, 48]
    cel = layered_cel(body=ball, arm=arm)
    drawing = DrawingPlanes(cel.pixels, layers=cel.layers).decompose()
    assert drawing.layers == tuple(layer.name for layer in cel.layers)
    assert drawing.owners is not None
    top = cel.layers[-1]
    solid = top.placed(drawing.size)[..., 3] >= 128
    assert (drawing.owners[solid] == len(cel.layers) - 1).all()
    assert (drawing.owners[cel.pixels[..., 3] == 0] == -1).all()


def test_a_preview_changes_links_without_a_trace(tmp_path: Path) -> None:
    stage = Stage(tmp_path)
    stage.greet(ONE)
    picture = split().pixels
    picture = np.pad(picture, ((8, 8), (8, 8), (0, 0)))
    stage.announce(ONE, 1, picture)
    stage.renderer.level = 0.5
    lit = Scene(Canvas(56, 40), (LIGHT,), Ambient(strength=0.1))
    stage.set_scene(ONE, lit)
    stage.look(ONE, 1, 40)
    stage.settle()
    before = stage.picture(ONE).copy()
    stage.renderer.jobs.clear()
    stage.set_scene(ONE, replace(lit, lights=(replace(LIGHT, colours=(RED,)),)))
    stage.settle()
    after = stage.picture(ONE)
    assert stage.renderer.jobs == []
    assert np.array_equal(after[20, 14], before[20, 14])
    assert after[20, 36].astype(int).sum() < before[20, 36].astype(int).sum()


def test_links_survive_a_file() -> None:
    lit = scene(replace(LIGHT, colours=(RED, BLUE), layers=("Arm é",), casts_shadow=False))
    assert decode_scene(encode_scene(lit)) == lit


@pytest.mark.parametrize("kind", [Material(), Material(diffuse=False)])
@pytest.mark.parametrize("emission", [0.1, 0.5, 3.0])
def test_an_emissive_colour_is_brighter_by_its_emission(kind: Material, emission: float) -> None:
    drawing = split()
    glowing = scene(LIGHT, materials={RED: replace(kind, emission=emission)})
    seen = both(drawing, Passes((flat(0.25),), flat(0)), glowing)
    light = (0.25 if kind.diffuse else 1) + emission
    expected = hex_linear(RED) * light
    if expected.max() < 0.8:
        assert seen[4, 4] == pytest.approx(expected, abs=0.006)
    else:
        assert seen[4, 4].max() > 0.8
        assert seen[4, 4][0] > seen[4, 4][1]
    assert seen[4, 34] == pytest.approx(0.25 * hex_linear(BLUE), abs=0.006)


def test_emission_adds_the_traced_light_of_the_brightest() -> None:
    drawing = split()
    materials = {RED: Material(emission=0.02), BLUE: Material(emission=0.01)}
    once = scene(materials=materials)
    passes = Passes((), flat(0), emission=flat(0.5))
    twice = {colour: replace(m, emission=2 * m.emission) for colour, m in materials.items()}
    first, second = both(drawing, passes, once), both(drawing, passes, scene(materials=twice))
    assert first[4, 4] == pytest.approx(hex_linear(RED) * (0.02 + 0.5 * EMITTED * 0.02), abs=0.004)
    assert first[4, 34] == pytest.approx(
        hex_linear(BLUE) * (0.01 + 0.5 * EMITTED * 0.02), abs=0.004
    )
    assert second == pytest.approx(2 * first, abs=0.006)
