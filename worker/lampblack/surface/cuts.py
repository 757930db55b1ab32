"""Cuts: links of a grid across which a height jumps, and by how much.

A cut follows a curve. The pixels on the curve belong to the side in front, so the links from them
to pixels behind are cut. A chain of pixels that touch at least by their corners lets no path
through, so a cut has no leaks.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..choices import FrontSide
from ..compiled import compiled

Floats = NDArray[np.float32]
Ints = NDArray[np.int32]

NEAR = 2
"""Pixels around a curve that are told which side of it they are on."""


@dataclass(frozen=True, eq=False)
class Cuts:
    """Jumps of a height (H, W) to the next pixel; 0 where the surface is not cut.

    Attributes:
        right: (H, W) float32, the height of the pixel to the right minus the pixel's.
        down: (H, W) float32, the height of the pixel below minus the pixel's.
    """

    right: Floats
    down: Floats

    @classmethod
    def none(cls, shape: tuple[int, ...]) -> Cuts:
        """No cuts."""
        return cls(np.zeros(shape, np.float32), np.zeros(shape, np.float32))

    def add(self, points: Floats, towards: Floats, steps: Floats, mask: NDArray[np.bool_]) -> None:
        """Cut along a curve; where two cuts meet, the larger jump remains.

        Args:
            points: (N, 2) x, y in pixels of the grid.
            towards: (N, 2) x, y, unit, across the curve to the side in front.
            steps: (N,) how far the front lies before the back, positive.
            mask: (H, W) bool.
        """
        _cut(points, towards, steps, mask, self.right, self.down)


def across(points: Floats, side: FrontSide) -> Floats:
    """(N, 2) float32 x, y, unit: across a line of (N, 2) points x, y, at each to that side of it
    for a walker from the first to the last."""
    if len(points) < 2:
        return np.zeros_like(points)
    along = np.gradient(points.astype(np.float64), axis=0)
    turn = 1.0 if side == "left" else -1.0
    normal = turn * np.stack([along[:, 1], -along[:, 0]], axis=1)
    length = np.maximum(np.hypot(normal[:, 0], normal[:, 1]), 1e-9)
    unit: Floats = (normal / length[:, None]).astype(np.float32)
    return unit


def jumps_across(
    points: Floats, towards: Floats, height: Floats, mask: NDArray[np.bool_], cuts: Cuts
) -> Floats:
    """(N,) how far the front of a cut curve lies before the back at each point, on average over
    the cut links around it; NaN where there are none. Arguments as for ``Cuts.add``."""
    return _jumps(points, towards, height, mask, cuts.right, cuts.down)


@compiled
def _chain(
    points: Floats, towards: Floats, steps: Floats, rows: int, columns: int
) -> tuple[Ints, Floats, Ints]:
    """The pixels of a curve: (K, 2) rows and columns, (K, 3) towards and step, (K,) the point each
    is nearest to."""
    room = 2
    for i in range(len(points) - 1):
        dx = abs(points[i + 1, 0] - points[i, 0])
        dy = abs(points[i + 1, 1] - points[i, 1])
        room += int(max(dx, dy)) + 2
    pixels = np.empty((room, 2), np.int32)
    values = np.empty((room, 3), np.float32)
    nearest = np.empty(room, np.int32)
    count = 0
    for i in range(len(points)):
        j = min(i + 1, len(points) - 1)
        dx, dy = points[j, 0] - points[i, 0], points[j, 1] - points[i, 1]
        parts = int(np.ceil(max(abs(dx), abs(dy), np.float32(1e-6))))
        for k in range(parts):
            t = np.float32(k / parts)
            r = int(np.floor(points[i, 1] + t * dy))
            c = int(np.floor(points[i, 0] + t * dx))
            if r < 0 or c < 0 or r >= rows or c >= columns:
                continue
            if count and pixels[count - 1, 0] == r and pixels[count - 1, 1] == c:
                continue
            pixels[count, 0], pixels[count, 1] = r, c
            values[count, 0] = (1 - t) * towards[i, 0] + t * towards[j, 0]
            values[count, 1] = (1 - t) * towards[i, 1] + t * towards[j, 1]
            values[count, 2] = (1 - t) * steps[i] + t * steps[j]
            nearest[count] = i if t < 0.5 else j
            count += 1
    return pixels[:count], values[:count], nearest[:count]


@compiled
def _sides(pixels: Ints, values: Floats, rows: int, columns: int) -> tuple[Floats, int, int]:
    """Around a chain of pixels: positive in front, negative behind, NaN on the chain; and the
    first row and column of that window."""
    top, left = pixels[:, 0].min() - NEAR, pixels[:, 1].min() - NEAR
    bottom, right = pixels[:, 0].max() + NEAR, pixels[:, 1].max() + NEAR
    side = np.zeros((bottom - top + 1, right - left + 1), np.float32)
    for k in range(len(pixels)):
        r, c = pixels[k, 0] - top, pixels[k, 1] - left
        for dr in range(-NEAR, NEAR + 1):
            for dc in range(-NEAR, NEAR + 1):
                across = values[k, 0] * dc + values[k, 1] * dr
                side[r + dr, c + dc] += across / np.float32(1 + dr * dr + dc * dc)
    for k in range(len(pixels)):
        side[pixels[k, 0] - top, pixels[k, 1] - left] = np.nan
    return side, int(top), int(left)


@compiled
def _cut(
    points: Floats,
    towards: Floats,
    steps: Floats,
    mask: NDArray[np.bool_],
    right: Floats,
    down: Floats,
) -> None:
    rows, columns = mask.shape
    pixels, values, _ = _chain(points, towards, steps, rows, columns)
    if len(pixels) == 0:
        return
    side, top, left = _sides(pixels, values, rows, columns)
    for k in range(len(pixels)):
        r, c = pixels[k]
        if not mask[r, c]:
            continue
        step = values[k, 2]
        for dr, dc in ((-1, 0), (0, -1), (0, 1), (1, 0)):
            i, j = r + dr, c + dc
            if i < 0 or j < 0 or i >= rows or j >= columns or not mask[i, j]:
                continue
            if not side[i - top, j - left] < 0:
                continue
            if dc == 1:
                right[r, c] = _larger(right[r, c], -step)
            elif dc == -1:
                right[r, j] = _larger(right[r, j], step)
            elif dr == 1:
                down[r, c] = _larger(down[r, c], -step)
            else:
                down[i, c] = _larger(down[i, c], step)


@compiled
def _larger(a: float, b: float) -> float:
    return a if abs(a) > abs(b) else b


@compiled
def _jumps(
    points: Floats,
    towards: Floats,
    height: Floats,
    mask: NDArray[np.bool_],
    right: Floats,
    down: Floats,
) -> Floats:
    rows, columns = mask.shape
    total, links = np.zeros(len(points), np.float32), np.zeros(len(points), np.float32)
    pixels, values, nearest = _chain(
        points, towards, np.zeros(len(points), np.float32), rows, columns
    )
    if len(pixels):
        side, top, left = _sides(pixels, values, rows, columns)
        for k in range(len(pixels)):
            r, c = pixels[k]
            for dr, dc in ((-1, 0), (0, -1), (0, 1), (1, 0)):
                i, j = r + dr, c + dc
                if i < 0 or j < 0 or i >= rows or j >= columns:
                    continue
                if not (mask[r, c] and mask[i, j] and side[i - top, j - left] < 0):
                    continue
                jump = right[r, min(c, j)] if dr == 0 else down[min(r, i), c]
                if jump != 0:
                    total[nearest[k]] += height[r, c] - height[i, j]
                    links[nearest[k]] += 1
    for i in range(len(points)):
        total[i] = total[i] / links[i] if links[i] else np.nan
    return total
