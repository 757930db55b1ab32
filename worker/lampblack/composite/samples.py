"""Values of pictures and tables at one pixel, for compiled loops."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..colour import linear, srgb
from ..compiled import compiled
from .line import DARK_INK, PALE_INK
from .scan import level_of, levels_of_row, places

STEPS = 4096
LINEAR = linear(np.arange(256) / 255)
SRGB = srgb(np.arange(STEPS + 2) / STEPS)
"""Tables from sRGB bytes to scene-linear light, and back from light in 0..1."""


@compiled
def sample(picture: Any, u: float, v: float, channel: int) -> Any:
    """Bilinear at (u, v) in 0..1, continued past the edges."""
    height, width = picture.shape[0], picture.shape[1]
    x = min(max(u * width - 0.5, 0.0), width - 1.0)
    y = min(max(v * height - 0.5, 0.0), height - 1.0)
    x0, y0 = int(x), int(y)
    x1, y1 = min(x0 + 1, width - 1), min(y0 + 1, height - 1)
    s, t = np.float32(x - x0), np.float32(y - y0)
    above = picture[y0, x0, channel] + s * (picture[y0, x1, channel] - picture[y0, x0, channel])
    below = picture[y1, x0, channel] + s * (picture[y1, x1, channel] - picture[y1, x0, channel])
    return above + t * (below - above)


def resized(plane: NDArray[np.float32], size: tuple[int, ...]) -> NDArray[np.float32]:
    """(h, w) sampled at ``size`` (rows, columns) places, bilinear; the outer edges coincide."""
    if plane.shape == size:
        return plane
    found = np.empty(size, np.float32)
    _resize(np.require(plane, np.float32, ("C", "W")), found)
    return found


@compiled
def _resize(plane: Any, found: Any) -> None:
    rows, columns = found.shape
    before, shares = places(1 / columns, 0.5 / columns, columns, plane.shape[1])
    for row in range(rows):
        levels = levels_of_row(plane, (row + 0.5) / rows, 0, plane.shape[1] - 1)
        for column in range(columns):
            found[row, column] = level_of(levels, before[column], shares[column])


@compiled
def encode(table: Any, value: Any) -> Any:
    """sRGB of scene-linear ``value``, clipped to 0..1."""
    at = min(max(value, np.float32(0)), np.float32(1)) * np.float32(STEPS)
    index = int(at)
    return table[index] + (at - index) * (table[index + 1] - table[index])


@compiled
def paleness_of(colour: Any) -> Any:
    """See ``line.paleness``."""
    light = (0.299 * colour[0] + 0.587 * colour[1] + 0.114 * colour[2]) / 255
    share = min(max((light - DARK_INK) / (PALE_INK - DARK_INK), 0.0), 1.0)
    return np.float32(share * share * (3 - 2 * share))
