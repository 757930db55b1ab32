"""The artist's click, simulated: of all overlaps that a surface has, the worst is corrected."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from lampblack.choices import FrontSide
from lampblack.scene import DepthHint, DepthPoint
from lampblack.surface import Overlap

from .jumps import STEP, Floats, Image, figure_length, nearest

BESIDE = 0.01
"""Distance from an overlap to the true depths on either side, as a share of the figure's length."""


def worst_overlap(overlaps: Sequence[Overlap], depth: Image) -> DepthHint | None:
    """A click that sets right the overlap that is wrong along the most length and height.

    An overlap is wrong if the other side is in front in truth, or neither by more than 1 % of the
    figure's length, along most of it; what has no truth on both sides is left alone.

    Args:
        overlaps: of the surface, on the canvas. depth: (H, W) the truth, nan outside the figure.

    Returns:
        A hint of one point in the middle of the overlap, of no given amount; None if no overlap is
        wrong.
    """
    length = figure_length(np.isfinite(depth))
    worst, hint = 0.0, None
    for overlap in overlaps:
        rise = left_above_right(overlap.points, depth, BESIDE * length)
        known = np.isfinite(rise)
        if len(rise) < 2 or known.mean() < 0.5:
            continue
        true = float(np.median(rise[known]))
        front: FrontSide = "joined"
        if abs(true) > STEP * length:
            front = "left" if true > 0 else "right"
        found = overlap.amount if overlap.front == "left" else -overlap.amount
        wrong = 0.0 if front == overlap.front else abs(true - found) * len(rise)
        if wrong > worst:
            x, y = overlap.points[len(rise) // 2].tolist()
            worst, hint = wrong, DepthHint(1, (DepthPoint(x, y),), front)
    return hint


def left_above_right(points: NDArray[np.float32], depth: Image, reach: float) -> Image:
    """(N,) ``depth`` on the left of a line less that on its right, ``reach`` pixels away; nan
    outside.

    Args:
        points: (N, 2), x right and y down, N at least 2.
    """
    ahead: Floats = np.gradient(points.astype(np.float64), axis=0)
    ahead /= np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
    column, row = points.astype(np.float64).T - 0.5
    # Of a walker to the right, the left hand is up the canvas.
    left, right = (
        nearest(depth, row - side * reach * ahead[:, 0], column + side * reach * ahead[:, 1])
        for side in (1, -1)
    )
    return left - right
