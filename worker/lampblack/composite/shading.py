"""Shading: what the look of a scene makes of its light, once for all pixels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..materials import MaterialTable
from ..scene import Look, Scene
from .blur import blurred
from .illumination import Illumination
from .linking import Link
from .resample import Box
from .rim import RimLight
from .tones import Tones, toned_floor, toned_part, tones_of

CLOSED, OPEN = 0.15, 0.85
"""Ambient light at which a place counts as fully covered, and as open."""

Floats = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Shading:
    """The light of a scene on a drawing, with its look.

    Attributes:
        illumination: the light itself.
        materials: those of the drawing.
        tones: the light in tones; None where none of the drawing needs them.
        floor_ratio: as in ``Illumination``, in tones if the scene is.
        contact: (h, w, 1) by what light is multiplied where surfaces touch, or None.
        rim: the rim, or None.
        ink_light: how far the line takes light, 0 to 1.
        parts: as in ``Illumination``, in tones if the scene is.
    """

    illumination: Illumination
    materials: MaterialTable
    tones: Tones | None
    floor_ratio: Floats | None
    contact: Floats | None
    rim: RimLight | None
    ink_light: float
    parts: tuple[tuple[Link, Floats, Floats], ...]

    @staticmethod
    def of(
        illumination: Illumination, scene: Scene, materials: MaterialTable, pixel: float, area: Box
    ) -> Shading:
        """The look of ``scene`` for this light.

        Args:
            pixel: width of a pixel of the result, in pixels of the drawing.
            area: what the light on the character covers, in pixels of the drawing.
        """
        look = scene.look
        tones = None
        if _needs_tones(look, materials):
            shine = bool((materials.cel & materials.glossy).any())
            tones = tones_of(illumination, scene, pixel, area, shine=shine)
        ratio = illumination.floor_ratio
        if ratio is not None and look.tones:
            ratio = toned_floor(ratio, scene)
        contact = None
        if look.contact and illumination.openness is not None:
            contact = _contact(illumination.openness, look.contact, scene, area)
        rim = RimLight.of(scene)
        parts = tuple(illumination.parts)
        if look.tones:
            parts = tuple((link, toned_part(d, link, scene, area), g) for link, d, g in parts)
        return Shading(illumination, materials, tones, ratio, contact, rim, look.ink_light, parts)


def needs_each_light(scene: Scene, materials: MaterialTable) -> bool:
    """Whether the composite tells the lights of ``scene`` apart: their sum is not enough for it."""
    linked = any(Link.of(light) is not None for light in scene.lights)
    return linked or _needs_tones(scene.look, materials)


def needs_ambient(scene: Scene, materials: MaterialTable) -> bool:
    """Whether the composite tells the ambient light of ``scene`` from its lights: glossy paint
    reflects less of it."""
    return bool(materials.gloss.any()) or scene.look.contact > 0


def _needs_tones(look: Look, materials: MaterialTable) -> bool:
    cel = materials.cel & (materials.diffuse | materials.glossy)
    return bool(cel.any() or (look.shade_strength and materials.diffuse.any()))


def _contact(openness: Floats, strength: float, scene: Scene, area: Box) -> Floats:
    longest = max(scene.canvas.width, scene.canvas.height)
    blur = max(0.5, 0.001 * longest * openness.shape[1] / area[2])
    light = blurred(openness @ np.full(3, 1 / 3, np.float32), blur)
    share = np.clip((light - CLOSED) / (OPEN - CLOSED), 0, 1)
    return np.asarray(1 - strength * (1 - share[..., None]), np.float32)
