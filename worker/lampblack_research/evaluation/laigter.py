"""Laigter's bevel: the free tool that game artists use for normal maps of sprites.

Re-implemented from its description, not from its source: the distance transform of the
mask, clipped at the bevel's width and rounded, is a height map whose gradient gives the normals.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

DEFAULT_BEVEL = 60.0


def laigter_normals(
    mask: NDArray[np.bool_], bevel: float | None = DEFAULT_BEVEL
) -> NDArray[np.float32]:
    """(H, W, 3) float32 normals of a rounded bevel, x right, y up; 0 outside the (H, W) mask.

    Args:
        bevel: width in pixels; None for the largest inscribed radius (the tuned setting).
    """
    distance = ndimage.distance_transform_edt(np.pad(mask, 1))[1:-1, 1:-1]
    radius = max(1.0, float(distance.max()) if bevel is None else bevel)
    inwards = np.clip(distance / radius, 0, 1)
    height = radius * np.sqrt(np.maximum(1 - (1 - inwards) ** 2, 0))
    height = ndimage.gaussian_filter(height, 1 + radius / 20)
    down, right = np.gradient(height)
    normals = np.stack([-right, down, np.ones_like(height)], axis=2)
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    result: NDArray[np.float32] = (normals * mask[..., None]).astype(np.float32)
    return result
