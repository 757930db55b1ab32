"""Roll-off: highlights brighter than white, compressed below it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

KNEE = 0.8
PALING = 3.0
"""How far above the knee a colour is half way to white."""


def roll_off(lit: NDArray[np.float32], drawn: NDArray[np.float32]) -> NDArray[np.float32]:
    """Compress highlights brighter than white, keeping their hue, scene-linear (H, W, 3).

    The brightest channel is unchanged up to ``KNEE``, and up to that of the drawn colour, so that
    unit irradiance stays exact. Above, it approaches 1 as slowly as film does, and the colour pales
    where there is far too much light. So a bright spot keeps its shape; clipping would leave a
    flat patch with a hard edge.
    """
    peak = lit.max(axis=2, keepdims=True)
    knee = np.clip(drawn.max(axis=2, keepdims=True), KNEE, 1)
    room = np.maximum(1 - knee, 1e-4)
    over = np.maximum(peak - knee, 0)
    bent = np.minimum(peak, knee) + room * over / (room + over)
    rolled = lit * np.where(over > 0, bent / np.maximum(peak, KNEE), 1)
    pale = over * over / (over * over + PALING * PALING)
    return np.asarray(rolled + pale * (bent - rolled), np.float32)
