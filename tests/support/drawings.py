"""Drawings made for tests."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from lampblack.shot import Cel, cropped_layer


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


def draw_capsule(
    size: tuple[int, int],
    start: tuple[float, float],
    end: tuple[float, float],
    radius: float,
    fill: tuple[int, int, int] = (225, 170, 120),
    *,
    line: float = 3.0,
    paint: bool = True,
    open_before: float = -np.inf,
) -> NDArray[np.uint8]:
    """(H, W, 4) uint8, ``size`` is (width, height): an inked, anti-aliased capsule from ``start``
    to ``end``, both (x, y); a disk if they are the same.

    Args:
        line: width of the line; 0 for none.
        paint: False leaves only the line.
        open_before: there is no line left of this column.
    """
    rows, columns = np.mgrid[0 : size[1], 0 : size[0]] + 0.5
    way = np.subtract(end, start)
    along = (columns - start[0]) * way[0] + (rows - start[1]) * way[1]
    share = np.clip(along / max(1e-9, way @ way), 0, 1)
    distance = np.hypot(columns - start[0] - share * way[0], rows - start[1] - share * way[1])
    cover = np.clip(radius - distance + 0.5, 0, 1)
    width = np.where(columns < open_before, 0, line)
    inside = np.where(width > 0, np.clip(radius - width - distance + 0.5, 0, 1), 1)
    colour = np.array(fill) * inside[..., None] + np.array([20, 16, 24]) * (1 - inside[..., None])
    alpha = cover if paint else np.minimum(cover, 1 - inside)
    return np.dstack([np.round(colour), np.round(255 * alpha)]).astype(np.uint8)


def layered_cel(**layers: NDArray[np.uint8]) -> Cel:
    """A cel of layers by name, bottom first, each (H, W, 4) uint8."""
    whole = Image.new("RGBA", next(iter(layers.values())).shape[1::-1])
    for picture in layers.values():
        whole.alpha_composite(Image.fromarray(picture))
    cropped = (cropped_layer(name, picture) for name, picture in layers.items())
    return Cel(np.array(whole), layers=tuple(layer for layer in cropped if layer is not None))
