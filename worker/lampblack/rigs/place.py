"""Rigs on canvases: taken from a scene, and placed in another."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeVar

from ..looks import scaled_rim
from ..scene import AreaLight, Canvas, LightKey, Rig, Scene

Lit = TypeVar("Lit", AreaLight, LightKey)
Box = tuple[float, float, float, float]
"""x, y, width, height in pixels of a canvas."""
_FARTHEST, _STRONGEST, _SMALLEST = 1e5, 100.0, 1.0


def rig_of(scene: Scene, name: str = "") -> Rig:
    """The light of ``scene``, on its own canvas."""
    return Rig(scene.canvas, name[:80], scene.lights, scene.ambient)


def with_rig(scene: Scene, rig: Rig, box: Box | None = None) -> Scene:
    """``scene`` in the light of ``rig``, which replaces its own.

    A lamp lights what is in ``box`` as it would on the rig's canvas: where the box is smaller than
    the canvas, the lamp is nearer and of less power.

    Args:
        box: where the rig's canvas comes to lie, on that of the scene; None is all of it.
    """
    canvas = scene.canvas
    x, y, width, height = box or (0.0, 0.0, float(canvas.width), float(canvas.height))
    unit = max(width, height) / 2
    place = _Place(
        rig.canvas, canvas, x + width / 2, y + height / 2, unit / rig.canvas.default_height
    )
    lit = replace(scene, lights=tuple(map(place.light, rig.lights)), ambient=rig.ambient)
    if rig.look is None and rig.rim is None:
        return lit
    return replace(lit, look=rig.look or scene.look, rim=scaled_rim(rig.rim, place.scale))


@dataclass(frozen=True)
class _Place:
    """From the canvas ``old`` to the canvas ``new``: ``scale``, with its middle at (x, y)."""

    old: Canvas
    new: Canvas
    x: float
    y: float
    scale: float

    def light(self, light: AreaLight) -> AreaLight:
        sun = light.kind == "sun"
        keys = tuple(self._moved(key, sun=sun) for key in light.keys)
        return replace(self._moved(light, sun=sun), keys=keys)

    def _moved(self, light: Lit, *, sun: bool) -> Lit:
        x, y = (self.new.width / 2, self.new.height / 2) if sun else (self.x, self.y)
        return replace(
            light,
            x=_within(x + self.scale * (light.x - self.old.width / 2)),
            y=_within(y + self.scale * (light.y - self.old.height / 2)),
            z=_within(self.scale * light.z),
            size=max(_SMALLEST, min(_FARTHEST, self.scale * light.size)),
            power=light.power if sun else min(_STRONGEST, light.power * self._dimming(light.size)),
        )

    def _dimming(self, size: float) -> float:
        """A lamp of power 1 has an irradiance of (1 + r^2) / (d^2 + r^2) at a distance of d, in
        units of the canvas's default height, where r is its radius."""
        radius = size / 2 / self.old.default_height
        nearer = self.scale * self.old.default_height / self.new.default_height
        return nearer**2 * (1 + radius**2) / (1 + (radius * nearer) ** 2)


def _within(place: float) -> float:
    return max(-_FARTHEST, min(_FARTHEST, place))
