"""A field that somebody adds to the scene cannot show a stale picture."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, replace

import numpy as np
import pytest

from lampblack.drawing import decompose_drawing
from lampblack.materials import MaterialTable
from lampblack.prepared import PreparedDrawing
from lampblack.preview.contribution import contributions_of
from lampblack.render.light_pass_cache import LightPassCache
from lampblack.render.passes import LightPasses, Passes
from lampblack.scene import Ambient, AreaLight, Floor, Material, Scene, default_scene
from support.drawings import draw_ball


@dataclass(frozen=True)
class NewLight(AreaLight):
    softness: float = 0.0


@dataclass(frozen=True)
class NewFloor(Floor):
    wetness: float = 0.0


@dataclass(frozen=True)
class NewMaterial(Material):
    fuzz: float = 0.0


@dataclass(frozen=True)
class NewScene(Scene):
    fog: float = 0.0


def scene_with(light: float = 0, floor: float = 0, material: float = 0, scene: float = 0) -> Scene:
    plain = default_scene(100, 80)
    return NewScene(
        canvas=plain.canvas,
        lights=(NewLight(10, 20, 30, softness=light), AreaLight(50, 20, 30)),
        floor=NewFloor(70, wetness=floor),
        default_material=NewMaterial(fuzz=material),
        fog=scene,
    )


class Counter:
    """Counts the lights that are traced, ambient light included."""

    def __init__(self) -> None:
        self.traced = 0

    def __call__(self, scene: Scene, ambient: bool, glows: object) -> Passes:
        self.traced += len(scene.lights) + ambient
        passes = LightPasses(*(np.zeros((1, 1, 3), np.float32) for _ in range(2)))
        return Passes(tuple(passes for _ in scene.lights), passes)


@pytest.mark.parametrize(
    ("changed", "traced"),
    [({}, 0), ({"light": 1}, 1), ({"floor": 1}, 3), ({"material": 1}, 3), ({"scene": 1}, 3)],
)
def test_a_new_field_is_traced_again_by_itself(changed: dict[str, float], traced: int) -> None:
    cache, drawing, counter = LightPassCache(), object(), Counter()
    cache.complete(drawing, scene_with(), counter)
    assert counter.traced == 3
    cache.complete(drawing, scene_with(**changed), counter)
    assert counter.traced == 3 + traced


@pytest.mark.parametrize(
    ("changed", "missing"),
    [({}, 0), ({"light": 1}, 2), ({"floor": 1}, 6), ({"material": 1}, 6), ({"scene": 1}, 6)],
)
def test_a_preview_traces_a_new_field_again_too(changed: dict[str, float], missing: int) -> None:
    """Two lights and the ambient light, on the character and on the floor."""
    drawing = decompose_drawing(draw_ball(60))
    flat = np.zeros(drawing.mask.shape, np.float32)
    box = (0.0, 0.0, 60.0, 60.0)
    prepared = PreparedDrawing(
        digest="ball", detail="full", size=(60, 60), step=1, layers=drawing, scale=1.0,
        height=flat, mask=drawing.mask, normals=None, box=box,
    )  # fmt: skip

    def keys(scene: Scene) -> set[Hashable]:
        return {contribution.key for contribution in contributions_of(scene, prepared, box)}

    before = keys(scene_with())
    assert len(before) == 6
    assert len(keys(scene_with(**changed)) - before) == missing


def test_a_new_field_goes_to_the_renderer() -> None:
    light = NewLight(1, 2, 3, colour="#ff0000", power=4, softness=5)
    assert light.neutral() == NewLight(1, 2, 3, softness=5)


def test_what_only_the_composite_uses_is_not_traced_again() -> None:
    cache, drawing, counter = LightPassCache(), object(), Counter()
    scene = scene_with()
    cache.complete(drawing, scene, counter)
    light, other = scene.lights
    for changed in (
        replace(scene, lights=(replace(light, colour="#ff0000", power=3.0), other)),
        replace(scene, lights=(other, light)),
        replace(scene, ambient=Ambient("#00ff00", 1.0)),
        replace(scene, extra={"note": 1}),
        replace(scene, default_material=NewMaterial(diffuse=False)),
    ):
        cache.complete(drawing, changed, counter)
    assert counter.traced == 3


def test_materials_are_looked_up_by_label() -> None:
    shiny = Material(glossy=True, gloss=0.4, roughness=0.1)
    hidden = Material(diffuse=False, gloss=0.9)
    scene = replace(default_scene(9, 9), materials={"#ff0000": shiny, "#00ff00": hidden})
    table = MaterialTable.of(scene, ["#00ff00", "#ff0000", "#0000ff"])
    labels = np.array([0, 1, 2, -1])
    assert table.diffuse[labels].tolist() == [False, True, True, True]
    assert table.glossy[labels].tolist() == [False, True, False, False]
    assert table.gloss[labels] == pytest.approx([0, 0.4, 0, 0])
    assert table.amounts == (0.0, 0.4, 0.0, 0.0)

    def changed(**fields: object) -> MaterialTable:
        materials = {"#ff0000": replace(shiny, **fields)}  # type: ignore[arg-type]
        return MaterialTable.of(replace(scene, materials=materials), ["#ff0000"])

    before = changed()
    assert changed(gloss=0.5).key == before.key
    assert changed(gloss=0.5).amounts != before.amounts
    assert changed(gloss=0.0).key != before.key
    assert changed(roughness=0.5).key != before.key
