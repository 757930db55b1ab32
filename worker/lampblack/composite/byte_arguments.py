"""What the compiled loop over byte layers is given, as tuples that numba knows by name."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..materials import MaterialTable
from .borders import swatch_albedos
from .byte_layers import ByteLayers
from .resample import Band, Box, enlarge
from .rim import RimLight
from .shading import Shading
from .tones import Tones

DIFFUSE, GLOSSY, CEL, GLOW = 1, 2, 4, 8
"""Bits of a kind of paint."""
LIT = DIFFUSE | GLOSSY

Place = tuple[float, float, float, float]
"""(step, start) along x, then along y: pixel ``i`` of the layers is at ``start + i * step`` of an
area, which extends from 0 to 1."""
Floats = NDArray[np.float32]

UNIT = np.ones((1, 1, 3), np.float32)
_NONE = np.zeros(1, np.float32)


class Planes(NamedTuple):
    """See ``ByteLayers``."""

    pixels: Any
    albedo: Any
    ink: Any
    ink_colour: Any
    coverage: Any
    labels: Any
    others: Any
    shares: Any

    @staticmethod
    def of(layers: ByteLayers) -> Planes:
        """The arrays of ``layers``."""
        return Planes(*(getattr(layers, name) for name in Planes._fields))


class Paints(NamedTuple):
    """By label: the colour, (n, 3) scene-linear; the kind; gloss and emission, see
    ``MaterialTable``."""

    swatches: Any
    kinds: Any
    gloss: Any
    emission: Any

    @staticmethod
    def of(materials: MaterialTable, layers: ByteLayers) -> Paints:
        """The paint of each label of ``layers``."""
        kinds = materials.diffuse * np.uint8(DIFFUSE) + materials.glossy * np.uint8(GLOSSY)
        kinds += np.where(kinds > 0, materials.cel * np.uint8(CEL), np.uint8(0))
        kinds += (materials.emission > 0) * np.uint8(GLOW)
        swatches = swatch_albedos(layers.palette)
        return Paints(swatches, kinds, materials.gloss, materials.emission)


class FigureLight(NamedTuple):
    """Light on the character, see ``Illumination`` and ``Shading``; where its pixels are in it."""

    place: Place
    diffuse: Any
    glossy: Any
    sheen: Any
    has_contact: bool
    contact: Any

    @staticmethod
    def of(shading: Shading, paints: Paints, place: Place) -> FigureLight:
        """The sums of light that some paint needs; the others are not computed."""
        light, contact = shading.illumination, shading.contact
        smooth = paints.kinds[paints.kinds & CEL == 0]
        return FigureLight(
            place,
            light.diffuse if (smooth & DIFFUSE > 0).any() else UNIT,
            light.glossy if (smooth & LIT == GLOSSY).any() else UNIT,
            light.sheen if (smooth & LIT == LIT).any() else UNIT,
            contact is not None,
            UNIT[..., 0] if contact is None else np.ascontiguousarray(contact[..., 0]),
        )


class ToneSteps(NamedTuple):
    """See ``Tones``."""

    amount: Any
    shine: Any
    lit: Any
    shade: Any
    cast: Any
    cast_shade: Any
    cast_low: Any
    cast_high: Any
    lows: Any
    highs: Any
    shine_lows: Any
    shine_highs: Any
    tint: Any
    strength: Any

    @staticmethod
    def of(tones: Tones | None) -> ToneSteps:
        """``tones``; of none, those that no paint uses."""
        if tones is None:
            dark, black, none = UNIT[..., 0], UNIT[0, 0], np.float32(0)
            return ToneSteps(dark, dark, UNIT, black, dark, black, *(_NONE,) * 6, black, none)
        return ToneSteps(
            tones.amount, tones.shine, tones.lit, tones.shade,
            tones.cast, tones.cast_shade, *tones.cast_steps, tones.lows, tones.highs,
            tones.highlight[:1], tones.highlight[1:], tones.tint, tones.strength,
        )  # fmt: skip


class PartLights(NamedTuple):
    """Light on parts of the character: their number, diffuse and glossy light, which labels and
    which layers each reaches, and the layer of each pixel."""

    number: int
    diffuse: Any
    glossy: Any
    labels: Any
    layers: Any
    owners: Any

    @staticmethod
    def of(shading: Shading, layers: ByteLayers) -> PartLights:
        """The parts of ``shading``, all at the size of the largest."""
        parts = shading.parts
        if not parts:
            none = np.zeros((1, 1), np.bool_)
            return PartLights(0, UNIT[None], UNIT[None], none, none, np.zeros((1, 1), np.int8))
        owners = layers.owners
        if owners is None:
            owners = np.full(layers.labels.shape, -1, np.int8)
        size = max((light.shape for _, light, _ in parts), key=lambda shape: shape[0] * shape[1])
        band = Band(size[1], size[0], 0, size[0])
        return PartLights(
            len(parts),
            np.stack([enlarge(light, band) for _, light, _ in parts]),
            np.stack([enlarge(light, band) for _, _, light in parts]),
            np.stack([link.labels(layers.palette) for link, _, _ in parts]),
            np.stack([link.owners(layers.layers) for link, _, _ in parts]),
            owners,
        )


class RimBand(NamedTuple):
    """The rim, see ``rim_share``: whether there is one, the edges that it follows, sizes, and
    where the strongest light is."""

    shown: bool
    edges: Any
    unit: float
    width: float
    pixel: float
    strength: float
    away: float
    key: tuple[float, float]
    step: tuple[float, float]
    colour: Any

    @staticmethod
    def of(rim: RimLight | None, layers: ByteLayers, crop: Box) -> RimBand:
        """``rim`` on the part of the drawing in ``crop``."""
        edges = layers.edges
        if rim is None or edges is None:
            sizes, none = (0.0,) * 5, (0.0, 0.0)
            return RimBand(False, layers.ink, *sizes, none, none, UNIT[0, 0])
        across, down = crop[2] / layers.size[0], crop[3] / layers.size[1]
        key = rim.key[0] - crop[0], rim.key[1] - crop[1]
        return RimBand(
            True, edges, layers.edge_unit, rim.width, max(across, down), rim.strength, rim.away,
            key, (across, down), rim.colour,
        )  # fmt: skip


class Ground(NamedTuple):
    """The floor: whether there is one, its light with the character over that without it, where
    no pixel is in shadow, and where pixels are in it."""

    shown: bool
    ratio: Any
    unshaded: Any
    place: Place

    @staticmethod
    def of(ratio: Floats | None, place: Place) -> Ground:
        """The floor with ``ratio``, (h, w, 3); None is no floor."""
        if ratio is None:
            return Ground(False, UNIT, np.ones((1, 1), np.bool_), place)
        clear = (np.abs(ratio - 1) < 1e-3).all(axis=2)
        near = np.asarray(ndimage.minimum_filter(clear, 3, mode="nearest"))
        return Ground(True, ratio, near, place)


def place_of(crop: Box, size: tuple[int, int], area: Box | None) -> Place:
    """Where ``size`` (width, height) pixels that show ``crop`` are in ``area``; None is all."""
    area, found = area or crop, []
    for axis in (0, 1):
        step = crop[axis + 2] / size[axis] / area[axis + 2]
        found += [step, (crop[axis] - area[axis]) / area[axis + 2] + step / 2]
    return found[0], found[1], found[2], found[3]
