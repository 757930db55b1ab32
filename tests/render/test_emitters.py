"""Light from surfaces in Cycles: closed forms, and where it goes; shadows that are not cast."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from lampblack.drawing import DrawingPlanes
from lampblack.pipeline import Pipeline
from lampblack.render.client import RenderChild
from lampblack.render.emitters import glowing_parts, painted_plane
from lampblack.render.quality import Quality, Sampling
from lampblack.render.request import RenderRequest
from lampblack.render.wire import Accumulate
from lampblack.scene import Ambient, AreaLight, Canvas, Floor, Material, Scene
from support.drawings import draw_ball
from support.surfaces import height_relief, plane, surface

CANVAS = Canvas(96, 64)
ROW, COLUMN = np.mgrid[:64, :96] + 0.5


def quality(spp: int = 64) -> Quality:
    sampling = Sampling(1, 512, spp)
    return Quality(sampling, sampling, Sampling(0.5, 512, 16), 1, "high")


def form_factor(radius: float, height: float, away: NDArray[np.float64]) -> NDArray[np.float64]:
    """Of a disk to a point of a parallel plane (Howell, configuration B-13)."""
    r, h, d = radius, height, away
    return np.asarray(
        (1 - (d**2 + h**2 - r**2) / np.sqrt((d**2 + h**2 + r**2) ** 2 - (2 * r * d) ** 2)) / 2
    )


@pytest.mark.parametrize("height", [6, 20])
def test_a_painted_disk_lights_the_paper_as_a_disk_does(child: RenderChild, height: float) -> None:
    radius, away = 14, np.hypot(COLUMN - 48, ROW - 32)
    paint = np.where((away < radius)[..., None], np.array([1, 0.5, 0], np.float32), 0)
    flat = replace(plane(96, 64), albedo=np.zeros((len(plane(96, 64).albedo), 3), np.float32))
    plate = painted_plane(paint.astype(np.float32), (96, 64), height)
    assert plate is not None
    lit = replace(flat, emitters={"painted": plate})
    request = RenderRequest(lit, CANVAS, (), False, quality=quality(), glows=("painted",))
    found = child.render(request)
    assert found.painted is not None
    assert found.emission is None
    expected = form_factor(radius, height, away)[..., None] * np.array([1, 0.5, 0])
    inner = np.s_[6:-6, 6:-6]
    assert abs(found.painted.diffuse[inner] - expected[inner]).max() < 0.06
    assert found.painted.diffuse[inner].mean() == pytest.approx(expected[inner].mean(), rel=0.03)


def walled(child: RenderChild, radiance: float, light: AreaLight | None = None) -> tuple:
    """A floor with a wall across it; the left side of the wall glows."""
    wall = np.where(abs(COLUMN - 48) < 3, 20.0, 0.0)
    bare = surface(height_relief(wall, np.ones(wall.shape, bool)), 0.0)
    x, _, z = bare.relief.vertices.T
    glow = np.where((x < 46) & (x > 44) & (z > 2), radiance, 0).astype(np.float32)
    emitter = glowing_parts(bare.relief, np.repeat(glow[:, None], 3, axis=1), 48)
    assert emitter is not None
    lit = replace(bare, emitters={"emission": emitter})
    lights = () if light is None else (light,)
    found = child.render(
        RenderRequest(lit, CANVAS, lights, False, quality=quality(), glows=("emission",))
    )
    assert found.emission is not None
    return found.emission.diffuse[..., 1], found.lights


def test_a_glowing_side_lights_what_it_faces_and_nothing_else(child: RenderChild) -> None:
    lit, _ = walled(child, 1.0)
    assert lit[20:44, 34:40].mean() > 0.05
    assert lit[20:44, 56:90].mean() < 0.1 * lit[20:44, 34:40].mean()
    near, far = lit[32, 38:42].mean(), lit[32, 10:14].mean()
    assert near > 2 * far


def test_light_from_surfaces_is_linear_and_in_no_other_pass(child: RenderChild) -> None:
    light = AreaLight(20, 10, 60, 20)
    once, lights = walled(child, 1.0, light)
    thrice, again = walled(child, 3.0, light)
    assert thrice.mean() == pytest.approx(3 * once.mean(), rel=0.01)
    assert abs(lights[0].diffuse - again[0].diffuse).max() < 1e-4
    bare = height_relief(np.where(abs(COLUMN - 48) < 3, 20.0, 0.0), np.ones(ROW.shape, bool))
    alone = child.render(
        RenderRequest(surface(bare, 0.0), CANVAS, (light,), False, quality=quality())
    )
    assert abs(lights[0].diffuse - alone.lights[0].diffuse).max() < 1e-4


@pytest.mark.parametrize("kind", ["lamp", "sun"])
def test_a_light_that_casts_no_shadow_shines_through(child: RenderChild, kind: str) -> None:
    """The floor behind a wall is lit as if there were none."""
    wall = height_relief(np.where(abs(COLUMN - 48) < 3, 20.0, 0.0), np.ones(ROW.shape, bool))
    light = AreaLight(-40, 32, 60, 10, kind=kind)  # type: ignore[arg-type]
    dark, free = (
        child.render(
            RenderRequest(
                surface(wall, 0.0), CANVAS, (replace(light, casts_shadow=casts),), False,
                quality=quality(),
            )
        ).lights[0].diffuse[24:40, 54:62].mean()
        for casts in (True, False)
    )  # fmt: skip
    flat = child.render(RenderRequest(plane(96, 64), CANVAS, (light,), False, quality=quality()))
    assert dark < 0.1 * free
    assert free == pytest.approx(flat.lights[0].diffuse[24:40, 54:62].mean(), rel=0.05)


def test_a_light_without_shadow_throws_none_on_the_floor(child: RenderChild) -> None:
    block = height_relief(np.full((64, 96), 12.0), np.hypot(COLUMN - 48, ROW - 32) < 12)
    light = AreaLight(48, -60, 90, 10, casts_shadow=False)
    floor = Floor(50, 40)
    passes = child.render(
        RenderRequest(surface(block, 0.0), CANVAS, (light,), False, floor, quality=quality())
    )
    cast, free = passes.lights[0].floor, passes.lights[0].open_floor
    assert cast is not None
    assert free is not None
    assert cast == pytest.approx(free, abs=0.02)


def test_light_from_the_figure_fills_shadows_and_brightens_no_paper(child: RenderChild) -> None:
    block = surface(height_relief(np.full((64, 96), 12.0), np.hypot(COLUMN - 48, ROW - 32) < 12))
    white = np.ones((len(block.albedo), 3), np.float32)
    emitter = glowing_parts(block.relief, white, 48)
    assert emitter is not None
    request = RenderRequest(
        replace(block, emitters={"emission": emitter}), CANVAS, (), False, Floor(50, 40),
        quality=quality(), glows=("emission",),
    )  # fmt: skip
    found = child.render(request).emission
    assert found is not None
    assert found.floor is not None
    assert found.floor.max() > 0.1
    assert np.array_equal(found.floor, found.open_floor)
    view = (0.0, 0.0, 96.0, 64.0)
    job = Accumulate(
        CANVAS, view, (48, 32), None, Floor(50, 40), "floor", 8, 0, 8, True, "emission"
    )
    first, second = child.accumulate(request.surface, job)
    assert np.array_equal(first, second)
    assert first.max() > 0.1


def test_the_light_of_an_emissive_colour_gathers_piece_by_piece(child: RenderChild) -> None:
    """In previews, as in finals."""
    wall = np.where(abs(COLUMN - 48) < 3, 20.0, 0.0)
    bare = surface(height_relief(wall, np.ones(wall.shape, bool)), 0.0)
    glow = np.where(bare.relief.vertices[:, 0] < 46, 1, 0).astype(np.float32)
    emitter = glowing_parts(bare.relief, np.repeat(glow[:, None], 3, axis=1), 48)
    assert emitter is not None
    lit = replace(bare, emitters={"emission": emitter})
    view = (0.0, 0.0, 96.0, 64.0)

    def gathered(counts: tuple[int, ...]) -> NDArray[np.float32]:
        first, found = 0, ()
        for count in counts:
            last = first + count == sum(counts)
            job = Accumulate(
                CANVAS, view, (96, 64), None, None, "character", 16, first, count, last, "emission"
            )
            found = child.accumulate(lit, job)
            first += count
        return found[0]

    assert abs(gathered((16,)) - gathered((4, 4, 8))).max() < 1e-3
    assert gathered((16,)).max() > 0.1


def test_an_emissive_colour_lights_a_drawing_through_the_whole_pipeline(pipeline: Pipeline) -> None:
    ball = draw_ball(96)
    planes = DrawingPlanes(ball)
    drawing = planes.decompose()
    prepared = pipeline.prepare(drawing)
    colours = [swatch.colour for swatch in drawing.palette.swatches]
    dark = Scene(Canvas(96, 96), (), Ambient(strength=0.1))
    glowing = replace(dark, materials={colours[0]: Material(emission=2.0)})
    twice = replace(dark, materials={colours[0]: Material(emission=4.0)})
    assert pipeline.light(prepared, dark).emission is None
    found = pipeline.light(prepared, glowing).emission
    assert found is not None
    assert pipeline.light(prepared, twice).emission is found  # only the weight changed
