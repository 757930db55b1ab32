"""Weighted sums of pictures of different sizes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..compiled import compiled

Floats = NDArray[np.float32]

_DARK = np.zeros((1, 1, 3), np.float32)


def add_up(weighted: Sequence[tuple[Floats, Floats]]) -> Floats:
    """The sum of (3,) weights times (h, w, 3) pictures of the same area, at the largest size.
    Smaller ones are enlarged as ``resample.enlarge`` does."""
    if not weighted:
        return _DARK
    height = max(picture.shape[0] for _, picture in weighted)
    width = max(picture.shape[1] for _, picture in weighted)
    total = np.zeros((height, width, 3), np.float32)
    for weight, picture in weighted:
        # One kind of array, so that the loop is compiled once.
        whole = np.require(picture, np.float32, ("C", "W"))
        _add(np.require(weight, np.float32, ("C", "W")), whole, total)
    return total


def brightest_of(light: Floats) -> Floats:
    """(h, w) the brightest channel of each element of ``light``, (h, w, 3)."""
    found = np.empty(light.shape[:2], np.float32)
    _brightest(np.require(light, np.float32, ("C", "W")), found)
    return found


@compiled
def _brightest(light: Any, found: Any) -> None:
    for row in range(found.shape[0]):
        for column in range(found.shape[1]):
            found[row, column] = max(
                max(light[row, column, 0], light[row, column, 1]), light[row, column, 2]
            )


@compiled
def _add(weight: Any, picture: Any, total: Any) -> None:
    height, width = total.shape[0], total.shape[1]
    old_height, old_width = picture.shape[0], picture.shape[1]
    if old_height == height and old_width == width:
        for row in range(height):
            for column in range(width):
                for c in range(3):
                    total[row, column, c] += weight[c] * picture[row, column, c]
        return
    before, after = np.empty(width, np.intp), np.empty(width, np.intp)
    share, between = np.empty(width, np.float32), np.empty((old_width, 3), np.float32)
    for column in range(width):
        at = min(max((column + 0.5) * old_width / width - 0.5, 0.0), old_width - 1.0)
        before[column] = int(at)
        after[column] = min(int(at) + 1, old_width - 1)
        share[column] = at - int(at)
    for row in range(height):
        at = min(max((row + 0.5) * old_height / height - 0.5, 0.0), old_height - 1.0)
        top, bottom, part = int(at), min(int(at) + 1, old_height - 1), np.float32(at - int(at))
        for column in range(old_width):
            for c in range(3):
                above = picture[top, column, c]
                between[column, c] = above + part * (picture[bottom, column, c] - above)
        for column in range(width):
            for c in range(3):
                left = between[before[column], c]
                found = left + share[column] * (between[after[column], c] - left)
                total[row, column, c] += weight[c] * found
