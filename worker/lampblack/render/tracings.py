"""Light that is at hand: under lights that move, only those that moved are traced again."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

from ..drawing.drawing import Drawing
from ..scene import AreaLight, Scene
from .passes import LightPasses, Passes

Place = tuple[float, float, float, float]
Trace = Callable[[Scene, bool], Passes]
"""Traces the lights of a scene and, if told so, its ambient light."""


@dataclass
class Tracings:
    """The light of the last scene on the last drawing, source by source."""

    _drawing: Drawing | None = None
    _shape: object = None
    _lights: dict[Place, LightPasses] = field(default_factory=dict)
    _ambient: LightPasses | None = None

    def complete(self, drawing: Drawing, scene: Scene, trace: Trace) -> Passes:
        """The passes of ``scene``; ``trace`` is asked for those that are not at hand."""
        shape = _shape(scene)
        if drawing is not self._drawing or shape != self._shape:
            self._lights, self._ambient = {}, None
        missing = {_place(light): light for light in scene.lights}
        missing = {place: light for place, light in missing.items() if place not in self._lights}
        if missing or self._ambient is None:
            asked = replace(scene, lights=tuple(missing.values()))
            found = trace(asked, self._ambient is None)
            self._lights |= dict(zip(missing, found.lights, strict=True))
            self._ambient = self._ambient or found.ambient
        self._drawing, self._shape = drawing, shape
        self._lights = {_place(light): self._lights[_place(light)] for light in scene.lights}
        return Passes(tuple(self._lights[_place(light)] for light in scene.lights), self._ambient)


def _place(light: AreaLight) -> Place:
    return light.x, light.y, light.z, light.size


def _shape(scene: Scene) -> object:
    """All but the lights that shapes the light: colour and power are left to the composite."""
    floor = scene.floor and (scene.floor.y, scene.floor.pitch)
    return (
        scene.canvas, scene.relief_scale, scene.quality, scene.materials, scene.default_material,
        floor,
    )  # fmt: skip
