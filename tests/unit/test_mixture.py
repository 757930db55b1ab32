"""Lights that are traced as one: the same picture, and only where nobody tells them apart."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lampblack.choices import DeviceKind
from lampblack.colour import hex_linear
from lampblack.composite import composite
from lampblack.composite.byte_layers import byte_layers_of
from lampblack.composite.shading import needs_ambient, needs_each_light
from lampblack.drawing.decompose import decompose_drawing
from lampblack.materials import MaterialTable
from lampblack.render.light_pass_cache import LightPassCache
from lampblack.render.passes import DARK, LightPasses, Passes
from lampblack.render.request import RenderRequest, as_mixture, mixable
from lampblack.scene import Ambient, AreaLight, Canvas, Floor, Look, Material, Scene
from support.drawings import draw_ball
from support.surfaces import plane

SIZE = 48
LIGHTS = (
    AreaLight(5, 5, 30, colour="#ffd0a0", power=0.7),
    AreaLight(40, 8, 30, colour="#80a0ff", power=0.4),
)


def lit() -> Scene:
    return Scene(Canvas(SIZE, SIZE), LIGHTS, Ambient("#e0e8ff", 0.4), floor=Floor(40))


def random_light(seed: int) -> LightPasses:
    found = np.random.default_rng(seed).uniform(0.1, 0.9, (4, SIZE, SIZE, 3)).astype(np.float32)
    return LightPasses(*found)


def mixed(passes: Passes, scene: Scene) -> Passes:
    """What the renderer gives for all of these lights at once."""
    weights = [hex_linear(light.colour) * light.power for light in scene.lights]
    weights.append(hex_linear(scene.ambient.colour) * scene.ambient.strength)
    sources = list(zip(weights, (*passes.lights, passes.ambient), strict=True))
    names = ("diffuse", "glossy", "floor", "open_floor")
    sums = (sum(w * getattr(light, name) for w, light in sources) for name in names)
    return Passes((), DARK, mixture=LightPasses(*(np.float32(one) for one in sums)))


def test_the_picture_is_that_of_the_lights_apart() -> None:
    drawing, scene = decompose_drawing(draw_ball(SIZE)), lit()
    apart = Passes((random_light(1), random_light(2)), random_light(3))
    together = mixed(apart, scene)
    for layers in (drawing, byte_layers_of(drawing)):
        one, other = (composite(layers, passes, scene).astype(int) for passes in (apart, together))
        assert abs(one - other).max() <= 1


@pytest.mark.parametrize(
    ("change", "apart"),
    [
        ({}, False),
        ({"look": Look(tones=(0.5,))}, True),
        ({"look": Look(shade_strength=0.5)}, True),
        ({"look": Look(ink_light=0.5)}, False),
        ({"default_material": Material(look="cel")}, True),
        ({"lights": (replace(LIGHTS[0], colours=("#ff0000",)),)}, True),
    ],
)
def test_lights_stay_apart_where_the_look_needs_them(
    change: dict[str, object], apart: bool
) -> None:
    scene = replace(lit(), **change)  # type: ignore[arg-type]
    assert needs_each_light(scene, MaterialTable.of(scene, ())) is apart


def test_ambient_light_stays_apart_where_paint_reflects_less_of_it() -> None:
    plain = lit()
    for scene, apart in (
        (plain, False),
        (replace(plain, look=Look(contact=0.5)), True),
        (replace(plain, default_material=Material(glossy=True, gloss=0.1)), True),
    ):
        materials = MaterialTable.of(scene, ())
        assert needs_ambient(scene, materials) is apart
        assert not needs_each_light(scene, materials)


def test_glossy_paint_looks_the_same_under_a_mixture_of_the_lights() -> None:
    gloss = Material(glossy=True, gloss=0.6)
    drawing, scene = decompose_drawing(draw_ball(SIZE)), replace(lit(), default_material=gloss)
    ambient, lights = random_light(3), (random_light(1), random_light(2))
    dark = replace(scene, ambient=replace(scene.ambient, strength=0.0))
    together = replace(mixed(Passes(lights, ambient), dark), ambient=ambient)
    one, other = (
        composite(drawing, passes, scene).astype(int)
        for passes in (Passes(lights, ambient), together)
    )
    assert abs(one - other).max() <= 1


def test_suns_beside_other_lights_and_lights_without_shadows_stay_apart() -> None:
    sun = replace(LIGHTS[1], kind="sun")
    assert all(mixable(lights) for lights in ((), LIGHTS, (sun,)))
    assert not mixable((LIGHTS[0], replace(LIGHTS[1], casts_shadow=False)))
    assert not mixable((LIGHTS[0], sun))
    assert not mixable((sun, sun))


def test_only_light_that_is_seen_is_traced() -> None:
    scene = replace(lit(), lights=(replace(LIGHTS[0], on=False), LIGHTS[1]))
    request = as_mixture(
        RenderRequest(plane(8, 8), scene.canvas, scene.lights), scene, with_ambient=True
    )
    assert request.lights == (LIGHTS[1],)
    assert request.mixed_with == scene.ambient
    assert not request.ambient
    apart = as_mixture(request, scene, with_ambient=False)
    assert apart.ambient
    assert apart.mixed_with is not None
    assert apart.mixed_with.strength == 0


def test_the_ambient_light_beside_a_mixture_is_traced_once() -> None:
    cache, drawing, scene = LightPassCache(), object(), lit()
    asked: list[bool] = []

    def shown(
        scene: Scene, number: int, device: DeviceKind = "cpu", of: object = drawing
    ) -> Passes:
        def trace(ambient: bool) -> Passes:
            asked.append(ambient)
            light = random_light(number) if ambient else DARK
            return Passes((), light, mixture=random_light(100 + number), device=device)

        return cache.beside_mixture(of, scene, trace)

    def is_light(found: Passes, number: int) -> bool:
        return np.array_equal(found.ambient.diffuse, random_light(number).diffuse)

    moved = replace(scene, lights=(LIGHTS[1], LIGHTS[0]))
    assert is_light(shown(scene, 1), 1)
    assert is_light(shown(moved, 2), 1)
    assert asked == [True, False]
    assert is_light(shown(replace(moved, floor=None), 3), 3)
    assert is_light(shown(replace(moved, floor=None), 4, of=object()), 4)
    assert asked == [True, False, True, True]
    # One picture has the light of one device.
    assert is_light(shown(scene, 5, of=drawing), 5)
    assert is_light(shown(moved, 6, "cuda"), 6)
    assert asked[4:] == [True, False, True]
