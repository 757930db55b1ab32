"""The artist's stroke, simulated: one in the largest hollow that was taken for round."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from lampblack.normals.bend_strokes import HOLLOW, BendStroke

from .metrics import CURVED, bend

SMALLEST = 0.002
"""Smallest hollow that gets a stroke, as a share of the character's area."""

Mask = NDArray[np.bool_]
Normals = NDArray[np.float32]


def mended(
    predict: Callable[[Sequence[BendStroke]], Normals], found: Normals, truth: Normals, mask: Mask
) -> float:
    """The share of the largest wrong hollow that is hollow after one stroke in it; nan if no hollow
    of ``SMALLEST`` or more is wrong.

    Args:
        predict: (H, W, 3) unit normals of the drawing with strokes. found: those without.
    """
    wrong = largest_part((bend(truth, mask) < -CURVED) & (bend(found, mask) >= 0) & mask)
    if np.count_nonzero(wrong) < max(1, SMALLEST * np.count_nonzero(mask)):
        return float("nan")
    after = predict([BendStroke(line_through(wrong), HOLLOW)])
    return float((bend(after, mask) < 0)[wrong].mean())


def largest_part(region: Mask) -> Mask:
    """The largest connected part of a region."""
    parts, count = ndimage.label(region)
    if not count:
        return region
    sizes = np.bincount(parts.ravel())
    sizes[0] = 0
    return np.asarray(parts == np.argmax(sizes))


def line_through(region: Mask) -> NDArray[np.float32]:
    """(2, 2) x, y: the straight line through the middle of a region along its longest extent, as
    far as it stays inside."""
    depth = ndimage.distance_transform_edt(np.pad(region, 1))[1:-1, 1:-1]
    middle = np.array(np.unravel_index(int(np.argmax(depth)), region.shape), float)
    places = np.argwhere(region) - middle
    way = np.linalg.svd(places, full_matrices=False)[2][0]
    ends = []
    for side in (1, -1):
        at = middle
        while True:
            ahead = at + side * way
            row, column = np.round(ahead).astype(int)
            if not (0 <= row < region.shape[0] and 0 <= column < region.shape[1]):
                break
            if not region[row, column]:
                break
            at = ahead
        ends.append(at[::-1] + 0.5)
    return np.array(ends, np.float32)
