"""A normal map from overlapping tiles: multi-grid diagonal sampling (paper, 3.1.4)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from .network import Network
from .tiles import TILE, TileSource, diagonal_grids

PAPER_GRIDS = 20
MAX_GRIDS = 64
_BATCH = 8


def tile_vectors(
    network: Network,
    lines: NDArray[np.float32],
    mask: NDArray[np.bool_],
    grids: int,
    progress: Callable[[float], None] = lambda share: None,
) -> NDArray[np.float32]:
    """The mean prediction over ``grids`` diagonally shifted grids of tiles.

    Args:
        network: a network of tiles. lines: (H, W) float32 ink. mask: (H, W)
            bool.
        grids: 1 to 64. progress: called with the share done, 0 to 1.

    Returns:
        (H, W, 3) float32, not yet unit.
    """
    height, width = mask.shape
    source = TileSource(lines, mask)
    corners = [
        (row, column)
        for grid in diagonal_grids(height, width, grids)
        for row, column in grid
        if mask[max(row, 0) : row + TILE, max(column, 0) : column + TILE].any()
    ]
    # A prediction is best in the middle of its tile, so its weight falls towards the border.
    ramp = np.minimum(np.arange(TILE) + 0.5, TILE - np.arange(TILE) - 0.5) / (TILE / 2)
    window = (np.outer(ramp, ramp) + 1e-3).astype(np.float32)[..., None]
    summed = np.zeros((height + 2 * TILE, width + 2 * TILE, 3), np.float32)
    weights = np.zeros((*summed.shape[:2], 1), np.float32)
    for start in range(0, len(corners), _BATCH):
        batch = corners[start : start + _BATCH]
        tiles = np.stack([source.cut(*corner) for corner in batch])
        predicted = network.predict_tiles(tiles).transpose(0, 2, 3, 1)
        for (row, column), vectors in zip(batch, predicted, strict=True):
            area = np.s_[row + TILE : row + 2 * TILE, column + TILE : column + 2 * TILE]
            summed[area] += vectors * window
            weights[area] += window
        progress((start + len(batch)) / len(corners))
    inner = np.s_[TILE : TILE + height, TILE : TILE + width]
    result: NDArray[np.float32] = np.divide(summed[inner], np.maximum(weights[inner], 1e-6))
    return result
