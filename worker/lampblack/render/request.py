"""Requests to the render process: a surface, its lights, and a part of the canvas."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..choices import GlowName
from ..colour import linear
from ..drawing.palette import Palette
from ..materials import MaterialTable
from ..scene import Ambient, AreaLight, Canvas, Floor, Scene, shining
from ..surface.relief import Relief
from .emitters import Emitter
from .quality import QUALITIES, Quality


@dataclass(frozen=True)
class Surface:
    """The relief, and the material of each of its V vertices.

    Attributes:
        relief: canvas pixels.
        albedo: (V, 3) float32, scene-linear. It colours the light that the vertex reflects, also
            for unlit and glossy-only colours.
        gloss: (V,) float32 in 0..1, amount of the glossy lobe.
        roughness: (V,) float32 in 0.02..1.
        emitters: meshes that give light, by name.
    """

    relief: Relief
    albedo: NDArray[np.float32]
    gloss: NDArray[np.float32]
    roughness: NDArray[np.float32]
    emitters: Mapping[GlowName, Emitter] = field(default_factory=dict)


@dataclass(frozen=True)
class RenderRequest:
    """One trace: the lights to trace on a surface.

    Attributes:
        surface: the child keeps it until another one comes, so moving a light is fast.
        canvas: its ``default_height`` calibrates the lights.
        lights: area lights to trace, as white lights of power 1; the composite applies colour and
            power.
        ambient: trace the ambient light as well.
        floor: the shadow-catching floor, or None.
        rect: part of the canvas to trace, (x, y, width, height) in canvas pixels; None for all.
        quality: resolution and samples.
        glows: trace the light of these emitters of the surface as well.
        mixed_with: trace ``lights`` and this ambient light as one, in their colours and powers;
            with ``ambient``, that of strength 1 on its own as well.
    """

    surface: Surface
    canvas: Canvas
    lights: tuple[AreaLight, ...]
    ambient: bool = True
    floor: Floor | None = None
    rect: tuple[float, float, float, float] | None = None
    quality: Quality = QUALITIES["low"]
    glows: Collection[GlowName] = ()
    mixed_with: Ambient | None = None

    @property
    def view(self) -> tuple[float, float, float, float]:
        """The traced part, (x, y, width, height) in canvas pixels."""
        return self.rect or (0.0, 0.0, float(self.canvas.width), float(self.canvas.height))


def frame_request(size: tuple[int, int], surface: Surface, scene: Scene) -> RenderRequest:
    """Request all light of ``scene`` on a drawing of ``size`` (width, height), which may differ
    from the canvas's."""
    width, height = size
    whole = (scene.canvas.width, scene.canvas.height) == size
    return RenderRequest(
        surface=surface,
        canvas=scene.canvas,
        lights=scene.lights,
        floor=scene.floor,
        rect=None if whole else (0.0, 0.0, float(width), float(height)),
        quality=QUALITIES[scene.quality],
    )


def mixable(lights: Sequence[AreaLight]) -> bool:
    """Whether ``lights`` can be traced as one: all of them cast shadows, and none is a sun beside
    others, since Cycles' light tree then loses up to a twentieth of its light."""
    alone = len(lights) < 2
    return all(light.casts_shadow and (alone or light.kind == "lamp") for light in lights)


def as_mixture(request: RenderRequest, scene: Scene, *, with_ambient: bool) -> RenderRequest:
    """``request`` for all lights of ``scene``, traced as one; its ambient light is part of that, or
    on its own."""
    shown = zip(scene.lights, shining(scene.lights), strict=True)
    return replace(
        request,
        lights=tuple(light for light, shines in shown if shines and light.power),
        ambient=not with_ambient,
        mixed_with=scene.ambient if with_ambient else replace(scene.ambient, strength=0.0),
    )


def vertex_pixels(
    labels: NDArray[np.int16], vertices: NDArray[np.float32]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """(V,) rows and (V,) columns of the pixel of ``labels``, (H, W), under each vertex; for
    vertices past the character's edge, of the nearest pixel inside."""
    height, width = labels.shape
    column = np.clip(vertices[:, 0].astype(np.intp), 0, width - 1)
    row = np.clip(vertices[:, 1].astype(np.intp), 0, height - 1)
    if (labels >= 0).any():
        row, column = ndimage.distance_transform_edt(
            labels < 0, return_distances=False, return_indices=True
        )[:, row, column]
    return row, column


def assign_materials(
    relief: Relief,
    albedo: NDArray[np.float32],
    labels: NDArray[np.int16],
    palette: Palette,
    scene: Scene,
) -> Surface:
    """Give each vertex the material of its flat colour in ``scene``.

    Args:
        albedo: (V, 3) sRGB in 0..1 of the pixel under each vertex.
        labels: (V,) index into ``palette`` of that pixel, -1 for none.
    """
    materials = MaterialTable.of(scene, palette.colours)
    return Surface(relief, linear(albedo), materials.gloss[labels], materials.roughness[labels])
