"""The composite of byte layers, for previews: the same computation in one compiled loop."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from ..drawing.palette import Palette
from ..materials import MaterialTable
from ..processors import usable_processors
from ..scene import Look, Material, Rim, Scene, default_scene
from .bloom import bloom_of
from .byte_arguments import (
    FigureLight,
    Ground,
    Paints,
    PartLights,
    Planes,
    RimBand,
    ToneSteps,
    place_of,
)
from .byte_kernel import light_pixels
from .byte_layers import ByteLayers
from .illumination import Illumination
from .resample import Band, Box
from .samples import LINEAR, SRGB
from .shading import Shading

THREADS = min(4, usable_processors())
"""Threads that share the rows of a picture."""


def composite_bytes(
    layers: ByteLayers, illumination: Illumination, scene: Scene, crop: Box
) -> NDArray[np.uint8]:
    """The layers, lit: (H, W, 4) uint8 sRGB, premultiplied; see ``composite``.

    Args:
        layers: cut from a drawing.
        crop: the part of the drawing that they show, in its pixels.
    """
    materials = MaterialTable.of(scene, layers.palette.colours)
    width, height = layers.size
    area = illumination.character_area or crop
    pixel = max(crop[2] / width, crop[3] / height)
    shading = Shading.of(illumination, scene, materials, pixel, area)
    paints = Paints.of(materials, layers)
    lit = np.empty((height, width, 4), np.uint8)
    arguments = (
        Planes.of(layers),
        paints,
        FigureLight.of(shading, paints, place_of(crop, layers.size, area)),
        ToneSteps.of(shading.tones),
        PartLights.of(shading, layers),
        RimBand.of(shading.rim, layers, crop),
        Ground.of(shading.floor_ratio, place_of(crop, layers.size, illumination.floor_area)),
        np.float32(shading.ink_light),
        (LINEAR, SRGB),
    )

    def write(first: int) -> None:
        light_pixels(*arguments, (first, THREADS), lit)

    list(_threads().map(write, range(THREADS)))
    bloom = bloom_of(layers, materials, scene, pixel)
    if bloom is not None:
        shown = bloom.over(lit.astype(np.float32) / 255.0, Band(width, height, 0, height))
        lit = np.rint(shown * 255).astype(np.uint8)
    return lit


@cache
def _threads() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(THREADS, "composite")


def warm_up() -> None:
    """Load all compiled loops, or compile them."""
    grey, bytes_ = np.zeros((1, 1, 3), np.uint8), np.zeros((1, 1), np.uint8)
    label = np.full((1, 1), -1, np.int16)
    pixels, palette = np.zeros((1, 1, 4), np.uint8), Palette(())
    layers = ByteLayers(
        pixels, grey, bytes_, grey, bytes_, label, label, bytes_, palette, bytes_, 1.0
    )
    unit = np.ones((1, 1, 3), np.float32)
    white = np.ones(3, np.float32), unit, unit
    light = Illumination([white], floor=[white], openness=unit)
    look = Look(tones=(0.5,), contact=0.5)
    styled = replace(default_scene(1, 1), look=look, rim=Rim())
    styled = replace(styled, default_material=Material(glossy=True))
    for scene in (default_scene(1, 1), styled):
        composite_bytes(layers, light, scene, (0, 0, 1, 1))
