"""Strokes as an artist would draw them to say that a part is hollow, or round."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from lampblack.normals.bend_strokes import HOLLOW, ROUND, cells_under
from lampblack.normals.character import COARSE

from .character_loss import CURVED

SMALLEST = 6
"""Cells of the smallest region that gets a hint."""
MOST = 3
TAUGHT = 3.0
"""What a stroke adds to its cells in training."""
LENGTHS = (2.0, 16.0)
"""Range of the length of a stroke, cells."""
SMOOTH = 0.008
"""The normals are averaged over this share of the canvas's side: lines and noise are no bends."""

Cells = NDArray[np.int8]


def bent_cells(normals: NDArray[np.float32], mask: NDArray[np.bool_]) -> Cells:
    """(h, w) int8: 1 where the surface is round, -1 where it is hollow, 0 elsewhere.

    Args:
        normals: (H, W, 3) unit in ``mask``, (H, W).
    """
    side = float(mask.size) ** 0.5
    rows, columns = (n // COARSE for n in mask.shape)
    sigma = SMOOTH * side / COARSE

    def cells(plane: NDArray[np.float32]) -> NDArray[np.float32]:
        means = plane.reshape(rows, COARSE, columns, COARSE).mean(axis=(1, 3), dtype=np.float32)
        return np.asarray(ndimage.gaussian_filter(means, sigma), np.float32)

    share = cells(mask.astype(np.float32))
    x, y = (cells(normals[..., i] * mask) / np.maximum(share, 1e-3) for i in (0, 1))
    bend = (np.gradient(x, axis=1) - np.gradient(y, axis=0)) * (side / COARSE)
    inside = share > 0.99
    return np.asarray(np.sign(bend) * (inside & (abs(bend) > CURVED)), np.int8)


def random_hints(bent: Cells, rng: np.random.Generator) -> NDArray[np.float32]:
    """(h, w) float32 of one to ``MOST`` strokes, as ``stroke_cells`` draws them, in hollow regions
    of ``bent`` and in round ones. Hollow regions are hinted a little more often."""
    hints = np.zeros(bent.shape, np.float32)
    for _ in range(rng.integers(1, MOST + 1)):
        sign = HOLLOW if rng.random() < 0.6 else ROUND
        rows, columns = np.nonzero(bent == sign)
        if len(rows) < SMALLEST:
            continue
        start = rng.integers(len(rows))
        region, _count = ndimage.label(bent == sign)
        same = region[rows, columns] == region[rows[start], columns[start]]
        if np.count_nonzero(same) < SMALLEST:
            continue
        end = rng.choice(np.flatnonzero(same))
        first, last = (np.array([columns[i], rows[i]]) + 0.5 for i in (start, end))
        far = float(np.hypot(*(last - first)))
        share = min(1.0, rng.uniform(*LENGTHS) / max(far, 1e-6))
        line = np.stack([first, first + share * (last - first)])
        row, column = cells_under(line, bent.shape)
        here = bent[row, column] == sign
        hints[row[here], column[here]] = TAUGHT * sign
    return hints
