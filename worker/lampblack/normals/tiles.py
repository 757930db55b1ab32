"""Tiles of 256 x 256 x 4: a local area at three scales, and its mask (paper, figure 3)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

TILE = 256
SCALES = (1, 2, 4)
OUTSIDE = -1.0
"""Value of the drawing channels outside the character: the wide ones show its silhouette."""
ALIGNMENT = max(SCALES)


class TileSource:
    """Cuts tiles from one character.

    Args:
        lines: (H, W) float32 ink in 0..1. mask: (H, W) bool.
    """

    def __init__(self, lines: NDArray[np.float32], mask: NDArray[np.bool_]) -> None:
        extend = [(0, -size % ALIGNMENT) for size in mask.shape]
        drawing = np.where(mask, lines, np.float32(OUTSIDE)).astype(np.float32)
        drawing = np.pad(drawing, extend, constant_values=OUTSIDE)
        self._pyramid = [_shrink(drawing, scale) for scale in SCALES]
        self._mask = mask.astype(np.float32)

    def cut(self, row: int, column: int) -> NDArray[np.float32]:
        """The (4, 256, 256) tile whose top left pixel is (``row``, ``column``).

        Both are multiples of ``ALIGNMENT`` and may lie outside the character.
        """
        channels = []
        for scale, level in zip(SCALES, self._pyramid, strict=True):
            inset = TILE * (scale - 1) // 2  # wider views share the tile's centre
            channels.append(
                _window(level, (row - inset) // scale, (column - inset) // scale, OUTSIDE)
            )
        channels.append(_window(self._mask, row, column, 0.0))
        return np.stack(channels)


def _window(image: NDArray[np.float32], row: int, column: int, fill: float) -> NDArray[np.float32]:
    """A tile of ``image``, filled with ``fill`` past its border."""
    piece = np.full((TILE, TILE), fill, np.float32)
    top, left = max(row, 0), max(column, 0)
    bottom, right = min(row + TILE, image.shape[0]), min(column + TILE, image.shape[1])
    if bottom > top and right > left:
        piece[top - row : bottom - row, left - column : right - column] = image[
            top:bottom, left:right
        ]
    return piece


def _shrink(image: NDArray[np.float32], scale: int) -> NDArray[np.float32]:
    rows, columns = (size // scale for size in image.shape)
    result: NDArray[np.float32] = image.reshape(rows, scale, columns, scale).mean(axis=(1, 3))
    return result


def diagonal_grids(height: int, width: int, grids: int) -> list[list[tuple[int, int]]]:
    """Top left corners of the tiles of each grid that covers a ``height`` x ``width`` character.

    Each grid is the first one, shifted diagonally by another offset (paper, figure 5e), so that
    the seams of one grid lie inside the tiles of the others. Offsets count from the character's
    corner, so the grids move with it across the canvas.
    """
    corners = []
    for index in range(grids):
        shift = round(index * TILE / grids / ALIGNMENT) * ALIGNMENT
        corners.append(
            [
                (row, column)
                for row in range(-shift, height, TILE)
                for column in range(-shift, width, TILE)
            ]
        )
    return corners
