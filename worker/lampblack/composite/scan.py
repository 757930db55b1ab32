"""Rows of pictures, for compiled loops that need them pixel by pixel, from left to right.

A row between two rows of a picture is interpolated once; the pixels are then between two of its
elements each, the same two in every row. The outer edges of picture and result coincide, as in
``resample.enlarge``.
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
def places(step: float, start: float, count: int, size: int) -> Any:
    """For each of ``count`` pixels, at ``start + i * step`` of 0..1, the element before it of
    ``size`` elements, (count,) intp, and the share of the next one, (count,) float32."""
    before, shares = np.empty(count, np.intp), np.empty(count, np.float32)
    for at in range(count):
        before[at], _, shares[at] = between(start + at * step, size)
    return before, shares


@compiled
def colours_of_row(picture: Any, v: float, first: int, last: int) -> Any:
    """(w + 1, 3) the row at ``v`` of ``picture``, (h, w, 3): its elements ``first`` to ``last`` and
    the one after them. The last element is repeated."""
    width = picture.shape[1]
    row = np.empty((width + 1, 3), np.float32)
    above, below, share = between(v, picture.shape[0])
    one, other = picture[above], picture[below]
    for column in range(first, min(last + 2, width)):
        for c in range(3):
            row[column, c] = one[column, c] + share * (other[column, c] - one[column, c])
    row[width] = row[width - 1]
    return row


@compiled
def colour_of(row: Any, before: int, share: Any, found: Any, at: int) -> None:
    """Write the colour of a row of colours, ``share`` of the way from an element to the next, to
    ``found[at]``."""
    for c in range(3):
        found[at, c] = row[before, c] + share * (row[before + 1, c] - row[before, c])


@compiled
def levels_of_row(picture: Any, v: float, first: int, last: int) -> Any:
    """(2, w + 1) the same of a picture with one channel: the level, and how much it rises from the
    row above to that below."""
    width = picture.shape[1]
    row = np.empty((2, width + 1), np.float32)
    above, below, share = between(v, picture.shape[0])
    one, other = picture[above], picture[below]
    for column in range(first, min(last + 2, width)):
        row[0, column] = one[column] + share * (other[column] - one[column])
        row[1, column] = other[column] - one[column]
    row[:, width] = row[:, width - 1]
    return row


@compiled
def level_of(row: Any, before: int, share: Any) -> Any:
    """The level ``share`` of the way from an element to the next."""
    return row[0, before] + share * (row[0, before + 1] - row[0, before])


@compiled
def sides_of_row(
    picture: Any, v: float, first: int, last: int, across: Any, down: Any, lows: Any, highs: Any
) -> Any:
    """(w,) int8 for each element ``first`` to ``last`` of a row, on which side of all steps the
    pixels between it and the next are: 0 is below, 1 above, -1 unknown. See ``step_of``."""
    width = picture.shape[1]
    sides = np.empty(width, np.int8)
    above, below, _ = between(v, picture.shape[0])
    one, other = picture[above], picture[below]
    # How far the light at a pixel may be from that of the four elements around it, where its step
    # is anti-aliased, as a share of their range.
    reach = np.float32(1.5) * max(across, down, np.float32(1))
    lowest, highest = lows[0], highs[-1]
    for column in range(first, last + 1):
        after = min(column + 1, width - 1)
        a, b, c, d = one[column], one[after], other[column], other[after]
        least, most = min(min(a, b), min(c, d)), max(max(a, b), max(c, d))
        margin = reach * (most - least)
        side = 0 if most + margin < lowest else -1
        sides[column] = 1 if least - margin > highest else side
    return sides


@compiled
def step_of(
    row: Any, before: int, share: Any, across: Any, down: Any, lows: Any, highs: Any
) -> Any:
    """The tone ``share`` of the way from an element to the next: 0 is below all steps, 1 above all
    of them. Steps are at least as wide as a pixel, so that their edges are anti-aliased.

    Args:
        across, down: size of a pixel in elements of the picture.
    """
    rise = row[0, before + 1] - row[0, before]
    value = row[0, before] + share * rise
    slope_x = across * rise
    slope_y = down * (row[1, before] + share * (row[1, before + 1] - row[1, before]))
    pixel = np.float32(0.75) * np.sqrt(slope_x * slope_x + slope_y * slope_y)
    total = np.float32(0)
    for step in range(len(lows)):
        middle = np.float32(0.5) * (lows[step] + highs[step])
        half = max(np.float32(0.5) * (highs[step] - lows[step]), pixel, np.float32(1e-4))
        part = min(max((value - middle) / half, np.float32(-1)), np.float32(1))
        part = np.float32(0.5) + np.float32(0.5) * part
        total += part * part * (np.float32(3) - np.float32(2) * part)
    return total / np.float32(len(lows))
