"""Painted light: what a layer of light gives, at low resolution."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..colour import linear

MOST_PX = 128
"""Longest side: the plane that shines is a mesh with a vertex for each pixel."""
_LEAST = 0.004


def painted_light(picture: NDArray[np.uint8] | None) -> NDArray[np.float32] | None:
    """(h, w, 3) float32 scene-linear colour times alpha, over the whole of ``picture``, (H, W, 4)
    uint8 sRGB with straight alpha; None where nothing is painted."""
    if picture is None or not picture[..., 3].any():
        return None
    height, width = picture.shape[:2]
    scale = min(1.0, MOST_PX / max(height, width))
    size = max(1, round(width * scale)), max(1, round(height * scale))
    light = linear(picture[..., :3] / np.float32(255)) * (picture[..., 3:] / np.float32(255))
    small = [
        np.asarray(Image.fromarray(light[..., c]).resize(size, Image.Resampling.BOX))
        for c in range(3)
    ]
    found = np.stack(small, axis=2).astype(np.float32)
    found[found.max(axis=2) < _LEAST] = 0
    return found if found.any() else None
