"""The composite: identity under unit light, hue, materials, alpha and shadows."""

from __future__ import annotations

import colorsys
from dataclasses import replace
from importlib import import_module

import numpy as np
import pytest
from numpy.typing import NDArray

from lampblack.colour import hex_linear, linear, srgb
from lampblack.composite import composite
from lampblack.composite.resample import Band, enlarge
from lampblack.drawing.drawing import Drawing
from lampblack.drawing.palette import Palette, Swatch
from lampblack.render.passes import LightPasses, Passes
from lampblack.scene import Ambient, AreaLight, Canvas, Floor, Material, Scene

Pixels = NDArray[np.uint8]
WIDTH, HEIGHT = 40, 24
RED, BLUE = "#c83228", "#2846b4"
NO_AMBIENT = Ambient(strength=0)


def make_drawing(background: tuple[int, int, int, int]) -> Drawing:
    """A disk, red above and blue below, with an inked line across and a soft edge."""
    row, column = np.mgrid[:HEIGHT, :WIDTH] + 0.5
    coverage = np.clip(9.5 - np.hypot(column - 18, row - 12), 0, 1).astype(np.float32)
    mask = coverage > 0
    labels = np.where(mask, (row > 12).astype(int), -1).astype(np.int16)
    fills = np.array([[200, 50, 40], [40, 70, 180]], np.float32) / 255
    albedo = fills[(row > 12).astype(int)]
    ink = np.where(mask, np.clip(1.5 - abs(row - 9), 0, 1), 0).astype(np.float32)
    ink_colour = np.full((HEIGHT, WIDTH, 3), 0.1, np.float32)
    character = albedo + ink[..., None] * (ink_colour - albedo)
    paper = np.array(background, np.float32) / 255
    behind = (1 - coverage[..., None]) * paper[3]
    alpha = coverage[..., None] + behind
    colour = (coverage[..., None] * character + behind * paper[:3]) / np.maximum(alpha, 1e-6)
    pixels = np.rint(np.concatenate([colour, alpha], axis=2) * 255).astype(np.uint8)
    palette = Palette(tuple(Swatch(c, int((labels == i).sum())) for i, c in enumerate((RED, BLUE))))
    return Drawing(pixels, mask, coverage, ink, ink, ink_colour, albedo, labels, palette)


def flat(value: float, glossy: float = 0, size: tuple[int, int] = (WIDTH, HEIGHT)) -> LightPasses:
    shape = (size[1], size[0], 3)
    return LightPasses(np.full(shape, value, np.float32), np.full(shape, glossy, np.float32))


def make_scene(*lights: AreaLight, ambient: Ambient = NO_AMBIENT, **fields: object) -> Scene:
    return Scene(Canvas(WIDTH, HEIGHT), lights=lights, ambient=ambient, **fields)  # type: ignore[arg-type]


LIGHT = AreaLight(20, 12, 20)
BACKGROUNDS = [(0, 0, 0, 0), (255, 255, 255, 255), (20, 10, 30, 255), (250, 235, 200, 128)]


def close(a: Pixels, b: Pixels, tolerance: int = 1) -> bool:
    return bool((abs(a.astype(int) - b.astype(int)) <= tolerance).all())


@pytest.mark.parametrize("background", BACKGROUNDS)
@pytest.mark.parametrize("size", [(WIDTH, HEIGHT), (7, 5)])
def test_unit_light_gives_the_drawing_back(
    background: tuple[int, int, int, int], size: tuple[int, int]
) -> None:
    drawing = make_drawing(background)
    passes = Passes((flat(0.6, size=size),), flat(1, size=size))
    lit = composite(drawing, passes, make_scene(LIGHT, ambient=Ambient(strength=0.4)))
    seen = drawing.pixels[..., 3] > 0
    assert close(lit[seen], drawing.pixels[seen])
    assert np.array_equal(lit[..., 3], drawing.pixels[..., 3])


@pytest.mark.parametrize("background", BACKGROUNDS)
def test_edge_is_a_blend_of_lit_character_and_untouched_background(
    background: tuple[int, int, int, int],
) -> None:
    drawing = make_drawing(background)
    lit = composite(drawing, Passes((flat(0.3),), flat(0)), make_scene(LIGHT))
    inner = lit[12, 18, :3].astype(float)
    edge = lit[12, 9:28].astype(float)
    paper = np.array(background[:3], float)
    low, high = np.minimum(inner, paper) - 2, np.maximum(inner, paper) + 2
    if background[3] == 0:
        low, high = inner - 2, inner + 2
    solid = edge[:, 3] > 16  # straight alpha of almost nothing is all rounding
    assert ((edge[solid, :3] >= low) & (edge[solid, :3] <= high)).all()
    outside = drawing.coverage == 0
    assert np.array_equal(lit[outside], drawing.pixels[outside])


