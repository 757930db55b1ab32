"""Bilinear sampling of planes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...compiled import compiled

Planes = NDArray[np.float32]


@compiled
def sampled(planes: Planes, points: Planes) -> Planes:
    """Bilinear values of (C, H, W) ``planes`` at (2, h, w) ``points``, rows and columns. Points
    beyond the border take its value. Returns (C, h, w). All float32, H and W at least 2."""
    channels, rows, columns = planes.shape
    out = np.empty((channels, points.shape[1], points.shape[2]), np.float32)
    for r in range(points.shape[1]):
        for c in range(points.shape[2]):
            y = min(max(points[0, r, c], np.float32(0)), np.float32(rows - 1))
            x = min(max(points[1, r, c], np.float32(0)), np.float32(columns - 1))
            i = min(int(y), rows - 2)
            j = min(int(x), columns - 2)
            v = y - np.float32(i)
            u = x - np.float32(j)
            for k in range(channels):
                above = planes[k, i, j] * (1 - u) + planes[k, i, j + 1] * u
                below = planes[k, i + 1, j] * (1 - u) + planes[k, i + 1, j + 1] * u
                out[k, r, c] = above * (1 - v) + below * v
    return out
