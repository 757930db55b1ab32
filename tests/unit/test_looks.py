"""Looks: tones are flat, clean and in the light's colour; contact, line and rim."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import ndimage

from lampblack.camera import scene_in_view
from lampblack.colour import hex_linear, linear, srgb
from lampblack.composite import composite
from lampblack.composite.byte_layers import byte_layers_of, premultiplied
from lampblack.composite.edges import edge_distance, reach_of
from lampblack.composite.full_light import exposure, full_light
from lampblack.composite.illumination import Illumination
from lampblack.composite.resample import Band
from lampblack.composite.tones import tone_shares, tones_of
from lampblack.drawing import Drawing, decompose_drawing
from lampblack.render.passes import LightPasses, Passes
from lampblack.scene import (
    Ambient,
    AreaLight,
    Canvas,
    Floor,
    Look,
    Material,
    Rim,
    Scene,
    decode_scene,
    default_scene,
    encode_scene,
)  # fmt: skip
from support.drawings import draw_ball

SIZE = 160
FILL = (220, 120, 60)
MIDDLE = (SIZE // 2, SIZE // 2)
CEL = Look(tones=(0.5,), softness=0.0)
Floats = NDArray[np.float32]


def sun(colour: str = "#ffffff", power: float = 1.0) -> AreaLight:
    """Its full light is its power, everywhere."""
    return AreaLight(0, SIZE / 2, 400, colour=colour, power=power, kind="sun")


def scene(look: Look = CEL, *lights: AreaLight, **fields: object) -> Scene:
    plain = Scene(Canvas(SIZE, SIZE), lights=lights or (sun(),), ambient=Ambient(strength=0))
    return replace(plain, look=look, **fields)  # type: ignore[arg-type]


def ramp(size: int = 40) -> LightPasses:
    """Full light at the left, none at the right."""
    across = np.linspace(1, 0, size, dtype=np.float32)
    light = np.broadcast_to(across[None, :, None], (size, size, 3)).copy()
    return LightPasses(light, light)


def flat(value: float) -> LightPasses:
    light = np.full((8, 8, 3), value, np.float32)
    return LightPasses(light, light)


@pytest.fixture(scope="module")
def ball() -> Drawing:
    return decompose_drawing(draw_ball(SIZE, FILL))


def lit(drawing: Drawing, scene: Scene, *lights: LightPasses, ambient: float = 0) -> Floats:
    """The lit drawing, scene-linear (H, W, 3)."""
    picture = composite(drawing, Passes(lights or (ramp(),), flat(ambient)), scene)
    return linear(picture[..., :3] / 255)


def fill_of(drawing: Drawing) -> NDArray[np.bool_]:
    return np.asarray((drawing.coverage == 1) & (drawing.ink == 0))


def test_tones_are_flat_and_as_many_as_asked(ball: Drawing) -> None:
    fill = fill_of(ball)
    for tones in ((0.5,), (0.4, 0.7), (0.4, 0.6, 0.8)):
        picture = composite(
            ball, Passes((ramp(),), flat(1)),
            scene(replace(CEL, tones=tones), ambient=Ambient(strength=0.2)),
        )[fill]  # fmt: skip
        _, counts = np.unique(picture, axis=0, return_counts=True)
        assert np.count_nonzero(counts > 0.02 * len(picture)) == len(tones) + 1
        assert counts[counts > 0.02 * len(picture)].sum() > 0.94 * len(picture)


def test_the_brightest_tone_is_ambient_and_full_light_in_their_colours(ball: Drawing) -> None:
    light = 0.25 * hex_linear("#8080ff") + 0.6 * hex_linear("#ffc080")
    found = lit(
        ball, scene(CEL, sun("#ffc080", 0.6), ambient=Ambient("#8080ff", 0.25)), ramp(), ambient=1
    )
    drawn = linear(ball.albedo[MIDDLE])
    assert found[80, 40] == pytest.approx(drawn * light * exposure(light.max()), rel=0.03)
    assert found[80, 120] == pytest.approx(
        drawn * 0.25 * hex_linear("#8080ff") * exposure(light.max()), rel=0.06
    )


def test_the_shade_has_its_colour(ball: Drawing) -> None:
    look = replace(CEL, shade_colour="#405080", shade_strength=1.0)
    drawn = linear(ball.albedo[MIDDLE])
    assert lit(ball, scene(look))[80, 120] == pytest.approx(drawn * hex_linear("#405080"), rel=0.06)
    smooth = replace(look, tones=())
    assert lit(ball, scene(smooth), flat(0))[80, 80] == pytest.approx(
        drawn * hex_linear("#405080"), rel=0.06
    )
    assert lit(ball, scene(smooth), flat(0.9))[80, 80] == pytest.approx(
        drawn * (0.9 * 0.9 + 0.1 * hex_linear("#405080")), rel=0.03
    )


def test_power_and_colour_leave_the_tones_where_they_are(ball: Drawing) -> None:
    def edge(light: AreaLight) -> int:
        return int(np.argmin(np.diff(lit(ball, scene(CEL, light))[80, 30:130].sum(axis=1))))

    assert edge(sun(power=0.3)) == edge(sun()) == edge(sun("#2040ff", 2.0))


def test_the_edge_of_a_tone_is_a_clean_curve_however_coarse_the_light() -> None:
    """A round pool of light, traced with 24 elements, shown with 240 pixels."""
    at = (np.arange(24) + 0.5) * 10 - 120
    distance = np.hypot(at[:, None], at)
    light = np.clip(1 - distance / 160, 0, 1).astype(np.float32)[..., None].repeat(3, 2)
    plain = replace(scene(replace(CEL, tones=(0.7,))), canvas=Canvas(240, 240))
    tones = tones_of(
        Illumination([(np.ones(3, np.float32), light, light)]), plain, 1.0, (0, 0, 240, 240)
    )
    shares = tone_shares(tones, Band(240, 240, 0, 240))
    along = np.arange(60, 100, 0.25)
    radii = []
    for angle in np.linspace(0, 2 * np.pi, 32, endpoint=False):
        places = 119.5 + along * np.sin(angle), 119.5 + along * np.cos(angle)
        radii.append(along[ndimage.map_coordinates(shares, places, order=1) < 0.5][0])
    assert np.ptp(radii) <= 0.75
    mixed = np.count_nonzero((shares > 0.02) & (shares < 0.98))
    assert 0.7 < mixed / (2 * np.pi * np.mean(radii)) < 3.5


def test_crumbs_are_removed_and_shapes_kept() -> None:
    light = np.zeros((200, 200, 3), np.float32)
    light[50:150, 50:150] = 0.9
    light[97:100, 98:100] = 0
    light[180:182, 20:22] = 0.9
    plain = replace(scene(CEL), canvas=Canvas(1000, 1000))
    tones = tones_of(
        Illumination([(np.ones(3, np.float32), light, light)]), plain, 5.0, (0, 0, 1000, 1000)
    )
    shares = tone_shares(tones, Band(200, 200, 0, 200))
    assert shares[53:147, 53:147].min() > 0.98
    assert shares[:40].max() == shares[160:].max() == 0


def test_a_material_has_a_look_of_its_own(ball: Drawing) -> None:
    def shades(scene: Scene) -> int:
        return len(
            np.unique(composite(ball, Passes((ramp(),), flat(0)), scene)[80, 40:120], axis=0)
        )

    assert shades(scene(CEL)) < 8 < 40 < shades(scene(Look()))
    assert shades(scene(Look(), default_material=Material(look="cel"))) < 8
    assert shades(scene(CEL, default_material=Material(look="smooth"))) > 40


def test_a_highlight_is_a_tone_too(ball: Drawing) -> None:
    glossy = Material(glossy=True, gloss=0.5)
    look = replace(CEL, tones=(0.2,), highlight=0.8)
    found = lit(ball, scene(look, default_material=glossy))[80, 30:110]
    matt = lit(ball, scene(look))[80, 30:110]
    shine = (found - matt).max(axis=1)
    assert shine[:10].min() > 0.2
    assert np.ptp(shine[:10]) < 0.01
    assert abs(shine[50:]).max() < 0.01


def test_the_floor_has_one_shade(ball: Drawing) -> None:
    across = np.linspace(0.1, 1, 40, dtype=np.float32)[None, :, None]
    cast = np.broadcast_to(across, (40, 40, 3)).copy()
    passes = Passes((replace(ramp(), floor=cast, open_floor=np.ones_like(cast)),), flat(0))
    picture = composite(ball, passes, scene(ambient=Ambient(strength=0.25), floor=Floor(150)))
    alpha = picture[2, :, 3]
    values, counts = np.unique(alpha, return_counts=True)
    assert values[counts > 8].tolist() == [0, round(255 * (1 - float(srgb(0.2))))]


def test_contact_darkens_only_what_is_covered(ball: Drawing) -> None:
    look = Look(contact=1.0)
    for ambient in (Ambient(strength=0), Ambient(strength=1)):
        plain, shaded = (
            [
                lit(ball, scene(each, ambient=ambient), flat(0.5), ambient=openness)[MIDDLE]
                for openness in (0.3, 1)
            ]
            for each in (Look(), look)
        )
        assert shaded[1] == pytest.approx(plain[1], rel=0.02)
        assert shaded[0].max() < 0.4 * plain[0].max()


def test_a_line_that_takes_light_is_darker_in_shade_and_has_the_fills_colour(ball: Drawing) -> None:
    line = (ball.ink == 1) & (ball.coverage == 1)
    drawn = linear(ball.ink_colour[line]).mean(axis=0)
    bright, dark = (
        lit(ball, scene(Look(ink_light=1.0)), flat(value))[line].mean(axis=0) for value in (1, 0.05)
    )
    assert (bright > drawn).all()
    assert bright[0] - drawn[0] > 3 * (bright[2] - drawn[2])
    assert (dark < 0.5 * drawn + 0.01).all()


def test_a_rim_lies_inside_the_outline_all_around(ball: Drawing) -> None:
    bright = scene(Look(), rim=Rim(width=6, strength=1, away=0))
    found = lit(ball, bright, flat(0.1)) - lit(ball, replace(bright, rim=None), flat(0.1))
    amount = found.max(axis=2)
    rows, columns = np.mgrid[:SIZE, :SIZE] + 0.5 - SIZE / 2
    inner = SIZE * 0.4 - max(2.0, SIZE / 60)
    depth = inner - np.hypot(rows, columns)
    band = (depth > 1.5) & (depth < 4.5)
    assert amount[band].min() > 0.4
    assert amount[depth > 8].max() < 0.01
    assert amount[depth < -4].max() < 0.01


def test_a_rim_leaves_the_lit_side_out(ball: Drawing) -> None:
    away = scene(Look(), rim=Rim(width=6, strength=1, away=1))
    found = (lit(ball, away, flat(0.1)) - lit(ball, replace(away, rim=None), flat(0.1))).max(axis=2)
    assert found[80, 20:30].max() < 0.05
    assert found[80, 130:142].max() > 0.5


def test_a_rim_follows_the_part_in_front_and_not_the_one_behind() -> None:
    mask = np.ones((100, 100), bool)
    height = np.zeros((100, 100), np.float32)
    height[:, :50] = 30
    distance = edge_distance(mask, np.zeros((100, 100), np.float32), height)
    unit = reach_of(mask.shape) / 255
    assert distance[50, 45] * unit == pytest.approx(4, abs=1)
    assert distance[50, 55] == 255


def test_an_emissive_colour_glows_around_it_and_in_its_colour(ball: Drawing) -> None:
    bright = Material(emission=2.0)
    passes = Passes((flat(0.1),), flat(0))
    plain, glowing, unlit = (
        composite(ball, passes, scene(Look(glow=glow), default_material=material)) / 255
        for glow, material in ((0, bright), (1, bright), (1, Material()))
    )
    assert np.array_equal(plain[..., 3], unlit[..., 3])
    assert (plain[80, 80, :3] > unlit[80, 80, :3] + 0.1).all()
    beside, far = glowing[80, 150], glowing[2, 2]
    assert beside[3] > 0.3 > 0.1 > far[3]
    assert beside[0] > 1.3 * beside[2]
    assert (glowing[80, 80, :3] > plain[80, 80, :3]).all()
    layers = composite(
        byte_layers_of(ball), passes, scene(Look(glow=1), default_material=bright)
    ).astype(int)
    assert np.abs(layers - premultiplied(np.rint(glowing * 255).astype(np.uint8))).max() <= 4


LOOKS = [
    Look(shade_strength=0.7, contact=0.5, ink_light=0.5),
    Look(tones=(0.4,), softness=0.0, shade_strength=0.5, ink_light=1.0),
    Look(tones=(0.2, 0.5), softness=0.3, contact=1.0),
]


@pytest.mark.parametrize("look", LOOKS)
@pytest.mark.parametrize("material", [Material(), Material(True, True), Material(False, True)])
def test_previews_agree_with_finals(ball: Drawing, look: Look, material: Material) -> None:
    rng = np.random.default_rng(3)
    planes = [rng.uniform(0.1, 0.9, (12, 12, 3)).astype(np.float32) for _ in range(6)]
    passes = Passes((LightPasses(*planes[:4]),), LightPasses(*planes[4:]))
    edges = edge_distance(ball.mask, ball.ink)
    full = replace(
        default_scene(SIZE, SIZE), look=look, rim=Rim(width=5), default_material=material,
        floor=Floor(140),
    )  # fmt: skip
    wanted = premultiplied(composite(ball, passes, full, edges=edges)).astype(int)
    layers = replace(byte_layers_of(ball), edges=edges, edge_unit=reach_of(edges.shape) / 255)
    assert np.abs(composite(layers, passes, full) - wanted).max() <= 4


def test_a_light_for_one_colour_leaves_the_tones_of_the_others(ball: Drawing) -> None:
    other = replace(sun(power=50), colours=("#123456",))
    dark = flat(0)
    alone, beside = (
        lit(ball, scene(CEL, *lights), ramp(), *([dark] * (len(lights) - 1)))
        for lights in ((sun(),), (sun(), other))
    )
    assert np.array_equal(alone, beside)


def test_a_light_for_one_colour_is_in_tones_too(ball: Drawing) -> None:
    own = replace(sun("#ff4000"), colours=(ball.palette.colours[0],))
    plain = scene(CEL, sun(power=0.5), own)
    passes = Passes((flat(0), ramp()), flat(0))
    picture = composite(ball, passes, plain)
    values, counts = np.unique(picture[80, 40:120], axis=0, return_counts=True)
    assert counts[counts > 10].sum() > 70
    assert len(values) < 12
    layers = composite(byte_layers_of(ball), passes, plain).astype(int)
    assert np.abs(layers - premultiplied(picture)).max() <= 4


def test_scenes_without_a_look_are_as_before_and_looks_survive_a_file() -> None:
    plain = default_scene(100, 80)
    assert (plain.look, plain.rim) == (Look(), None)
    assert full_light(replace(plain, lights=())) == 0
    styled = replace(plain, look=LOOKS[1], rim=Rim(width=12))
    assert decode_scene(encode_scene(styled)) == styled
    seen = scene_in_view(styled, (2, 0, 0, 0, 2, 0), (200, 160))
    assert seen.rim == Rim(width=24)
