"""Cycles in its child: calibration, falloff, alignment and floor."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lampblack.bench.memory import processor_seconds
from lampblack.colour import hex_linear
from lampblack.composite.resample import Band, enlarge
from lampblack.render.client import RenderChild
from lampblack.render.passes import LightPasses, Passes
from lampblack.render.quality import QUALITIES, Quality, Sampling
from lampblack.render.request import RenderRequest
from lampblack.scene import Ambient, AreaLight, Canvas, Floor
from lampblack.surface.relief import Relief
from support.surfaces import Heights, ball, plane, surface


def quality(spp: int, scale: float = 1, floor_spp: int = 16) -> Quality:
    sampling = Sampling(scale, 512, spp)
    return Quality(sampling, sampling, Sampling(0.5, 512, floor_spp), 1, "high")


def disk_irradiance(light: AreaLight, canvas: Canvas, distance: Heights) -> Heights:
    """Irradiance over pi that ``light`` throws on the paper, ``distance`` pixels from the point
    beneath it: the form factor of a parallel disk (Howell, configuration B-13)."""
    h, r, d = light.z, light.size / 2, distance
    factor = (1 - (d**2 + h**2 - r**2) / np.sqrt((d**2 + h**2 + r**2) ** 2 - (2 * r * d) ** 2)) / 2
    return np.asarray((r**2 + canvas.default_height**2) / r**2 * factor)


@pytest.mark.parametrize(("z", "size"), [(48, 20), (48, 150), (-48, 20), (90, 60)])
def test_light_is_calibrated_and_falls_off(child: RenderChild, z: float, size: float) -> None:
    canvas = Canvas(96, 64)
    light = AreaLight(40, 24, z, size)
    passes = child.render(
        RenderRequest(plane(96, 64), canvas, (light,), ambient=False, quality=quality(64))
    )
    row, column = np.mgrid[:64, :96] + 0.5
    expected = disk_irradiance(light, canvas, np.hypot(column - 40, row - 24))
    if z == 48:
        assert expected.max() == pytest.approx(1, abs=1e-3)
    if z < 0:
        expected = np.zeros_like(expected)
    inner = (slice(4, -4), slice(4, -4))
    seen = passes.lights[0].diffuse[inner]
    assert seen.mean() == pytest.approx(expected[inner].mean(), rel=0.005)
    assert abs(seen - expected[inner][..., None]).max() < 0.03


def test_ambient_shows_an_open_surface_as_drawn(child: RenderChild) -> None:
    passes = child.render(RenderRequest(plane(64, 64), Canvas(64, 64), (), quality=quality(32)))
    assert passes.lights == ()
    assert passes.ambient.diffuse[4:-4, 4:-4].mean() == pytest.approx(1, abs=0.005)
    assert not passes.ambient.glossy.any()


def test_it_tells_what_the_time_was_spent_on(child: RenderChild) -> None:
    child.start()
    began, before = processor_seconds(child.pid or 0), dict(child.spent)
    child.render(RenderRequest(plane(48, 64), Canvas(48, 64), (), quality=quality(64)))
    spent = {name: seconds - before.get(name, 0) for name, seconds in child.spent.items()}
    assert set(spent) == {"mesh", "cycles", "denoiser"}
    assert all(seconds > 0 for seconds in spent.values())
    # The kernel counts in hundredths of a second.
    assert sum(spent.values()) <= processor_seconds(child.pid or 0) - began + 0.05


def test_each_source_is_traced_alone(child: RenderChild) -> None:
    canvas = Canvas(64, 64)
    first, second = AreaLight(10, 10, 40, 20), AreaLight(60, 50, 30, 20)
    dome = ball(64, 64, (32, 32), 25)
    alone = child.render(RenderRequest(dome, canvas, (second,), ambient=False, quality=quality(16)))
    together = child.render(RenderRequest(dome, canvas, (first, second), quality=quality(16)))
    assert abs(alone.lights[0].diffuse - together.lights[1].diffuse).max() < 1e-4
    assert abs(together.lights[0].diffuse - together.lights[1].diffuse).max() > 0.3
    assert alone.ambient.diffuse.shape == (1, 1, 3)
    again = child.render(
        RenderRequest(
            dome, canvas, (replace(second, power=7.0, colour="#ff0000"),), quality=quality(16)
        )
    )
    assert abs(again.lights[0].diffuse - alone.lights[0].diffuse).max() < 1e-4


LAMPS = (AreaLight(10, 5, 40, 30, "#ffd0a0", 1.5), AreaLight(60, 40, -20, 30, "#8db7ff", 2))
SUN = (AreaLight(40, 70, 50, 60, "#c0ffd0", 0.6, "sun"),)


def mixture_of(passes: Passes, lights: tuple[AreaLight, ...], ambient: Ambient) -> LightPasses:
    """The sum of all passes, in colour and power."""
    weights = [hex_linear(light.colour) * light.power for light in lights]
    weights.append(hex_linear(ambient.colour) * ambient.strength)
    sources = list(zip(weights, (*passes.lights, passes.ambient), strict=True))
    found = [
        np.asarray(sum(weight * getattr(light, part) for weight, light in sources), np.float32)
        for part in ("diffuse", "glossy", "floor", "open_floor")
        if getattr(passes.ambient, part) is not None
    ]
    return LightPasses(*found)


@pytest.mark.parametrize("lights", [LAMPS, SUN])
def test_lights_traced_as_one_are_the_sum_of_all(
    child: RenderChild, lights: tuple[AreaLight, ...]
) -> None:
    ambient = Ambient("#e0e8ff", 0.4)
    dome = ball(64, 64, (32, 30), 24, gloss=0.4)
    apart = RenderRequest(
        dome, Canvas(64, 64), lights, floor=Floor(50), quality=quality(128, floor_spp=256)
    )
    expected = mixture_of(child.render(apart), lights, ambient)
    found = child.render(replace(apart, ambient=False, mixed_with=ambient))
    assert found.lights == ()
    assert found.mixture is not None
    row, column = np.mgrid[:64, :64] + 0.5
    inside = np.hypot(row - 30, column - 32) < 22
    # The mean of highlights has more noise, of either way.
    for part, apart_by in {"diffuse": 0.002, "glossy": 0.005}.items():
        one, other = (getattr(light, part)[inside] for light in (found.mixture, expected))
        assert one.mean(axis=0) == pytest.approx(other.mean(axis=0), rel=apart_by)
        assert np.sqrt(((one - other) ** 2).mean()) < 0.01 * other.max()
    one, other = (light.floor / light.open_floor for light in (found.mixture, expected))
    assert np.sqrt(((one - other) ** 2).mean()) < 0.02
    assert abs(other - 1).max() > 0.2


def test_lights_traced_as_one_have_no_more_noise(child: RenderChild) -> None:
    ambient, lights = Ambient("#e0e8ff", 0.4), LAMPS
    apart = RenderRequest(
        ball(128, 128, (64, 60), 50), Canvas(128, 128), lights, quality=QUALITIES["final"]
    )
    row, column = np.mgrid[:128, :128] + 0.5
    inside = np.hypot(row - 60, column - 64) < 48
    truth = mixture_of(child.render(replace(apart, quality=quality(128))), lights, ambient)

    def error(light: LightPasses | None) -> float:
        assert light is not None
        return float(np.sqrt(((light.diffuse - truth.diffuse)[inside] ** 2).mean()))

    together = child.render(replace(apart, ambient=False, mixed_with=ambient)).mixture
    assert error(together) < 1.1 * error(mixture_of(child.render(apart), lights, ambient))


@pytest.mark.parametrize("canvas", [Canvas(120, 75), Canvas(75, 121)])
@pytest.mark.parametrize("scale", [1.0, 0.5])
def test_light_lies_on_its_pixels(child: RenderChild, canvas: Canvas, scale: float) -> None:
    """A ball off centre under a far light, against Lambert's cosine: displaced by less than a
    quarter of a canvas pixel. A dark albedo keeps light from bouncing."""
    at, radius = (0.4 * canvas.width, 0.55 * canvas.height), 0.35 * min(canvas.width, canvas.height)
    light = AreaLight(at[0] - 3000, at[1] - 2000, 9000, 300)
    request = RenderRequest(
        ball(canvas.width, canvas.height, at, radius, albedo=0.0),
        canvas,
        (light,),
        ambient=False,
        quality=quality(64, scale),
    )
    seen = enlarge(
        child.render(request).lights[0].diffuse, Band(canvas.width, canvas.height, 0, canvas.height)
    )[..., 1]
    row, column = np.mgrid[: canvas.height, : canvas.width] + 0.5
    x, y = (column - at[0]) / radius, (row - at[1]) / radius
    inside = np.hypot(x, y) < 0.85
    normal = np.stack([x, y, np.sqrt(np.maximum(1 - x**2 - y**2, 0))], axis=2)
    towards = np.array([-3000, -2000, 9000]) / np.linalg.norm([-3000, -2000, 9000])
    expected = np.maximum(normal @ towards, 0)
    brightness = seen[inside].mean() / expected[inside].mean()
    slope_y, slope_x = np.gradient(expected)
    slopes = np.stack([slope_x[inside], slope_y[inside], np.ones(inside.sum())], axis=1)
    shift = np.linalg.lstsq(slopes, (seen / brightness - expected)[inside], rcond=None)[0]
    assert np.hypot(*shift[:2]) < 0.25


def test_a_piece_of_the_canvas_equals_that_piece_of_the_whole(child: RenderChild) -> None:
    canvas = Canvas(96, 64)
    request = RenderRequest(
        ball(96, 64, (40, 30), 26),
        canvas,
        (AreaLight(10, 5, 60, 30),),
        False,
        None,
        None,
        quality(64),
    )
    whole = child.render(request).lights[0].diffuse
    piece = child.render(replace(request, rect=(24, 16, 40, 24))).lights[0].diffuse
    assert piece.shape == (24, 40, 3)
    assert abs(piece - whole[16:40, 24:64]).mean() < 0.01


def test_highlight_faces_the_light(child: RenderChild) -> None:
    canvas = Canvas(80, 80)
    light = AreaLight(-1000, -1500, 3000, 200)
    request = RenderRequest(
        ball(80, 80, (40, 40), 32, gloss=0.5), canvas, (light,), False, quality=quality(32)
    )
    glossy = child.render(request).lights[0].glossy[..., 1]
    row, column = np.unravel_index(glossy.argmax(), glossy.shape)
    towards = np.array([light.x - 40, light.y - 40, light.z])
    half = towards / np.linalg.norm(towards) + (0, 0, 1)
    half /= np.linalg.norm(half)
    assert (column + 0.5, row + 0.5) == pytest.approx(40 + 32 * half[:2], abs=3)


def test_colour_bleeds_onto_the_floor_and_shadow_falls_away_from_the_light(
    child: RenderChild,
) -> None:
    canvas = Canvas(100, 100)
    red = ball(100, 100, (50, 50), 16)
    red.albedo[:] = (0.8, 0.03, 0.03)
    request = RenderRequest(
        red,
        canvas,
        (AreaLight(50, 20, 150, 20), AreaLight(50, -20, -120, 10)),
        floor=Floor(66, 25),
        quality=quality(4),
    )
    passes = child.render(request)
    ratios = []
    for source in (*passes.lights, passes.ambient):
        assert source.floor is not None
        assert source.open_floor is not None
        assert np.isfinite(source.floor).all()
        ratios.append((source.floor + 0.01) / (source.open_floor + 0.01))
    front, back, ambient = ratios
    line = 33  # the floor is traced at half the canvas's resolution
    assert front[:line, 10:40].min() < 0.2
    assert front[line + 2 :].min() > 0.8
    assert back[line:, 10:40].min() < 0.6
    assert back[: line - 2].min() > 0.8
    assert front[-4:].mean() == pytest.approx(1, abs=0.01)
    beside = ambient[line - 4 : line, 14:18]
    assert beside[..., 0].mean() > beside[..., 2].mean() + 0.02


def test_floor_leaves_the_character_below_its_line_alone(child: RenderChild) -> None:
    canvas = Canvas(64, 64)
    light = AreaLight(32, 10, 60, 20)
    bare = RenderRequest(
        ball(64, 64, (32, 32), 24, albedo=0.0), canvas, (light,), False, quality=quality(32)
    )
    without = child.render(bare).lights[0].diffuse
    standing = child.render(replace(bare, floor=Floor(40, 25))).lights[0].diffuse
    assert (standing - without).min() > -0.03


def test_low_quality_agrees_with_final(child: RenderChild) -> None:
    canvas = Canvas(128, 128)
    request = RenderRequest(
        ball(128, 128, (64, 64), 50), canvas, (AreaLight(30, 20, 70, 40),), quality=QUALITIES["low"]
    )
    low, final = (
        child.render(replace(request, quality=QUALITIES[name])) for name in ("low", "final")
    )
    row, column = np.mgrid[:128, :128] + 0.5
    inside = np.hypot(row - 64, column - 64) < 47
    whole = Band(128, 128, 0, 128)
    for a, b in ((low.lights[0], final.lights[0]), (low.ambient, final.ambient)):
        difference = enlarge(a.diffuse, whole) - enlarge(b.diffuse, whole)
        assert np.sqrt((difference[inside] ** 2).mean()) < 0.025


def test_degenerate_relief_gives_finite_light(child: RenderChild) -> None:
    dome = ball(48, 48, (24, 24), 18, gloss=0.3)
    vertices = dome.relief.vertices.copy()
    vertices[5] = vertices[6] = vertices[30]
    flat = replace(dome, relief=Relief(vertices, dome.relief.faces))
    empty = surface(Relief(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32)))
    for subject in (flat, empty):
        passes = child.render(
            RenderRequest(
                subject,
                Canvas(48, 48),
                (AreaLight(24, 24, 0.0),),
                floor=Floor(40),
                quality=quality(2),
            )
        )
        for source in (*passes.lights, passes.ambient):
            for array in (source.diffuse, source.glossy, source.floor, source.open_floor):
                assert array is not None
                assert np.isfinite(array).all()
