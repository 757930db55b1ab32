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
from .borders import mixed_labels, swatch_albedos
from .illumination import Illumination
from .resample import Band, enlarge
from .shadow import shade_background

KNEE = 0.8
BAND_PIXELS = 2_000_000
ROUNDING = 1.5 / 255

Floats = NDArray[np.float32]


def composite_float(
    drawing: Drawing, illumination: Illumination, scene: Scene
) -> NDArray[np.uint8]:
    """The lit drawing, (H, W, 4) uint8 sRGB with straight alpha; see ``composite``."""
    lit = np.zeros((*drawing.mask.shape, 4), np.uint8)
    for band, rgba in _bands(drawing, illumination, scene):
        rounded = np.rint(rgba * 255).astype(np.uint8)
        # Fully transparent pixels keep the artist's colour.
        lit[band.top : band.bottom] = np.where(
            rounded[..., 3:] > 0,
            rounded,
            drawing.pixels[band.top : band.bottom] * np.array([1, 1, 1, 0], np.uint8),
        )
    return lit


def composite_unrounded(
    drawing: Drawing, illumination: Illumination, scene: Scene
) -> NDArray[np.float32]:
    """The lit drawing before it is rounded, (H, W, 4) float32 sRGB in 0..1, straight alpha."""
    lit = np.zeros((*drawing.mask.shape, 4), np.float32)
    for band, rgba in _bands(drawing, illumination, scene):
        lit[band.top : band.bottom] = rgba
    return lit


def _bands(
    drawing: Drawing, illumination: Illumination, scene: Scene
) -> Iterator[tuple[Band, NDArray[np.float32]]]:
    """Bands of the lit drawing, (h, W, 4) in 0..1."""
    width, height = drawing.size
    rows = max(1, BAND_PIXELS // max(width, 1))
    for top in range(0, height, rows):
        band = Band(width, height, top, min(top + rows, height))
        yield band, _composite_band(_rows(drawing, band), scene, illumination, band)


def _rows(drawing: Drawing, band: Band) -> Drawing:
    """The rows of ``drawing`` in ``band``."""
    arrays: dict[str, Any] = {
        name: value[band.top : band.bottom]
        for name, value in vars(drawing).items()
        if isinstance(value, np.ndarray)
    }
    return replace(drawing, **arrays)


def _composite_band(
    drawing: Drawing, scene: Scene, illumination: Illumination, band: Band
) -> NDArray[np.float32]:
    lit = _lay_ink(drawing, srgb(_lit_fill(drawing, scene, illumination, band)))
    drawn = _lay_ink(drawing, drawing.albedo)

    pixels = drawing.pixels.astype(np.float32) / 255
    coverage = drawing.coverage[..., None]
    kept = pixels[..., 3:]
    # Line art has no fill, but its character is solid: it is lit on white paper.
    paper = np.where(coverage - kept > ROUNDING, coverage - kept, 0)
    # The background behind the character: pixels = drawn over background, solved for background.
    behind = kept + paper - coverage
    paint = kept * pixels[..., :3] + paper - coverage * drawn
    ratio = illumination.floor_ratio
    if scene.floor is not None and ratio is not None:
        paint, behind = shade_background(paint, behind, coverage, enlarge(ratio, band))
    alpha = coverage + behind
    light = coverage * lit + paint
    if paper.any():
        light, alpha = _lift_off_paper(light, alpha, kept, paper > 0)
    colour = light / np.maximum(alpha, 1e-6)
    rgba: NDArray[np.float32] = np.clip(np.concatenate([colour, alpha], axis=2), 0, 1)
    return rgba


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


def _lit_fill(
    drawing: Drawing, scene: Scene, illumination: Illumination, band: Band
) -> NDArray[np.float32]:
    """The fill under the lights, scene-linear (H, W, 3), at most 1."""
    diffuse, glossy, unlit = character_light(drawing, scene, illumination, band)
    return _roll_off(diffuse + glossy, linear(drawing.albedo)) + unlit


def character_light(
    drawing: Drawing, scene: Scene, illumination: Illumination, band: Band
) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.float32]]:
    """Diffuse light, glossy light, and colours that are shown as drawn, for the fill in ``band``;
    scene-linear (H, W, 3), unbounded."""
    albedo = linear(drawing.albedo)
    materials = MaterialTable.of(scene, drawing.palette.colours)
    none = np.zeros_like(albedo)
    diffuse = enlarge(illumination.diffuse, band) if materials.diffuse.any() else none
    glossy = enlarge(illumination.glossy, band) if materials.glossy.any() else none
    other, share = mixed_labels(drawing.labels, albedo, drawing.palette)
    blend = share > 0
    theirs = np.minimum(
        albedo[blend], share[blend, None] * swatch_albedos(drawing.palette)[other[blend]]
    )
    albedo[blend] -= theirs
    found = _reflected(materials, drawing.labels, albedo, 1 - share[..., None], diffuse, glossy)
    second = _reflected(
        materials, other[blend], theirs, share[blend, None], diffuse[blend], glossy[blend]
    )
    for whole, part in zip(found, second, strict=True):
        whole[blend] += part
    return found


def _reflected(
    materials: MaterialTable,
    labels: NDArray[np.int16],
    albedo: Floats,
    share: Floats,
    diffuse: Floats,
    glossy: Floats,
) -> tuple[Floats, Floats, Floats]:
    """Diffuse light, glossy light, and colours left as drawn, (..., 3) each, of parts of
    pixels: ``albedo`` is weighted by their ``share`` (..., 1)."""
    has_diffuse, has_glossy = (
        kind[labels][..., None] for kind in (materials.diffuse, materials.glossy)
    )
    shine = materials.gloss[labels][..., None] * glossy
    none = np.float32(0)
    return (
        np.where(has_diffuse, albedo * diffuse, none),
        np.where(has_glossy, np.where(has_diffuse, share * shine, albedo * shine), none),
        np.where(has_diffuse | has_glossy, none, albedo),
    )


def _roll_off(lit: NDArray[np.float32], drawn: NDArray[np.float32]) -> NDArray[np.float32]:
    """Compress highlights brighter than white, keeping their hue, scene-linear (H, W, 3).

    The brightest channel is unchanged up to ``KNEE``, and up to that of the drawn colour, so that
    unit irradiance stays exact. Above, it approaches 1 smoothly; clipping would leave a flat patch
    with a hard edge.
    """
    peak = lit.max(axis=2, keepdims=True)
    knee = np.clip(drawn.max(axis=2, keepdims=True), KNEE, 1)
    room = np.maximum(1 - knee, 1e-4)
    over = np.maximum(peak - knee, 0)
    bent = np.minimum(peak, knee) + room * -np.expm1(-over / room)
    return np.asarray(lit * np.where(over > 0, bent / np.maximum(peak, KNEE), 1), np.float32)


def _lay_ink(drawing: Drawing, fill: NDArray[np.float32]) -> NDArray[np.float32]:
    """The artist's line composited over the fill, sRGB (H, W, 3)."""
    ink = drawing.ink[..., None]
    return (fill + ink * (drawing.ink_colour - fill)).astype(np.float32)
