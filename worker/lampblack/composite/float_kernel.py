"""The composite in floating point, for finals."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..colour import linear, srgb
from ..drawing.drawing import Drawing
from ..materials import MaterialTable
from ..scene import Scene
from .bloom import bloom_of
from .edges import edge_distance
from .illumination import Illumination
from .line import lay_ink, lit_line
from .reflection import emitted_light, light_at, reflected_light
from .resample import Band, enlarge
from .rim import rim_colour, rim_shares
from .roll_off import roll_off
from .shading import Shading
from .shadow import shade_background

BAND_PIXELS = 2_000_000
ROUNDING = 1.5 / 255

Bytes = NDArray[np.uint8]
Floats = NDArray[np.float32]


def composite_float(
    drawing: Drawing, illumination: Illumination, scene: Scene, edges: Bytes | None = None
) -> NDArray[np.uint8]:
    """The lit drawing, (H, W, 4) uint8 sRGB with straight alpha; see ``composite``.

    Args:
        edges: see ``edge_distance``; None is the silhouette only.
    """
    lit = np.zeros((*drawing.mask.shape, 4), np.uint8)
    for band, rgba in _bands(drawing, illumination, scene, edges):
        rounded = np.rint(rgba * 255).astype(np.uint8)
        # Fully transparent pixels keep the artist's colour.
        lit[band.top : band.bottom] = np.where(
            rounded[..., 3:] > 0,
            rounded,
            drawing.pixels[band.top : band.bottom] * np.array([1, 1, 1, 0], np.uint8),
        )
    return lit


def composite_unrounded(
    drawing: Drawing, illumination: Illumination, scene: Scene, edges: Bytes | None = None
) -> NDArray[np.float32]:
    """The lit drawing before it is rounded, (H, W, 4) float32 sRGB in 0..1, straight alpha."""
    lit = np.zeros((*drawing.mask.shape, 4), np.float32)
    for band, rgba in _bands(drawing, illumination, scene, edges):
        lit[band.top : band.bottom] = rgba
    return lit


def _bands(
    drawing: Drawing, illumination: Illumination, scene: Scene, edges: Bytes | None
) -> Iterator[tuple[Band, NDArray[np.float32]]]:
    """Bands of the lit drawing, (h, W, 4) in 0..1."""
    width, height = drawing.size
    rows = max(1, BAND_PIXELS // max(width, 1))
    materials = MaterialTable.of(scene, drawing.palette.colours)
    area = (0.0, 0.0, float(width), float(height))
    shading = Shading.of(illumination, scene, materials, 1.0, area)
    if shading.rim is not None and edges is None:
        edges = edge_distance(drawing.mask, drawing.ink)
    bloom = bloom_of(drawing, materials, scene, 1.0)
    for top in range(0, height, rows):
        band = Band(width, height, top, min(top + rows, height))
        rim = None if shading.rim is None or edges is None else rim_shares(shading.rim, edges, band)
        light = _composite_band(_rows(drawing, band), shading, band, rim)
        if bloom is not None:
            light = bloom.over(light, band)
        colour = light[..., :3] / np.maximum(light[..., 3:], 1e-6)
        yield band, np.clip(np.concatenate([colour, light[..., 3:]], axis=2), 0, 1)


def _rows(drawing: Drawing, band: Band) -> Drawing:
    """The rows of ``drawing`` in ``band``."""
    arrays: dict[str, Any] = {
        name: value[band.top : band.bottom]
        for name, value in vars(drawing).items()
        if isinstance(value, np.ndarray)
    }
    return replace(drawing, **arrays)


def _composite_band(
    drawing: Drawing, shading: Shading, band: Band, rim: Floats | None
) -> NDArray[np.float32]:
    """The lit rows, (h, W, 4) sRGB, premultiplied."""
    lit = _lit_colours(drawing, shading, band, rim)
    drawn = lay_ink(drawing, drawing.ink_colour, drawing.albedo)

    pixels = drawing.pixels.astype(np.float32) / 255.0
    coverage = drawing.coverage[..., None]
    kept = pixels[..., 3:]
    # Line art has no fill, but its character is solid: it is lit on white paper.
    paper = np.where(coverage - kept > ROUNDING, coverage - kept, 0)
    # The background behind the character: pixels = drawn over background, solved for background.
    behind = kept + paper - coverage
    paint = kept * pixels[..., :3] + paper - coverage * drawn
    ratio = shading.floor_ratio
    if ratio is not None:
        paint, behind = shade_background(paint, behind, coverage, enlarge(ratio, band))
    alpha = coverage + behind
    light = coverage * lit + paint
    if paper.any():
        light, alpha = _lift_off_paper(light, alpha, kept, paper > 0)
    return np.concatenate([light, alpha], axis=2)


def _lift_off_paper(
    light: NDArray[np.float32],
    alpha: NDArray[np.float32],
    kept: NDArray[np.float32],
    papered: NDArray[np.bool_],
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Remove the white paper again. The result is the least opaque picture that looks the same
    over white, so that the shading of line art works over any background.

    Args:
        light: (H, W, 3) sRGB times ``alpha``.
        alpha, kept: (H, W, 1) alpha with the paper, and as drawn.
        papered: (H, W, 1) where paper was added.
    """
    over_white = light + 1 - alpha
    least = np.maximum(kept, 1 - over_white.min(axis=2, keepdims=True))
    lifted = np.where(papered, over_white - (1 - least), light)
    return lifted.astype(np.float32), np.where(papered, least, alpha).astype(np.float32)


def _lit_colours(
    drawing: Drawing, shading: Shading, band: Band, rim: Floats | None
) -> NDArray[np.float32]:
    """Fill and line under the light, sRGB (H, W, 3)."""
    albedo, diffuse = linear(drawing.albedo), shading.materials.diffuse[drawing.labels]
    light = light_at(drawing, shading, band)
    paint, gloss, unlit = reflected_light(drawing, shading, light)
    if (emitted := emitted_light(drawing, shading.materials)) is not None:
        given, own = emitted
        paint, unlit = paint + given, unlit - own
    fill = roll_off(paint + gloss, albedo)
    if rim is not None and shading.rim is not None:
        lit = (diffuse | shading.materials.glossy[drawing.labels])[..., None]
        target = rim_colour(shading.rim, albedo)
        fill += np.where(lit, rim[..., None] * np.maximum(target - fill, 0), np.float32(0))
    fill += unlit
    line = lit_line(drawing, light.diffuse, fill, diffuse, shading.ink_light)
    return lay_ink(drawing, line, srgb(np.minimum(fill, 1)))