def test_lights_recombine_linearly() -> None:
    drawing = make_drawing((0, 0, 0, 0))
    warm = AreaLight(20, 12, 20, colour="#ff8000", power=0.5)
    both = composite(
        drawing,
        Passes((flat(0.5), flat(0.2)), flat(0.3)),
        make_scene(LIGHT, warm, ambient=Ambient("#80ff40", 0.5)),
    )
    light = 0.5 + 0.5 * 0.2 * hex_linear("#ff8000") + 0.5 * 0.3 * hex_linear("#80ff40")
    expected = srgb(linear(drawing.albedo[16, 18]) * light) * 255
    assert both[16, 18, :3] == pytest.approx(expected, abs=0.51)


def test_brighter_than_white_keeps_its_hue_and_shape() -> None:
    """It pales towards white and stays below it, so that twice the light still looks brighter."""
    drawing = make_drawing((0, 0, 0, 0))
    drawn = colorsys.rgb_to_hsv(*linear(drawing.albedo[16, 18]))
    seen = [
        composite(drawing, Passes((flat(power),), flat(0)), make_scene(LIGHT))[16, 18, :3]
        for power in (1.5, 3, 6, 12, 24)
    ]
    for lit in seen:
        hue, saturation, _ = colorsys.rgb_to_hsv(*linear(lit / 255))
        assert hue == pytest.approx(drawn[0], abs=0.01)
        assert saturation < drawn[1] + 0.01
    assert (np.diff(np.array(seen, int).sum(axis=1)) > 20).all()
    assert seen[-1].min() < 250


def test_more_light_is_never_darker() -> None:
    drawing = make_drawing((0, 0, 0, 0))
    ramp = np.repeat(np.linspace(0, 4, WIDTH, dtype=np.float32)[None, :, None], HEIGHT, 0)
    white = replace(drawing, albedo=np.full_like(drawing.albedo, 0.97), ink=drawing.ink * 0)
    for character in (white, replace(drawing, ink=drawing.ink * 0)):
        source = LightPasses(np.repeat(ramp, 3, 2), np.zeros((HEIGHT, WIDTH, 3), np.float32))
        lit = composite(character, Passes((source,), flat(0)), make_scene(LIGHT))
        across = lit[16, 11:25].astype(int)
        assert (np.diff(across, axis=0) >= 0).all()


def test_materials() -> None:
    drawing = make_drawing((0, 0, 0, 0))
    passes = Passes((flat(0.5, 0.4),), flat(0))
    fill = {RED: (5, 18), BLUE: (16, 18)}
    drawn = {c: linear(drawing.albedo[at]) for c, at in fill.items()}

    def lit(**materials: Material) -> dict[str, NDArray[np.float64]]:
        scene = make_scene(LIGHT, materials={RED: materials["red"], BLUE: materials["blue"]})
        picture = composite(drawing, passes, scene)
        return {c: picture[at][:3] / 255 for c, at in fill.items()}

    both = lit(red=Material(glossy=True, gloss=0.5), blue=Material(diffuse=False, glossy=True))
    assert both[RED] == pytest.approx(srgb(drawn[RED] * 0.5 + 0.5 * 0.4), abs=0.003)
    assert both[BLUE] == pytest.approx(srgb(drawn[BLUE] * 0.5 * 0.4), abs=0.003)
    unlit = lit(red=Material(diffuse=False), blue=Material())
    assert unlit[RED] == pytest.approx(drawing.albedo[fill[RED]], abs=0.003)
    assert unlit[BLUE] == pytest.approx(srgb(drawn[BLUE] * 0.5), abs=0.003)


def test_a_pale_line_is_shaded_and_a_dark_one_stays_as_drawn() -> None:
    drawing = make_drawing((0, 0, 0, 0))
    line = (drawing.ink == 1) & (drawing.coverage == 1)
    dim, full = (Passes((flat(light),), flat(0)) for light in (0.1, 1))
    for grey, share in ((0.1, 1.0), (0.5, 0.1)):
        pencil = np.full_like(drawing.ink_colour, grey)
        pixels = drawing.pixels.copy()
        pixels[line, :3] = round(grey * 255)
        drawn = replace(drawing, ink_colour=pencil, pixels=pixels)
        shaded = composite(drawn, dim, make_scene(LIGHT))[line] / 255
        assert shaded[:, :3] == pytest.approx(float(srgb(share * linear(grey))), abs=0.006)
        assert composite(drawn, full, make_scene(LIGHT))[line][:, :3] / 255 == pytest.approx(
            grey, abs=0.006
        )


def test_glossy_paint_is_not_veiled_by_what_is_all_around_it() -> None:
    """A mirror reflects the surroundings; paint mostly the lights."""
    drawing = make_drawing((0, 0, 0, 0))
    around, key = Passes((flat(0),), flat(0, 0.8)), Passes((flat(0, 0.8),), flat(0))

    def shine(passes: Passes, *, diffuse: bool) -> float:
        material = Material(diffuse=diffuse, glossy=True, gloss=0.5)
        scene = make_scene(LIGHT, ambient=Ambient(strength=1), default_material=material)
        return float(linear(composite(drawing, passes, scene)[16, 18] / 255)[:3].mean())

    assert shine(around, diffuse=False) == pytest.approx(shine(key, diffuse=False), abs=0.002)
    assert shine(around, diffuse=True) < 0.15 * shine(key, diffuse=True)
    assert shine(key, diffuse=True) == pytest.approx(0.4, abs=0.003)


