"""Drawings with layers, painted for tests."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Picture = NDArray[np.uint8]
Floats = NDArray[np.float64]


def blob(
    colour: tuple[int, int, int], size: tuple[int, int] = (40, 30), soft: float = 4
) -> Picture:
    """An ellipse of (width, height) whose colour changes from left to right. Its edge is
    steeper with more of ``soft``; 0 has no pixels that are covered in part."""
    width, height = size
    y, x = np.mgrid[:height, :width]
    picture = np.zeros((height, width, 4), np.uint8)
    picture[..., :3] = np.clip(np.array(colour) + (x[..., None] * 60 / width - 30), 0, 255)
    far = np.hypot((y + 0.5) / height * 2 - 1, (x + 0.5) / width * 2 - 1)
    picture[..., 3] = np.clip((1 - far) * soft * 255, 0, 255) if soft else 255 * (far < 1)
    return picture


def apart(one: Picture, other: Picture) -> Floats:
    """(H, W) how far two pictures are from one another, in levels, where they are seen."""
    layered = [
        np.dstack([p[..., :3] * (p[..., 3:] / 255.0), p[..., 3:].astype(float)])
        for p in (one, other)
    ]
    return np.abs(layered[0] - layered[1]).max(axis=2)
