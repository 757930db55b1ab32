"""Light contributions: the light of a scene on one drawing, in parts that are traced and cached
separately."""

from __future__ import annotations

import math
from collections.abc import Hashable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..choices import GlowName
from ..colour import hex_linear
from ..composite.illumination import glow_weight
from ..composite.linking import Link
from ..composite.resample import Box
from ..materials import MaterialTable
from ..prepared import PreparedDrawing
from ..render.request import Surface
from ..render.wire import Accumulate
from ..scene import AreaLight, Canvas, Floor, Scene, shining
from .refinement import REFINEMENT, RefinementLevel

VERTICES = 250
"""Number of vertices along the longer side of a preview's relief."""

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class LightContribution:
    """One light, the ambient light or a glow, on the character or on the floor.

    Attributes:
        kin: all that affects the traced light, except the amounts of gloss and where a light is.
        place: of a light, all else that affects it; otherwise what shapes a glow, or None.
        amounts: amounts of gloss by swatch. They change the light little, so light with other
            amounts is shown until it is traced again.
        weight: (3,) colour times power, used only by the composite.
        light: None is the ambient light, or that of ``glow``.
        link: what it lights, used only by the composite; None is everything.
        area: the traced part of the drawing, in its pixels.
    """

    kin: Hashable
    place: Hashable
    amounts: tuple[float, ...]
    weight: Floats
    light: AreaLight | None
    subject: Literal["character", "floor"]
    area: Box
    canvas: Canvas
    floor: Floor | None
    glow: GlowName | None = None
    link: Link | None = None

    @property
    def key(self) -> Hashable:
        """All that affects the traced light, except the amounts of gloss."""
        return self.kin, self.place

    @property
    def is_ambient(self) -> bool:
        """Whether this is the ambient light."""
        return self.light is None and self.glow is None

    def distance_to(self, other: LightContribution) -> float:
        """How far the lights of two contributions are apart, in default heights."""
        one, two = self.light, other.light
        if one is None or two is None:
            return 0.0
        apart = (one.x - two.x, one.y - two.y, one.z - two.z, one.size - two.size)
        return math.hypot(*apart) / self.canvas.default_height

    @property
    def refinement(self) -> tuple[RefinementLevel, RefinementLevel]:
        """The refinement levels ``LOW`` and ``CONVERGED`` of this contribution."""
        if self.subject == "floor":
            return REFINEMENT["floor"]
        return REFINEMENT["light" if self.light else "ambient"]

    def accumulation(
        self, level: RefinementLevel, first: int, count: int, *, resolve: bool
    ) -> Accumulate:
        """The request for samples ``first`` to ``first + count`` of ``level``."""
        _, _, width, height = self.area
        scale = level.longest / max(width, height)
        size = max(1, round(width * scale)), max(1, round(height * scale))
        return Accumulate(
            self.canvas, self.area, size, self.light, self.floor, self.subject,
            level.spp, first, count, resolve, self.glow,
        )  # fmt: skip


def contributions_of(
    scene: Scene, drawing: PreparedDrawing, character: Box
) -> tuple[LightContribution, ...]:
    """The contributions of ``scene``: first those on the character, then those on the floor.

    Lights that do not shine, or have no power, are omitted.

    Args:
        scene: in pixels of the drawing.
        character: the traced part of the character, see ``character_area``.
    """
    materials = _materials(scene, drawing)
    shared = scene.render_key(materials=False, sampling=False), materials.key
    floor = None if scene.floor is None else replace(scene.floor, extra={})
    whole = (0.0, 0.0, float(drawing.size[0]), float(drawing.size[1]))
    lights = [
        (light, hex_linear(light.colour) * np.float32(light.power))
        for light, shines in zip(scene.lights, shining(scene.lights), strict=True)
        if shines
    ]
    ambient = hex_linear(scene.ambient.colour) * np.float32(scene.ambient.strength)
    glows = drawing.glows(scene)
    found = []
    for subject in ("character", "floor") if floor else ("character",):
        area = character if subject == "character" else whole
        for light, weight in (*lights, (None, ambient)):
            occluding = light is None and subject == "character" and scene.look.contact > 0
            link = None if light is None else Link.of(light)
            if (not weight.any() and not occluding) or (link is not None and subject == "floor"):
                continue
            kind = light and (light.kind, light.casts_shadow)
            kin = (drawing.digest, drawing.detail, shared, subject, area, kind)
            found.append(
                LightContribution(
                    kin,
                    light and light.geometry,
                    materials.amounts,
                    weight,
                    light and light.neutral(),
                    subject,
                    area,
                    scene.canvas,
                    floor,
                    link=link,
                )
            )
        for glow, shaped in glows.items():
            found.append(
                LightContribution(
                    (drawing.digest, drawing.detail, shared, subject, area, glow),
                    shaped,
                    materials.amounts,
                    glow_weight(glow, scene),
                    None,
                    subject,
                    area,
                    scene.canvas,
                    floor,
                    glow,
                )
            )
    return tuple(found)


def preview_surface(drawing: PreparedDrawing, scene: Scene) -> Surface:
    """The surface of ``drawing`` in the resolution for previews."""
    return drawing.surface(scene, max(1, round(max(drawing.mask.shape) / VERTICES)))


def surface_key(scene: Scene, drawing: PreparedDrawing) -> Hashable:
    """All that affects ``preview_surface(drawing, scene)``."""
    materials = _materials(scene, drawing)
    bare = replace(scene, canvas=Canvas(1, 1), floor=None).render_key(
        materials=False, sampling=False
    )
    glow = materials.glow.tolist()
    return drawing.digest, drawing.detail, bare, materials.key, materials.amounts, tuple(glow)


def character_area(drawing: PreparedDrawing, crop: Box) -> Box:
    """The part of the character to trace: all of it, or the visible part if that is far smaller."""
    x, y, width, height = drawing.box
    left, top = max(x, crop[0]), max(y, crop[1])
    right, bottom = min(x + width, crop[0] + crop[2]), min(y + height, crop[1] + crop[3])
    if (
        right - left < 1
        or bottom - top < 1
        or max(right - left, bottom - top) > max(width, height) / 2
    ):
        return drawing.box
    return left, top, right - left, bottom - top


def _materials(scene: Scene, drawing: PreparedDrawing) -> MaterialTable:
    return MaterialTable.of(scene, drawing.palette.colours)
