"""Strokes that tell the network that the surface is round there, or hollow (hints as input, He
2021)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .character import COARSE, Canvas

ROUND, HOLLOW = 1, -1
STRENGTH = 10.0
"""What a stroke adds to its cells: more than in training, since the network then follows it
further (chosen on validation views)."""
REACH = 1
"""Cells on either side of a stroke's middle that it covers."""


@dataclass(frozen=True, eq=False)
class BendStroke:
    """``points`` (N, 2) float32 x, y in pixels; ``bend`` is ``ROUND`` or ``HOLLOW`` along them."""

    points: NDArray[np.float32]
    bend: int

    def moved(self, right: float, down: float) -> BendStroke:
        """The stroke in a picture that begins at (-``right``, -``down``)."""
        return BendStroke(self.points + np.array([right, down], np.float32), self.bend)


def stroke_cells(
    strokes: Sequence[BendStroke], size: tuple[int, ...], canvas: Canvas
) -> NDArray[np.float32] | None:
    """(h, w) float32 coarse map of strokes: their bend times ``STRENGTH`` on them, else 0. None
    without strokes.

    Args:
        strokes: in pixels of the character's box of ``size`` (rows, columns), which fills the
            inner part of ``canvas``.
    """
    if not strokes:
        return None
    rows, columns = (n // COARSE for n in canvas.shape)
    cells = np.zeros((rows, columns), np.float32)
    scale = np.array([canvas.size[1] / size[1], canvas.size[0] / size[0]])
    corner = np.array([part.start for part in canvas.inner[::-1]])
    for stroke in strokes:
        points = (stroke.points * scale + corner) / COARSE
        points = np.clip(points, -max(cells.shape), 2 * max(cells.shape))  # bounds their number
        row, column = cells_under(points, cells.shape)
        cells[row, column] = STRENGTH * stroke.bend
    return cells


def cells_under(
    points: NDArray[np.float64], shape: tuple[int, ...]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Rows and columns of the cells of a map of ``shape`` under a stroke through ``points``."""
    row, column = cells_along(points)
    around = np.arange(-REACH, REACH + 1)
    row = (row[:, None, None] + around[:, None] + 0 * around).ravel()
    column = (column[:, None, None] + around + 0 * around[:, None]).ravel()
    inside = (row >= 0) & (row < shape[0]) & (column >= 0) & (column < shape[1])
    return row[inside], column[inside]


def cells_along(points: NDArray[np.float64]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Rows and columns of the cells on a line through (N, 2) ``points`` x, y, in cells."""
    along = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    at = np.linspace(0, along[-1], 2 * int(np.ceil(along[-1])) + 1)
    x, y = (np.floor(np.interp(at, along, axis)).astype(np.intp) for axis in points.T)
    return y, x
