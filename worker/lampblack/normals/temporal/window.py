"""The box around a character, sampled by a coarse and a fine grid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..resize import resize

FINE_PX = 512
"""Longest side of the fine grid, for normals; the coarse grid, for lines, has half of it."""
_MARGIN = 0.06

Planes = NDArray[np.float32]


@dataclass(frozen=True)
class Window:
    """A box of a canvas.

    Attributes:
        top, left: canvas pixels; the box may extend past the canvas.
        size: (rows, columns), canvas pixels.
        coarse: (rows, columns) of the coarse grid; the fine grid has twice as many.
    """

    top: int
    left: int
    size: tuple[int, int]
    coarse: tuple[int, int]

    @property
    def fine(self) -> tuple[int, int]:
        """(rows, columns) of the fine grid."""
        return 2 * self.coarse[0], 2 * self.coarse[1]

    def to_grid(self, image: Planes, shape: tuple[int, int]) -> Planes:
        """(H, W, C) canvas -> (C, *shape) grid, area-averaged; 0 beyond the canvas."""
        cut = np.zeros((*self.size, image.shape[2]), np.float32)
        on_canvas, in_box = self._overlap(image.shape)
        cut[in_box] = image[on_canvas]
        return np.ascontiguousarray(resize(cut, shape).transpose(2, 0, 1))

    def to_canvas(
        self, planes: Planes, shape: tuple[int, ...]
    ) -> tuple[Planes, tuple[slice, slice]]:
        """(C, rows, columns) grid -> (h, w, C) pixels, bilinear, and their rows and columns on
        a canvas of ``shape``."""
        whole = resize(planes.transpose(1, 2, 0), self.size)
        on_canvas, in_box = self._overlap(shape)
        return whole[in_box], on_canvas

    def _overlap(self, shape: tuple[int, ...]) -> tuple[tuple[slice, slice], tuple[slice, slice]]:
        rows = slice(max(self.top, 0), min(self.top + self.size[0], shape[0]))
        columns = slice(max(self.left, 0), min(self.left + self.size[1], shape[1]))
        return (rows, columns), (
            slice(rows.start - self.top, rows.stop - self.top),
            slice(columns.start - self.left, columns.stop - self.left),
        )


def window_around(mask: NDArray[np.bool_]) -> Window:
    """The window of the character in a (H, W) mask that is not empty, with a margin."""
    rows, columns = (np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
    height, width = int(np.ptp(rows)) + 1, int(np.ptp(columns)) + 1
    margin = round(_MARGIN * max(height, width)) + 4
    size = height + 2 * margin, width + 2 * margin
    scale = min(1.0, FINE_PX / max(size))
    coarse = max(8, round(size[0] * scale / 2)), max(8, round(size[1] * scale / 2))
    return Window(int(rows[0]) - margin, int(columns[0]) - margin, size, coarse)
