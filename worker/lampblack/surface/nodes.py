"""The vertices of a relief's front: a node per block of pixels, and rims where it ends."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

STEP = 4.0
"""Two neighbours are on two sides of a step if their heights differ by more than this multiple of
the slope on either side (at least one pixel per pixel)."""
GAP = 1 / 64
"""Pixels between the two edges of a step, so that no face there is degenerate."""

HEADING = {"right": (0, 1), "left": (0, -1), "down": (1, 0), "up": (-1, 0)}
"""(rows, columns) to the neighbour."""


@dataclass(frozen=True)
class Nodes:
    """Nodes on a grid of R x C blocks, the outermost of which are empty.

    Attributes:
        points: (N, 3) float32, x right, y down, z towards the viewer: nodes, then rims.
        number: (R, C) int32, the block's node in ``points``; -1 where the block is empty.
        link_right: (R, C - 1) bool, the surface continues to the block on the right.
        link_down: (R - 1, C) bool, the surface continues to the block below.
        rim: by heading, (R, C) int32, the vertex where the node's surface ends in that
            direction; -1 where it continues.
    """

    points: NDArray[np.float32]
    number: NDArray[np.int32]
    link_right: NDArray[np.bool_]
    link_down: NDArray[np.bool_]
    rim: dict[str, NDArray[np.int32]]


def place_nodes(height: NDArray[np.float32], mask: NDArray[np.bool_], stride: int) -> Nodes:
    """Place a node on the pixel of the mask nearest to the middle of every block.

    So no part of the character is missed, however thin. A rim towards an empty block lies on
    the outer edge of the last pixel of the mask in that direction; its height is extrapolated
    along the slope. A rim at a step lies half way to the other node.
    """
    blocks = _blocks(mask, stride)
    middle = (stride - 1) / 2
    row, column = np.divmod(np.arange(stride * stride), stride)
    distance = np.hypot(row - middle, column - middle).astype(np.float32)
    nearest = np.argmin(np.where(blocks, distance, np.float32(np.inf)), axis=2)
    occupied = blocks.any(axis=2)
    node_row, node_column = (
        (at - 1) * stride + step[nearest]
        for at, step in zip(np.indices(occupied.shape), (row, column), strict=True)
    )
    level = np.zeros(occupied.shape, np.float32)
    level[occupied] = height[node_row[occupied], node_column[occupied]]
    touching = blocks.reshape(*occupied.shape, stride, stride)
    meets_right = (touching[:, :-1, :, -1] & touching[:, 1:, :, 0]).any(axis=2)
    meets_down = (touching[:-1, :, -1] & touching[1:, :, 0]).any(axis=2)
    link_right = meets_right & ~_steps(level, meets_right, stride)
    link_down = meets_down & ~_steps(level.T, meets_down.T, stride).T

    number = np.full(occupied.shape, -1, np.int32)
    number[occupied] = np.arange(np.count_nonzero(occupied), dtype=np.int32)
    centre = np.stack([node_column + 0.5, node_row + 0.5, level], axis=2).astype(np.float32)
    points = [centre[occupied]]
    count = len(points[0])
    linked = {name: np.zeros(occupied.shape, bool) for name in HEADING}
    linked["right"][:, :-1] = linked["left"][:, 1:] = link_right
    linked["down"][:-1] = linked["up"][1:] = link_down
    rims = {}
    for name, heading in HEADING.items():
        rims[name] = np.full(occupied.shape, -1, np.int32)
        ends = np.nonzero(occupied & ~linked[name])
        beyond = ends[0] + heading[0], ends[1] + heading[1]
        rim = _mask_edge(height, mask, node_row[ends], node_column[ends], heading, stride)
        step = occupied[beyond]
        rim[step, :2] = (centre[ends] + centre[beyond])[step, :2] / 2
        rim[step, :2] -= np.array(heading[::-1]) * (GAP / 2)
        rim[step, 2] = level[ends][step]
        rims[name][ends] = np.arange(count, count + len(rim), dtype=np.int32)
        points.append(rim)
        count += len(rim)
    return Nodes(np.concatenate(points), number, link_right, link_down, rims)


def _blocks(mask: NDArray[np.bool_], stride: int) -> NDArray[np.bool_]:
    """(R, C, stride * stride) the mask by blocks, with empty blocks around it."""
    rows, columns = (-(-size // stride) + 2 for size in mask.shape)
    padded = np.zeros((rows * stride, columns * stride), bool)
    padded[stride : stride + mask.shape[0], stride : stride + mask.shape[1]] = mask
    split = padded.reshape(rows, stride, columns, stride).swapaxes(1, 2)
    return split.reshape(rows, columns, stride * stride)


def _steps(level: NDArray[np.float32], meets: NDArray[np.bool_], stride: int) -> NDArray[np.bool_]:
    """(R, C - 1) bool, where the height jumps from one column to the next."""
    rise = np.where(meets, np.abs(np.diff(level, axis=1)), 0)
    slope = np.full_like(rise, stride)
    slope[:, 1:] = np.maximum(slope[:, 1:], rise[:, :-1])
    slope[:, :-1] = np.maximum(slope[:, :-1], rise[:, 1:])
    return np.asarray(rise > STEP * slope)


def _mask_edge(
    height: NDArray[np.float32],
    mask: NDArray[np.bool_],
    row: NDArray[np.intp],
    column: NDArray[np.intp],
    heading: tuple[int, int],
    stride: int,
) -> NDArray[np.float32]:
    """(N, 3) the outer edge of the last pixel of the mask between a node and its block's end."""
    down, right = heading
    last = np.zeros(len(row), np.intp)
    for ahead in range(1, stride):
        r, c = row + ahead * down, column + ahead * right
        same_block = (r // stride == row // stride) & (c // stride == column // stride)
        inside = same_block & (r < mask.shape[0]) & (c < mask.shape[1])
        last[inside] = np.where(mask[r[inside], c[inside]], ahead, last[inside])
    row, column = row + last * down, column + last * right
    before_row, before_column = row - down, column - right
    known = (
        (before_row >= 0)
        & (before_column >= 0)
        & (before_row < mask.shape[0])
        & (before_column < mask.shape[1])
    )
    known[known] = mask[before_row[known], before_column[known]]
    here = height[row, column].astype(np.float32, copy=False)
    slope = np.zeros_like(here)
    slope[known] = here[known] - height[before_row[known], before_column[known]]
    x, y = column + 0.5 + right / 2, row + 0.5 + down / 2
    return np.stack([x, y, here + slope / 2], axis=1, dtype=np.float32, casting="same_kind")
