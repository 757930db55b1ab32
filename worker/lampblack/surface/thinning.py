"""Thinning of ink to lines one pixel wide, and the lines between the junctions of the result."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..compiled import compiled


@compiled
def thinned(ink: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The (H, W) ``ink`` reduced to lines one pixel wide, with the same connections."""
    rows, columns = ink.shape
    on = np.zeros((rows + 2, columns + 2), np.uint8)
    count = 0
    for r in range(rows):
        for c in range(columns):
            if ink[r, c]:
                on[r + 1, c + 1] = 1
                count += 1
    left = np.empty((count, 2), np.int32)
    count = 0
    for r in range(1, rows + 1):
        for c in range(1, columns + 1):
            if on[r, c]:
                left[count, 0], left[count, 1] = r, c
                count += 1
    gone = np.empty(count, np.int32)
    changed = True
    while changed:
        changed = False
        for half in range(2):
            erased = 0
            for k in range(count):
                r, c = left[k]
                up, right = on[r - 1, c], on[r, c + 1]
                down, left_ = on[r + 1, c], on[r, c - 1]
                up_right, down_right = on[r - 1, c + 1], on[r + 1, c + 1]
                down_left, up_left = on[r + 1, c - 1], on[r - 1, c - 1]
                around = up + right + down + left_ + up_right + down_right + down_left + up_left
                if around < 2 or around > 6:
                    continue
                turns = (up == 0) & (up_right == 1)
                turns += (up_right == 0) & (right == 1)
                turns += (right == 0) & (down_right == 1)
                turns += (down_right == 0) & (down == 1)
                turns += (down == 0) & (down_left == 1)
                turns += (down_left == 0) & (left_ == 1)
                turns += (left_ == 0) & (up_left == 1)
                turns += (up_left == 0) & (up == 1)
                if turns != 1:
                    continue
                if half == 0 and (up & right & down or right & down & left_):
                    continue
                if half == 1 and (up & right & left_ or up & down & left_):
                    continue
                gone[erased] = k
                erased += 1
            if erased:
                changed = True
                for k in range(erased):
                    on[left[gone[k], 0], left[gone[k], 1]] = 0
                kept = 0
                for k in range(count):
                    if on[left[k, 0], left[k, 1]]:
                        left[kept] = left[k]
                        kept += 1
                count = kept
    found: NDArray[np.bool_] = on[1:-1, 1:-1] == 1
    return found


@compiled
def _next(
    thin: NDArray[np.bool_], left: NDArray[np.bool_], r: int, c: int, out: NDArray[np.int32]
) -> int:
    """Write the neighbours of a pixel that are ``left`` to (8, 2) ``out``, and count them. A
    diagonal one is none if the line also leads there around the corner."""
    rows, columns = thin.shape
    count = 0
    for dr, dc in ((-1, 0), (0, 1), (1, 0), (0, -1)):
        i, j = r + dr, c + dc
        if 0 <= i < rows and 0 <= j < columns and left[i, j]:
            out[count, 0], out[count, 1] = i, j
            count += 1
    for dr, dc in ((-1, 1), (1, 1), (1, -1), (-1, -1)):
        i, j = r + dr, c + dc
        inside = 0 <= i < rows and 0 <= j < columns
        if inside and left[i, j] and not (thin[i, c] or thin[r, j]):
            out[count, 0], out[count, 1] = i, j
            count += 1
    return count


@compiled
def junctions_of(thin: NDArray[np.bool_]) -> NDArray[np.bool_]:
    found = np.zeros(thin.shape, np.bool_)
    out = np.empty((8, 2), np.int32)
    for r in range(thin.shape[0]):
        for c in range(thin.shape[1]):
            if thin[r, c] and _next(thin, thin, r, c, out) > 2:
                found[r, c] = True
    return found


@compiled
def trace_lines(
    thin: NDArray[np.bool_],
) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.bool_]]:
    """The lines between junctions: (M, 2) rows and columns, where each line starts among them
    (K + 1,), and whether it is a loop (K,)."""
    rows, columns = thin.shape
    left = thin & ~junctions_of(thin)
    total = 0
    for r in range(rows):
        for c in range(columns):
            total += left[r, c]
    pixels = np.empty((total, 2), np.int32)
    starts = np.zeros(total + 1, np.int32)
    looped = np.zeros(total, np.bool_)
    out = np.empty((8, 2), np.int32)
    used = lines = 0
    for loops in (False, True):
        for row in range(rows):
            for column in range(columns):
                if not left[row, column]:
                    continue
                if not loops and _next(thin, left, row, column, out) > 1:
                    continue
                r, c = row, column
                while True:
                    pixels[used, 0], pixels[used, 1] = r, c
                    used += 1
                    count = _next(thin, left, r, c, out)
                    left[r, c] = False
                    if count == 0:
                        break
                    r, c = out[0]
                looped[lines] = loops
                lines += 1
                starts[lines] = used
    return pixels, starts[: lines + 1].copy(), looped[:lines].copy()
