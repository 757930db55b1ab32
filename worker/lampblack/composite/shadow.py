"""The character's shadow on the floor, composited over the background."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..colour import linear, srgb
from ..render.passes import LightPasses
from .resample import Band, enlarge

FAINT = np.float32(1e-3)  # avoids 0 / 0: without light there is no shadow


def shade_background(
    paint: NDArray[np.float32],
    behind: NDArray[np.float32],
    coverage: NDArray[np.float32],
    sources: Sequence[tuple[NDArray[np.float32], LightPasses]],
    band: Band,
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Shade the background behind the character.

    Paint is multiplied by the floor's light. Where there is no paint, the shadow becomes a
    translucent layer that looks the same over white.

    Args:
        paint: (H, W, 3) sRGB of the background times ``behind``.
        behind: (H, W, 1) share of the pixel that is background paint.
        coverage: (H, W, 1) share of the pixel that is character.
        sources: (3,) weight and passes of each light.

    Returns:
        ``paint`` and ``behind`` with the shadow.
    """
    ratio = floor_ratio(sources, band)
    colour = np.clip(paint / np.maximum(behind, 1e-3), 0, 1)
    shaded = behind * srgb(np.minimum(linear(colour) * ratio, 1))
    over_white = srgb(np.minimum(ratio, 1))
    shadow = 1 - over_white.min(axis=2, keepdims=True)
    bare = np.clip(1 - coverage - behind, 0, 1)
    # Over white, (1 - shadow) + tint = over_white.
    tint = over_white - (1 - shadow)
    return shaded + bare * tint, behind + bare * shadow


def floor_ratio(
    sources: Sequence[tuple[NDArray[np.float32], LightPasses]], band: Band
) -> NDArray[np.float32]:
    """The floor's light with the character divided by that without it, over all sources, for
    the pixels of ``band``; 1 where no light falls."""
    floors = [
        (weight * source.floor, weight * source.open_floor)
        for weight, source in sources
        if source.floor is not None and source.open_floor is not None
    ]
    if not floors:
        return np.ones((band.bottom - band.top, band.width, 3), np.float32)
    cast = sum((floor for floor, _ in floors), FAINT)
    free = sum((open_floor for _, open_floor in floors), FAINT)
    return enlarge(np.asarray(cast / free, np.float32), band)
