"""A row of the character on its background, for the compiled loop over byte layers."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..compiled import compiled
from .byte_arguments import Ground, Planes
from .float_kernel import ROUNDING
from .samples import encode, sample


@compiled
def put_on_ground(
    row: int, fill: Any, planes: Planes, ground: Ground, tables: Any, lit: Any
) -> None:
    """Write a row of the character over its background to ``lit``; see ``shade_background``.

    Args:
        fill: (W, 3) sRGB, the colour of the character; overwritten.
    """
    pixels, coverage, albedo = planes.pixels, planes.coverage, planes.albedo
    ink, ink_colour = planes.ink, planes.ink_colour
    ratio, unshaded, has_floor = ground.ratio, ground.unshaded, ground.shown
    across_step, left, down_step, top = ground.place
    rows, columns = unshaded.shape
    to_linear, to_srgb = tables
    byte, one, zero = np.float32(1 / 255), np.float32(1), np.float32(0)
    down = top + row * down_step
    under = min(max(int(down * rows), 0), rows - 1)
    for column in range(len(fill)):
        across, shaded = left + column * across_step, False
        if has_floor:
            shaded = not unshaded[under, min(max(int(across * columns), 0), columns - 1)]
        if coverage[row, column] == 0 and not shaded:
            for c in range(4):
                lit[row, column, c] = pixels[row, column, c]
            continue
        alpha, cover = pixels[row, column, 3] * byte, coverage[row, column] * byte
        # Line art without fill is lit on white paper, which is removed again below.
        paper = cover - alpha if cover - alpha > np.float32(ROUNDING) else zero
        behind = alpha + paper - cover
        ground_alpha, darkest = behind, one
        line = ink[row, column] * byte
        for c in range(3):
            drawn = albedo[row, column, c] * byte
            drawn += line * (ink_colour[row, column, c] * byte - drawn)
            paint = pixels[row, column, c] * byte + paper - cover * drawn
            if shaded:
                dark = sample(ratio, across, down, c)
                plain = min(max(paint / max(behind, np.float32(1e-3)), zero), one)
                paint = behind * encode(to_srgb, to_linear[int(plain * 255)] * dark)
                darkest = min(darkest, encode(to_srgb, dark))
            fill[column, c] = (cover * fill[column, c] if cover > 0 else zero) + paint
        if shaded:
            bare = min(max(one - cover - behind, zero), one)
            if bare > 0:
                for c in range(3):
                    shown = encode(to_srgb, sample(ratio, across, down, c))
                    fill[column, c] += bare * (shown - darkest)
            ground_alpha += bare * (one - darkest)
        total = min(max(cover + ground_alpha, zero), one)
        if paper > 0:
            least = alpha
            for c in range(3):
                least = max(least, total - fill[column, c])
            for c in range(3):
                fill[column, c] += least - total
            total = min(least, one)
        for c in range(3):
            lit[row, column, c] = np.uint8(min(max(fill[column, c], zero), total) * 255 + 0.5)
        lit[row, column, 3] = np.uint8(total * 255 + 0.5)
