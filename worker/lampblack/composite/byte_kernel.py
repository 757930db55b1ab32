"""The composite of byte layers, for previews: the same computation in one compiled loop."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..colour import linear, srgb
from ..compiled import compiled
from ..drawing.palette import Palette
from ..materials import MaterialTable
from ..scene import Scene, default_scene
from .borders import swatch_albedos
from .byte_layers import ByteLayers
from .float_kernel import DARK_INK, KNEE, PALE_INK, PALING, ROUNDING
from .illumination import Illumination
from .resample import Box

Floats = NDArray[np.float32]

STEPS = 4096
_LINEAR = linear(np.arange(256) / 255)
_SRGB = srgb(np.arange(STEPS + 2) / STEPS)
_UNIT = np.ones((1, 1, 3), np.float32)
_UNSHADED = np.ones((1, 1), np.bool_)


def composite_bytes(
    layers: ByteLayers, illumination: Illumination, scene: Scene, crop: Box
) -> NDArray[np.uint8]:
    """The layers, lit: (H, W, 4) uint8 sRGB, premultiplied; see ``composite``.

    Args:
        layers: cut from a drawing.
        crop: the part of the drawing that they show, in its pixels.
    """
    materials = MaterialTable.of(scene, layers.palette.colours)
    kinds = materials.diffuse.astype(np.uint8) + 2 * materials.glossy.astype(np.uint8)
    height, width = layers.ink.shape
    lit = np.empty((height, width, 4), np.uint8)
    ratio = illumination.floor_ratio
    _light(
        layers.pixels, layers.albedo, layers.ink, layers.ink_colour, layers.coverage,
        layers.labels, layers.others, layers.shares,
        swatch_albedos(layers.palette), kinds, materials.gloss,
        illumination.diffuse, illumination.glossy if (kinds == 2).any() else _UNIT,
        illumination.sheen if (kinds == 3).any() else _UNIT,
        _steps(crop, layers.size, illumination.character_area or crop),
        _UNIT if ratio is None else ratio,
        _UNSHADED if ratio is None else _unshaded(ratio), ratio is not None,
        _steps(crop, layers.size, illumination.floor_area or crop),
        _LINEAR, _SRGB, lit,
    )  # fmt: skip
    return lit


def _unshaded(floor: Floats) -> NDArray[np.bool_]:
    """(h, w) bool: no pixel of the drawing in this element is in shadow."""
    clear = (np.abs(floor - 1) < 1e-3).all(axis=2)
    return np.asarray(ndimage.minimum_filter(clear, 3, mode="nearest"))


def warm_up() -> None:
    """Load the compiled loop, or compile it."""
    grey, bytes_ = np.zeros((1, 1, 3), np.uint8), np.zeros((1, 1), np.uint8)
    label = np.full((1, 1), -1, np.int16)
    pixels, palette = np.zeros((1, 1, 4), np.uint8), Palette(())
    layers = ByteLayers(pixels, grey, bytes_, grey, bytes_, label, label, bytes_, palette)
    white = np.ones(3, np.float32), _UNIT, _UNIT
    composite_bytes(layers, Illumination([white], floor=[white]), default_scene(1, 1), (0, 0, 1, 1))


def _steps(crop: Box, size: tuple[int, int], area: Box) -> tuple[float, float, float, float]:
    """(step, start) along x, then along y: pixel ``i`` of the layers is at ``start + i * step`` of
    ``area``, which extends from 0 to 1."""
    found = []
    for axis in (0, 1):
        step = crop[axis + 2] / size[axis] / area[axis + 2]
        found += [step, (crop[axis] - area[axis]) / area[axis + 2] + step / 2]
    return found[0], found[1], found[2], found[3]


@compiled
def _sample(picture: Any, u: float, v: float, channel: int) -> Any:
    """Bilinear at (u, v) in 0..1, continued past the edges."""
    height, width = picture.shape[0], picture.shape[1]
    x = min(max(u * width - 0.5, 0.0), width - 1.0)
    y = min(max(v * height - 0.5, 0.0), height - 1.0)
    x0, y0 = int(x), int(y)
    x1, y1 = min(x0 + 1, width - 1), min(y0 + 1, height - 1)
    s, t = np.float32(x - x0), np.float32(y - y0)
    above = picture[y0, x0, channel] + s * (picture[y0, x1, channel] - picture[y0, x0, channel])
    below = picture[y1, x0, channel] + s * (picture[y1, x1, channel] - picture[y1, x0, channel])
    return above + t * (below - above)


@compiled
def _encode(table: Any, value: Any) -> Any:
    """sRGB of scene-linear ``value``, clipped to 0..1."""
    at = min(max(value, np.float32(0)), np.float32(1)) * np.float32(STEPS)
    index = int(at)
    return table[index] + (at - index) * (table[index + 1] - table[index])


@compiled
def _paleness(colour: Any) -> Any:
    """See ``float_kernel.paleness``."""
    light = (0.299 * colour[0] + 0.587 * colour[1] + 0.114 * colour[2]) / 255
    share = min(max((light - DARK_INK) / (PALE_INK - DARK_INK), 0.0), 1.0)
    return np.float32(share * share * (3 - 2 * share))


@compiled
def _light(
    pixels: Any, albedo: Any, ink: Any, ink_colour: Any, coverage: Any,
    labels: Any, others: Any, shares: Any,
    swatches: Any, kinds: Any, gloss: Any,
    diffuse: Any, glossy: Any, sheen: Any, on_figure: Any,
    floor: Any, unshaded: Any, has_floor: bool, on_ground: Any,
    to_linear: Any, to_srgb: Any, lit: Any,
) -> None:  # fmt: skip
    byte, one, zero = np.float32(1 / 255), np.float32(1), np.float32(0)
    fill, shown = np.zeros(3, np.float32), np.zeros(3, np.float32)
    unlit = np.zeros(3, np.float32)
    for row in range(ink.shape[0]):
        for column in range(ink.shape[1]):
            alpha = pixels[row, column, 3] * byte
            cover = coverage[row, column] * byte
            # Line art without fill is lit on white paper, which is removed again below.
            paper = cover - alpha if cover - alpha > np.float32(ROUNDING) else zero
            behind = alpha + paper - cover
            across, down = on_ground[1] + column * on_ground[0], on_ground[3] + row * on_ground[2]
            shaded = (
                has_floor
                and not unshaded[
                    min(max(int(down * unshaded.shape[0]), 0), unshaded.shape[0] - 1),
                    min(max(int(across * unshaded.shape[1]), 0), unshaded.shape[1] - 1),
                ]
            )
            if cover == 0 and not shaded:
                for c in range(4):
                    lit[row, column, c] = pixels[row, column, c]
                continue
            label, other = labels[row, column], others[row, column]
            share = shares[row, column] * byte
            peak, drawn_peak = zero, zero
            u, v = on_figure[1] + column * on_figure[0], on_figure[3] + row * on_figure[2]
            for c in range(3):
                base = to_linear[albedo[row, column, c]]
                drawn_peak = max(drawn_peak, base)
                fill[c], unlit[c] = zero, base
                if cover == 0 or (kinds[label] == 0 and kinds[other] == 0):
                    continue
                unlit[c] = zero
                theirs = min(base, share * swatches[other, c])
                for second in range(2 if share > 0 else 1):
                    worn = other if second else label
                    paint = theirs if second else base - theirs
                    if kinds[worn] == 0:
                        unlit[c] += paint
                    if kinds[worn] & 1:
                        fill[c] += paint * _sample(diffuse, u, v, c)
                    if kinds[worn] & 2:
                        if kinds[worn] & 1:
                            part = share if second else one - share
                            fill[c] += part * gloss[worn] * _sample(sheen, u, v, c)
                        else:
                            fill[c] += paint * gloss[worn] * _sample(glossy, u, v, c)
                peak = max(peak, fill[c])
            knee = min(max(drawn_peak, np.float32(KNEE)), one)
            if peak > knee:
                room, over = max(one - knee, np.float32(1e-4)), peak - knee
                bent = knee + room * over / (room + over)
                scale = bent / max(peak, np.float32(KNEE))
                pale = over * over / (over * over + np.float32(PALING * PALING))
                for c in range(3):
                    fill[c] = fill[c] * scale + pale * (bent - fill[c] * scale)
            line = ink[row, column] * byte
            pale = zero
            if line > 0 and cover > 0 and kinds[label] & 1:
                pale = _paleness(ink_colour[row, column])
            ground_alpha = behind
            darkest = one
            for c in range(3):
                tone = ink_colour[row, column, c] * byte
                drawn = albedo[row, column, c] * byte
                drawn += line * (tone - drawn)
                colour = _encode(to_srgb, fill[c] + unlit[c])
                if pale > 0:
                    light = min(_sample(diffuse, u, v, c), one)
                    tone = to_linear[ink_colour[row, column, c]] * (one + pale * (light - one))
                    tone = _encode(to_srgb, tone)
                colour += line * (tone - colour)
                paint = pixels[row, column, c] * byte + paper - cover * drawn
                if shaded:
                    ratio = _sample(floor, across, down, c)
                    plain = min(max(paint / max(behind, np.float32(1e-3)), zero), one)
                    paint = behind * _encode(to_srgb, to_linear[int(plain * 255)] * ratio)
                    shown[c] = _encode(to_srgb, ratio)
                    darkest = min(darkest, shown[c])
                fill[c] = cover * colour + paint
            if shaded:
                bare = min(max(one - cover - behind, zero), one)
                for c in range(3):
                    fill[c] += bare * (shown[c] - darkest)
                ground_alpha += bare * (one - darkest)
            total = min(max(cover + ground_alpha, zero), one)
            if paper > 0:
                least = alpha
                for c in range(3):
                    least = max(least, total - fill[c])
                for c in range(3):
                    fill[c] += least - total
                total = min(least, one)
            for c in range(3):
                lit[row, column, c] = np.uint8(min(max(fill[c], zero), total) * 255 + 0.5)
            lit[row, column, 3] = np.uint8(total * 255 + 0.5)