def with_floor(ratio: tuple[float, float, float]) -> LightPasses:
    open_floor = np.full((HEIGHT, WIDTH, 3), 0.7, np.float32)
    return replace(flat(1), floor=open_floor * np.array(ratio, np.float32), open_floor=open_floor)


@pytest.mark.parametrize("ratio", [(0.2, 0.2, 0.2), (0.5, 0.3, 0.2), (1.0, 0.9, 0.9)])
def test_shadow_on_transparent_looks_the_same_over_white(
    ratio: tuple[float, float, float],
) -> None:
    scene = make_scene(LIGHT, floor=Floor(20))
    passes = Passes((with_floor(ratio),), flat(0))
    clear = composite(make_drawing((0, 0, 0, 0)), passes, scene) / 255
    white = composite(make_drawing((255, 255, 255, 255)), passes, scene) / 255
    over_white = clear[..., :3] * clear[..., 3:] + 1 - clear[..., 3:]
    assert abs(over_white - white[..., :3]).max() < 2.5 / 255
    assert white[2, 2, :3] == pytest.approx(srgb(ratio), abs=0.006)


def test_shadow_of_several_lights_is_weighed_by_their_light() -> None:
    scene = make_scene(LIGHT, replace(LIGHT, power=3.0), floor=Floor(20))
    passes = Passes((with_floor((0, 0, 0)), with_floor((1, 1, 1))), flat(0))
    lit = composite(make_drawing((255, 255, 255, 255)), passes, scene)
    assert lit[2, 2, :3] / 255 == pytest.approx(srgb([0.75] * 3), abs=0.004)


def test_floor_without_shadow_changes_nothing() -> None:
    drawing = make_drawing((250, 235, 200, 255))
    passes = Passes((with_floor((1, 1, 1)),), flat(0))
    assert close(composite(drawing, passes, make_scene(LIGHT, floor=Floor(20))), drawing.pixels)


def test_darkness_is_black_not_nan() -> None:
    drawing = make_drawing((0, 0, 0, 0))
    lit = composite(drawing, Passes((), flat(0)), make_scene(floor=Floor(20)))
    assert (lit[16, 18] == [0, 0, 0, 255]).all()
    assert (lit[0, 0] == 0).all()


@pytest.mark.parametrize("small", [(20, 12), (13, 10), (WIDTH, HEIGHT)])
def test_enlarge_keeps_pixel_edges(small: tuple[int, int]) -> None:
    def ramp(width: int, height: int) -> NDArray[np.float32]:
        row, column = np.mgrid[:height, :width]
        edges = (column + 0.5) / width, (row + 0.5) / height, 0 * row
        return np.stack(edges, axis=2, dtype=np.float32)

    large = enlarge(ramp(*small), Band(WIDTH, HEIGHT, 0, HEIGHT))
    inner = (slice(2, -2), slice(2, -2))
    assert large[inner] == pytest.approx(ramp(WIDTH, HEIGHT)[inner], abs=1e-5)


def test_srgb_round_trip_is_exact_in_eight_bits() -> None:
    every = np.arange(256, dtype=np.float32) / 255
    assert np.rint(srgb(linear(every)) * 255).astype(int).tolist() == list(range(256))


def test_bands_join_without_a_seam(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(0)
    small = [rng.random((7, 11, 3)).astype(np.float32) for _ in range(4)]
    passes = Passes((LightPasses(*small),), flat(0.2, size=(5, 4)))
    drawing, scene = make_drawing(BACKGROUNDS[3]), make_scene(LIGHT, floor=Floor(20))
    whole = composite(drawing, passes, scene)
    module = import_module("lampblack.composite.float_kernel")
    monkeypatch.setattr(module, "BAND_PIXELS", 5 * WIDTH)
    assert (composite(drawing, passes, scene) == whole).all()


def test_clear_line_art_is_shaded_and_stays_clear_where_lit() -> None:
    """Over white it is white paper under that light; where light is full it stays as drawn."""
    drawing = make_drawing(BACKGROUNDS[0])
    white = np.ones_like(drawing.albedo)
    line = drawing.ink * drawing.coverage
    film = np.dstack([np.rint(drawing.ink_colour * 255), np.rint(line * 255)]).astype(np.uint8)
    art = replace(drawing, pixels=film, albedo=white)
    full = composite(art, Passes((), flat(1)), make_scene(ambient=Ambient(strength=1)))
    drawn = film[..., 3] > 0
    assert close(full[..., 3], film[..., 3])
    assert close(full[drawn], film[drawn], 2)
    dim = composite(art, Passes((), flat(0.3)), make_scene(ambient=Ambient(strength=1)))
    alpha = dim[..., 3:] / 255
    over_white = dim[..., :3] * alpha + 255 * (1 - alpha)
    inside = (drawing.coverage == 1) & (drawing.ink == 0)
    assert np.abs(over_white[inside] - 255 * srgb(np.float32(0.3))).max() < 1.5
    assert (dim[drawing.coverage == 0] == film[drawing.coverage == 0]).all()
