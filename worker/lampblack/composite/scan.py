"""Rows of pictures, for compiled loops that need them pixel by pixel, from left to right.

A row between two rows of a picture is interpolated once; the pixels are then between two of its
elements each. The outer edges of picture and result coincide, as in ``resample.enlarge``.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..compiled import compiled


@compiled
def between(at: float, size: int) -> tuple[int, int, Any]:
    """The elements before and after ``at`` in 0..1 of ``size`` elements, and the share of the
    second."""
    place = min(max(at * size - 0.5, 0.0), size - 1.0)
    first = int(place)
    return first, min(first + 1, size - 1), np.float32(place - first)


@compiled
def colours_of_row(picture: Any, v: float, left: float, right: float) -> Any:
    """(w, 3) the row at ``v`` of ``picture``, (h, w, 3): as much of it as pixels from ``left`` to
    ``right`` need."""
    row = np.empty((picture.shape[1], 3), np.float32)
    above, below, share = between(v, picture.shape[0])
    one, other = picture[above], picture[below]
    first, last = between(left, picture.shape[1])[0], between(right, picture.shape[1])[1]
    for column in range(first, last + 1):
        for c in range(3):
            row[column, c] = one[column, c] + share * (other[column, c] - one[column, c])
    return row


@compiled
def colour_of(row: Any, u: float, found: Any, at: int) -> None:
    """Write the colour at ``u`` of a row of colours to ``found[at]``."""
    before, after, share = between(u, len(row))
    for c in range(3):
        found[at, c] = row[before, c] + share * (row[after, c] - row[before, c])


@compiled
def levels_of_row(picture: Any, v: float, left: float, right: float) -> Any:
    """(4, w) the same of a picture with one channel: the level, how much it rises from the row
    above to that below, and the least and the greatest of both."""
    row = np.empty((4, picture.shape[1]), np.float32)
    above, below, share = between(v, picture.shape[0])
    one, other = picture[above], picture[below]
    first, last = between(left, picture.shape[1])[0], between(right, picture.shape[1])[1]
    for column in range(first, last + 1):
        high, low = one[column], other[column]
        row[0, column] = high + share * (low - high)
        row[1, column] = low - high
        row[2, column] = high if high < low else low
        row[3, column] = high if high > low else low
    return row


@compiled
def level_of(row: Any, u: float) -> Any:
    """The level at ``u``."""
    before, after, share = between(u, row.shape[1])
    return row[0, before] + share * (row[0, after] - row[0, before])


@compiled
def step_of(row: Any, u: float, across: Any, down: Any, lows: Any, highs: Any) -> Any:
    """The tone at ``u``: 0 is below all steps, 1 above all of them. Steps are at least as wide as a
    pixel, so that their edges are anti-aliased.

    Args:
        across, down: size of a pixel in elements of the picture.
    """
    before, after, share = between(u, row.shape[1])
    a, b = row[2, before], row[2, after]
    least = a if a < b else b
    a, b = row[3, before], row[3, after]
    most = a if a > b else b
    # Most pixels are far from any step.
    reach = step_reach(across, down) * (most - least)
    if most + reach < lows[0]:
        return np.float32(0)
    if least - reach > highs[-1]:
        return np.float32(1)
    value = row[0, before] + share * (row[0, after] - row[0, before])
    slope_x = across * (row[0, after] - row[0, before])
    slope_y = down * (row[1, before] + share * (row[1, after] - row[1, before]))
    pixel = np.float32(0.75) * np.sqrt(slope_x * slope_x + slope_y * slope_y)
    total = np.float32(0)
    for step in range(len(lows)):
        middle = np.float32(0.5) * (lows[step] + highs[step])
        half = max(np.float32(0.5) * (highs[step] - lows[step]), pixel, np.float32(1e-4))
        part = min(max((value - middle) / half, np.float32(-1)), np.float32(1))
        part = np.float32(0.5) + np.float32(0.5) * part
        total += part * part * (np.float32(3) - np.float32(2) * part)
    return total / np.float32(len(lows))


@compiled
def step_reach(across: Any, down: Any) -> Any:
    """How far the light at a pixel may be from that of the four elements around it, where its step
    is anti-aliased, as a share of their range."""
    return np.float32(1.5) * max(across, down, np.float32(1))
