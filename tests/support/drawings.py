"""Drawings made for tests."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def draw_ball(
    size: int = 160, fill: tuple[int, int, int] = (220, 120, 60), canvas: int | None = None
) -> NDArray[np.uint8]:
    """(canvas, canvas, 4) uint8: an inked, anti-aliased ball on a transparent canvas."""
    canvas = canvas or size
    rows, columns = np.mgrid[0:canvas, 0:canvas] + 0.5 - canvas / 2
    distance = np.hypot(rows, columns)
    radius, line = size * 0.4, max(2.0, size / 60)
    cover = np.clip(radius - distance + 0.5, 0, 1)
    inside = np.clip(radius - line - distance + 0.5, 0, 1)[..., None]
    colour = np.array(fill) * inside + np.array([20, 16, 24]) * (1 - inside)
    return np.dstack([np.round(colour), np.round(255 * cover)]).astype(np.uint8)
