"""Bloom: the glow around emissive colours, as of a bright lamp in a lens."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy import ndimage

from ..colour import linear, srgb
from ..drawing.drawing import Drawing
from ..materials import MaterialTable
from ..scene import Scene
from .byte_layers import ByteLayers
from .resample import Band, enlarge

MOST_PX = 256
"""Longest side at which light is spread."""
SPREADS = ((0.008, 0.5), (0.03, 0.4), (0.09, 0.1))
"""Deviations of the spread light, as shares of the canvas's longer side, and their shares."""
MOST = 0.85
BRIGHT = 2.5
"""Light that is spread of a colour with an emission of 1, in that of one that is fully lit."""

Floats = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Bloom:
    """Spread light, (h, w, 3) scene-linear in 0 to 1, over all of a picture."""

    light: Floats

    def over(self, picture: Floats, band: Band) -> Floats:
        """The glow screened onto the rows ``band``: (rows, W, 4) sRGB in 0..1, premultiplied. It
        is light, so it shows on empty canvas too."""
        glow = srgb(enlarge(self.light, band))
        light = picture[..., :3] + glow * (1 - picture[..., :3])
        alpha = 1 - (1 - picture[..., 3:]) * (1 - glow.max(axis=2, keepdims=True))
        return np.concatenate([light, np.maximum(alpha, picture[..., 3:])], axis=2)


def bloom_of(
    layers: Drawing | ByteLayers, materials: MaterialTable, scene: Scene, pixel: float
) -> Bloom | None:
    """The bloom of what the layers show; None where nothing glows.

    Args:
        pixel: width of a pixel of the layers, in pixels of the drawing.
    """
    strength = scene.look.glow * scene.brightest
    place = _glowing_part(layers.labels, materials.glow) if strength > 0 else None
    if place is None:
        return None
    width, height = layers.size
    scale = min(1.0, MOST_PX / max(width, height))
    small = max(1, round(width * scale)), max(1, round(height * scale))
    share = materials.glow[layers.labels[place]] * np.float32(strength)
    cover, albedo = layers.coverage[place], layers.albedo[place]
    if isinstance(layers, ByteLayers):
        cover, albedo = cover.astype(np.float32) / 255.0, albedo.astype(np.float32) / 255.0
    emitted = linear(albedo) * (share * cover)[..., None]
    longest = max(scene.canvas.width, scene.canvas.height) * small[0] / (width * pixel)
    spread = np.zeros((small[1], small[0], 3), np.float32)
    whole = np.zeros((height, width), np.float32)
    for channel in range(3):
        whole[place] = emitted[..., channel]
        plane = np.asarray(Image.fromarray(whole).resize(small, Image.Resampling.BOX))
        for deviation, weight in SPREADS:
            spread[..., channel] += weight * ndimage.gaussian_filter(
                plane, deviation * longest, mode="constant", truncate=3
            )
    # Not all the way to white, so that a flame keeps its colour.
    return Bloom((MOST * -np.expm1(-BRIGHT * spread)).astype(np.float32))


def _glowing_part(labels: NDArray[np.int16], glow: Floats) -> tuple[slice, slice] | None:
    """The box around the pixels whose colour is emissive; None without any.

    Args:
        glow: (n + 1,) by label, as in ``MaterialTable``.
    """
    if not glow.any():
        return None
    bright = glow[labels] > 0
    rows, columns = np.flatnonzero(bright.any(axis=1)), np.flatnonzero(bright.any(axis=0))
    if not len(rows):
        return None
    return slice(int(rows[0]), int(rows[-1]) + 1), slice(int(columns[0]), int(columns[-1]) + 1)
