"""The character's shadow on the floor, composited over the background."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..colour import linear, srgb


def shade_background(
    paint: NDArray[np.float32],
    behind: NDArray[np.float32],
    coverage: NDArray[np.float32],
    ratio: NDArray[np.float32],
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Shade the background behind the character.

    Paint is multiplied by the floor's light. Where there is no paint, the shadow becomes a
    translucent layer that looks the same over white.

    Args:
        paint: (H, W, 3) sRGB of the background times ``behind``.
        behind: (H, W, 1) share of the pixel that is background paint.
        coverage: (H, W, 1) share of the pixel that is character.
        ratio: (H, W, 3) the floor's light with the character over that without it.

    Returns:
        ``paint`` and ``behind`` with the shadow.
    """
    colour = np.clip(paint / np.maximum(behind, 1e-3), 0, 1)
    shaded = behind * srgb(np.minimum(linear(colour) * ratio, 1))
    over_white = srgb(np.minimum(ratio, 1))
    shadow = 1 - over_white.min(axis=2, keepdims=True)
    bare = np.clip(1 - coverage - behind, 0, 1)
    # Over white, (1 - shadow) + tint = over_white.
    tint = over_white - (1 - shadow)
    return shaded + bare * tint, behind + bare * shadow
