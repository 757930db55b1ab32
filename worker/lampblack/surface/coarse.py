"""Fewer triangles where a relief is nearly flat, or where nobody sees it.

Square blocks of whole cells become one fan about their middle each. A fan goes through every node
that something finer beside it uses, so the mesh stays closed.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

SIZES = 8, 4
"""Cells along the side of a block, the largest first."""
BEND = 0.06
"""Largest change of slope across a block of the front, pixels per pixel. The edge of a shadow is
off by half of that angle at most."""

Floats = NDArray[np.float32]
Flags = NDArray[np.bool_]
Fits = Callable[[int], Flags]
Value = TypeVar("Value", bound=np.generic)


def flat_blocks(level: Floats, whole: Flags, stride: float) -> NDArray[np.uint8]:
    """The size of the block in which each cell is: blocks in which the surface is nearly flat.

    Args:
        level: (R, C) float32, height of the nodes, in the unit of ``stride``.
        whole: (R - 1, C - 1) bool, cells that may be part of a block.
        stride: from node to node.

    Returns:
        (R - 1, C - 1); 0 where the cell is left as it is.
    """
    bend = np.zeros(level.shape, np.float32)
    # Over two links each way: heights may be interpolated from half the resolution.
    for found, along in ((bend, level), (bend.T, level.T)):
        second = abs(along[4:] - 2 * along[2:-2] + along[:-4]) / 4
        found[2:-2] = np.maximum(found[2:-2], second)
    twist = abs(level[1:, 1:] - level[1:, :-1] - level[:-1, 1:] + level[:-1, :-1])
    bent = np.maximum(twist, _of_corners(bend, np.maximum)) / np.float32(stride)
    return _sizes(whole, lambda size: _tiles(bent, size).max(axis=(1, 3)) * size <= BEND)


def one_part(part: NDArray[np.integer[Any]]) -> Flags:
    """(R - 1, C - 1) whether the nodes of a cell, (R, C), are of one part."""
    return np.asarray(_of_corners(part, np.maximum) == _of_corners(part, np.minimum))


def hidden_blocks(front: Floats, back: Floats, whole: Flags) -> NDArray[np.uint8]:
    """As ``flat_blocks``, for the back: blocks that stay behind the front however they are filled.

    Args:
        front, back: (R, C) float32, height of the nodes.
    """
    nearest, farthest = _of_corners(back, np.maximum), _of_corners(front, np.minimum)

    def apart(size: int) -> Flags:
        near, far = _tiles(nearest, size).max(axis=(1, 3)), _tiles(farthest, size).min(axis=(1, 3))
        return np.asarray(near < far)

    return _sizes(whole, apart)


def fans(number: NDArray[np.int32], block: NDArray[np.uint8]) -> NDArray[np.int32]:
    """(F, 3) the triangles of all blocks.

    Args:
        number: (R, C) int32, the vertex of each node. block: as ``flat_blocks`` returns it.
    """
    used = np.zeros(number.shape, bool)
    fine = block == 0
    for lower, further in ((0, 0), (0, 1), (1, 0), (1, 1)):
        used[lower : lower + fine.shape[0], further : further + fine.shape[1]] |= fine
    corners = {size: _corners(block, size) for size in SIZES}
    for size, (row, column) in corners.items():
        for lower, further in ((0, 0), (0, size), (size, 0), (size, size)):
            used[row + lower, column + further] = True
    found = [np.zeros((0, 3), np.int32)]
    for size, (row, column) in corners.items():
        down, right = _ring(size)
        ring = number[row[:, None] + down, column[:, None] + right]
        kept = used[row[:, None] + down, column[:, None] + right]
        middle = number[row + size // 2, column + size // 2]
        # The next node of the ring that is used: the ring twice, read from its end.
        position = np.where(np.tile(kept, 2), np.arange(2 * len(down)), 2 * len(down))
        ahead = np.minimum.accumulate(position[:, ::-1], axis=1)[:, ::-1][:, 1 : len(down) + 1]
        following = np.take_along_axis(ring, ahead % len(down), axis=1)
        about = np.broadcast_to(middle[:, None], ring.shape)
        found.append(np.stack([about[kept], ring[kept], following[kept]], axis=1))
    return np.concatenate(found)


def _ring(size: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Rows and columns of the nodes on the edge of a block, counter-clockwise as they are seen."""
    along, zero = np.arange(size), np.zeros(size, np.intp)
    down = np.concatenate([along, zero + size, size - along, zero])
    right = np.concatenate([zero, along, zero + size, size - along])
    return down, right


def _sizes(whole: Flags, fits: Fits) -> NDArray[np.uint8]:
    """The largest block that fits, for each cell."""
    found = np.zeros(whole.shape, np.uint8)
    for size in SIZES:
        good = _tiles(whole & (found == 0), size).all(axis=(1, 3)) & fits(size)
        cells = good.repeat(size, axis=0).repeat(size, axis=1)
        found[: cells.shape[0], : cells.shape[1]][cells] = size
    return found


def _corners(block: NDArray[np.uint8], size: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Rows and columns of the first cells of the blocks of ``size``."""
    row, column = np.nonzero(block[::size, ::size] == size)
    return row * size, column * size


def _tiles(cells: NDArray[Value], size: int) -> NDArray[Value]:
    """(A, size, B, size) the cells by blocks, without those that fill no block."""
    rows, columns = (length // size for length in cells.shape)
    return cells[: rows * size, : columns * size].reshape(rows, size, columns, size)


def _of_corners(nodes: NDArray[Value], reduce: np.ufunc) -> NDArray[Value]:
    """Reduce the four corners of each cell."""
    across = reduce(nodes[:, 1:], nodes[:, :-1])
    return cast(NDArray[Value], reduce(across[1:], across[:-1]))
