"""Resizing of planes of floats."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image

Planes = NDArray[np.float32]


def resize(image: Planes, size: tuple[int, ...]) -> Planes:
    """(H, W, C) -> (*size, C), bilinear, averaged where it shrinks; pixel borders stay aligned."""
    if image.shape[:2] == size:
        return image.copy()
    rows, columns = size
    planes = [
        Image.fromarray(np.ascontiguousarray(image[..., channel], np.float32)).resize(
            (columns, rows), Image.Resampling.BILINEAR
        )
        for channel in range(image.shape[2])
    ]
    return np.stack([np.asarray(plane) for plane in planes], axis=2)
