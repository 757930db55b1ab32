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
PALING = 3.0
"""How far above the knee a colour is half way to white."""
DARK_INK, PALE_INK = 0.15, 0.35
"""Luma up to which a line stays as drawn, and from which it takes light as the fill does."""
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
    diffuse, glossy, unlit = character_light(drawing, scene, illumination, band)
    fill = _roll_off(diffuse + glossy, linear(drawing.albedo)) + unlit
    line = _lit_line(drawing, scene, illumination, band)
    lit = _lay_ink(drawing, line, srgb(fill))
    drawn = _lay_ink(drawing, drawing.ink_colour, drawing.albedo)

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


def _lit_line(
    drawing: Drawing, scene: Scene, illumination: Illumination, band: Band
) -> NDArray[np.float32]:
    """The colour of the line, sRGB (H, W, 3). A pale line is shaded as the fill is; it would glow
    in the shade otherwise. A dark one stays as drawn."""
    pale = paleness(drawing.ink_colour) * (drawing.ink > 0)
    inked = MaterialTable.of(scene, drawing.palette.colours).diffuse[drawing.labels] & (pale > 0)
    if not inked.any():
        return drawing.ink_colour
    light = np.minimum(enlarge(illumination.diffuse, band)[inked], 1)
    line = drawing.ink_colour.copy()
    line[inked] = srgb(linear(line[inked]) * (1 + pale[inked, None] * (light - 1)))
    return line


def paleness(ink_colour: Floats) -> Floats:
    """(...) how far a line of this colour, (..., 3) sRGB, takes light as the fill does, 0 to 1."""
    light = ink_colour @ np.array([0.299, 0.587, 0.114], np.float32)
    share = np.clip((light - DARK_INK) / (PALE_INK - DARK_INK), 0, 1)
    return np.asarray(share * share * (3 - 2 * share), np.float32)


def character_light(
    drawing: Drawing, scene: Scene, illumination: Illumination, band: Band
) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.float32]]:
    """Diffuse light, glossy light, and colours that are shown as drawn, for the fill in ``band``;
    scene-linear (H, W, 3), unbounded."""
    albedo = linear(drawing.albedo)
    materials = MaterialTable.of(scene, drawing.palette.colours)
    none = np.zeros_like(albedo)
    diffuse = enlarge(illumination.diffuse, band) if materials.diffuse.any() else none
    mirrors, painted = materials.glossy & ~materials.diffuse, materials.glossy & materials.diffuse
    glossy = enlarge(illumination.glossy, band) if mirrors.any() else none
    sheen = enlarge(illumination.sheen, band) if painted.any() else none
    other, share = mixed_labels(drawing.labels, albedo, drawing.palette)
    blend = share > 0
    theirs = np.minimum(
        albedo[blend], share[blend, None] * swatch_albedos(drawing.palette)[other[blend]]
    )
    albedo[blend] -= theirs
    found = _reflected(
        materials, drawing.labels, albedo, 1 - share[..., None], diffuse, glossy, sheen
    )
    second = _reflected(
        materials, other[blend], theirs, share[blend, None],
        diffuse[blend], glossy[blend], sheen[blend],
    )  # fmt: skip
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
    sheen: Floats,
) -> tuple[Floats, Floats, Floats]:
    """Diffuse light, glossy light, and colours left as drawn, (..., 3) each, of parts of
    pixels: ``albedo`` is weighted by their ``share`` (..., 1)."""
    has_diffuse, has_glossy = (
        kind[labels][..., None] for kind in (materials.diffuse, materials.glossy)
    )
    amount = materials.gloss[labels][..., None]
    none = np.float32(0)
    return (
        np.where(has_diffuse, albedo * diffuse, none),
        np.where(
            has_glossy,
            amount * np.where(has_diffuse, share * sheen, albedo * glossy),
            none,
        ),
        np.where(has_diffuse | has_glossy, none, albedo),
    )


def _roll_off(lit: NDArray[np.float32], drawn: NDArray[np.float32]) -> NDArray[np.float32]:
    """Compress highlights brighter than white, keeping their hue, scene-linear (H, W, 3).

    The brightest channel is unchanged up to ``KNEE``, and up to that of the drawn colour, so that
    unit irradiance stays exact. Above, it approaches 1 as slowly as film does, and the colour pales
    where there is far too much light. So a bright spot keeps its shape; clipping would leave a
    flat patch with a hard edge.
    """
    peak = lit.max(axis=2, keepdims=True)
    knee = np.clip(drawn.max(axis=2, keepdims=True), KNEE, 1)
    room = np.maximum(1 - knee, 1e-4)
    over = np.maximum(peak - knee, 0)
    bent = np.minimum(peak, knee) + room * over / (room + over)
    rolled = lit * np.where(over > 0, bent / np.maximum(peak, KNEE), 1)
    pale = over * over / (over * over + PALING * PALING)
    return np.asarray(rolled + pale * (bent - rolled), np.float32)


def _lay_ink(drawing: Drawing, line: Floats, fill: Floats) -> Floats:
    """The artist's line in the colour ``line`` composited over the fill, sRGB (H, W, 3)."""
    ink = drawing.ink[..., None]
    return (fill + ink * (line - fill)).astype(np.float32)
