"""The sources of a scene on one drawing, each traced on its own and known by what shapes it."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..camera import scene_in_view
from ..colour import hex_linear
from ..composite.sheet import Box
from ..render import Expose
from ..scene import AreaLight, Canvas, Floor
from .model import Model
from .snapshot import Snapshot

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class Rung:
    """One step of refinement: lighting pixels along the longer side, samples per pixel, and how
    many of these are traced before newer work is looked for."""

    longest: int
    spp: int
    at_once: int


MOVING = (Rung(64, 1, 1), Rung(96, 1, 1), Rung(128, 1, 1))
"""While something changes: the finest that keeps up is taken."""

LADDERS: dict[str, tuple[Rung, Rung]] = {
    "light": (Rung(192, 4, 2), Rung(384, 8, 1)),
    "ambient": (Rung(128, 8, 4), Rung(384, 12, 1)),
    "floor": (Rung(96, 8, 2), Rung(192, 16, 1)),
}
"""While nothing changes: low, then about medium, in pieces short enough to be left."""
FIRST_AMBIENT = Rung(96, 4, 4)
FIRST_FLOOR = Rung(64, 1, 1)
FIRST_FLOOR_AMBIENT = Rung(64, 4, 4)
"""What is traced once may take longer than what moves."""
LOW, CONVERGED = 1, 2


@dataclass(frozen=True)
class Source:
    """One light, or the ambient light, on the figure or on the floor.

    Attributes:
        key: all that shapes its light, but for the amounts of gloss.
        amounts: of gloss, by swatch: another amount changes little, and the light at hand will
            do until it is traced again.
        weight: (3,) colour times power, which only the composite uses.
        light: None is the ambient light.
        area: what it covers, pixels of the drawing.
    """

    key: Hashable
    amounts: tuple[float, ...]
    weight: Floats
    light: AreaLight | None
    subject: Literal["figure", "floor"]
    area: Box
    canvas: Canvas
    floor: Floor | None

    @property
    def ladder(self) -> tuple[Rung, Rung]:
        """Its rungs ``LOW`` and ``CONVERGED``."""
        return LADDERS["floor" if self.subject == "floor" else "light" if self.light else "ambient"]

    def exposure(self, rung: Rung, first: int, count: int, *, develop: bool) -> Expose:
        """Ask for samples ``first`` to ``first + count`` of ``rung``."""
        _, _, width, height = self.area
        scale = rung.longest / max(width, height)
        size = max(1, round(width * scale)), max(1, round(height * scale))
        return Expose(
            self.canvas, self.area, size, self.light, self.floor, self.subject,
            rung.spp, first, count, develop,
        )  # fmt: skip


def sources_of(snapshot: Snapshot, model: Model) -> tuple[Source, ...]:
    """What has to be traced for a snapshot: first the figure's light, then the floor's.

    Sources that give no light are left out.
    """
    if snapshot.scene is None:
        return ()
    scene = scene_in_view(snapshot.scene, snapshot.camera, model.size)
    swatches = [scene.material(swatch.colour) for swatch in model.sheet.palette.swatches]
    swatches.append(scene.default_material)
    wear = tuple((m.glossy and m.gloss > 0, m.roughness) for m in swatches)
    amounts = tuple(m.gloss if m.glossy else 0.0 for m in swatches)
    floor = None if scene.floor is None else replace(scene.floor, extra={})
    whole = (0.0, 0.0, float(model.size[0]), float(model.size[1]))
    figure = figure_area(model, snapshot.look.crop)
    lights = [(light, hex_linear(light.colour) * np.float32(light.power)) for light in scene.lights]
    ambient = hex_linear(scene.ambient.colour) * np.float32(scene.ambient.strength)
    found = []
    for subject in ("figure", "floor") if floor else ("figure",):
        area = figure if subject == "figure" else whole
        for light, weight in (*lights, (None, ambient)):
            if not weight.any():
                continue
            shape = light and AreaLight(light.x, light.y, light.z, light.size)
            at = shape and (shape.x, shape.y, shape.z, shape.size)
            ground = floor and (floor.y, floor.pitch)
            key = (model.digest, model.grade, scene.relief_scale, wear, subject, area, at, ground,
                   scene.canvas.width, scene.canvas.height)  # fmt: skip
            found.append(Source(key, amounts, weight, shape, subject, area, scene.canvas, floor))
    return tuple(found)


def figure_area(model: Model, crop: Box) -> Box:
    """What of the figure is traced: all of it, or what is in sight when that is far less."""
    x, y, width, height = model.box
    left, top = max(x, crop[0]), max(y, crop[1])
    right, bottom = min(x + width, crop[0] + crop[2]), min(y + height, crop[1] + crop[3])
    if (
        right - left < 1
        or bottom - top < 1
        or max(right - left, bottom - top) > max(width, height) / 2
    ):
        return model.box
    return left, top, right - left, bottom - top
