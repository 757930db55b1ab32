"""sRGB and scene-linear light (IEC 61966-2-1)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


def linear(srgb: ArrayLike) -> NDArray[np.float32]:
    """sRGB in 0..1, any shape, to scene-linear float32."""
    s = np.asarray(srgb, np.float32)
    return np.where(s <= 0.04045, s / 12.92, ((np.maximum(s, 0) + 0.055) / 1.055) ** 2.4).astype(
        np.float32
    )


def srgb(light: ArrayLike) -> NDArray[np.float32]:
    """Scene-linear light, any shape, to sRGB float32; 0..1 maps onto 0..1."""
    v = np.asarray(light, np.float32)
    return np.where(
        v <= 0.0031308, v * 12.92, 1.055 * np.maximum(v, 0.0031308) ** (1 / 2.4) - 0.055
    ).astype(np.float32)


def hex_linear(colour: str) -> NDArray[np.float32]:
    """``#rrggbb`` to (3,) scene-linear."""
    return linear(np.frombuffer(bytes.fromhex(colour[1:]), np.uint8) / 255)
