"""Smaller copies of pictures."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image


def shrunk(pixels: NDArray[np.uint8], step: int) -> NDArray[np.uint8]:
    """``pixels``, (H, W, 4) uint8 with straight alpha, with blocks of ``step`` x ``step`` pixels
    averaged, colours by their alpha."""
    if step == 1:
        return pixels
    small = Image.fromarray(pixels).convert("RGBa").reduce(step).convert("RGBA")
    return np.asarray(small)
