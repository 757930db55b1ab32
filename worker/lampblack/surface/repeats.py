"""Marks on a surface, told from outlines by how they repeat: stripes, rows of folds, spots."""

from __future__ import annotations

from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from ..compiled import compiled
from .cuts import Floats, across
from .strokes import Stroke

FURTHEST = 0.085
"""Largest distance of parallel lines that may be stripes; share of the character's length."""
ALIKE = 1.5
"""Largest ratio of the two distances between three lines of a row."""
PARALLEL = 0.85
"""Least cosine between the directions of lines of a row."""
MOST = 0.4
"""A stroke is part of a row if this share of it is."""
PARALLEL_BESIDE = 0.7
"""Least cosine between the directions of a line of a row and of one beside the row."""
MOST_BESIDE = 0.3
"""A stroke is beside a row, or a spot, if this share of it is."""
SPOT = 0.1
"""Rings smaller than this are spots, eyes or buttons; share of the length."""
CURLED = 1.8
"""A ring is this much longer than its box."""


class Repeats(IntEnum):
    """How a stroke repeats: not at all; it has a stroke that repeats next to it, as the last stripe
    has; it repeats."""

    ALONE = 0
    BESIDE = 1
    REPEATED = 2


def repeats_among(strokes: list[Stroke], shape: tuple[int, ...], length: float) -> list[Repeats]:
    """How each stroke repeats. Small rings do, and strokes that lie in a row of three or more
    parallel lines at even distances.

    Args:
        strokes: in pixels of a grid of ``shape``. length: of the character, in pixels.
    """
    normals = [across(stroke.points, "left") for stroke in strokes]
    lines, owner = np.zeros((*shape, 2), np.float32), np.full(shape, -1, np.int32)
    for index, (stroke, left) in enumerate(zip(strokes, normals, strict=True)):
        _draw(stroke.points, left, index, lines, owner)
    furthest = np.float32(FURTHEST * length)
    repeated = np.zeros(len(strokes), bool)
    for index, (stroke, left) in enumerate(zip(strokes, normals, strict=True)):
        extent = float(np.ptp(stroke.points, axis=0).max())
        small = extent < SPOT * length and len(stroke.points) > CURLED * extent
        in_row = _repeated(stroke.points, left, lines, furthest)
        repeated[index] = small or in_row >= MOST * len(stroke.points)
    found = []
    for index, (stroke, left) in enumerate(zip(strokes, normals, strict=True)):
        beside = _beside(stroke.points, left, lines, owner, repeated, furthest)
        near = Repeats.BESIDE if beside > MOST_BESIDE * len(stroke.points) else Repeats.ALONE
        found.append(Repeats.REPEATED if repeated[index] else near)
    return found


@compiled
def _draw(
    points: Floats, left: Floats, index: int, lines: Floats, owner: NDArray[np.int32]
) -> None:
    """Draw the normals and the number of a stroke, three pixels wide, so that no ray slips
    through."""
    rows, columns = lines.shape[:2]
    for i in range(len(points)):
        row, column = int(np.floor(points[i, 1])), int(np.floor(points[i, 0]))
        for r in range(max(row - 1, 0), min(row + 2, rows)):
            for c in range(max(column - 1, 0), min(column + 2, columns)):
                lines[r, c] = left[i]
                owner[r, c] = index


@compiled
def _repeated(points: Floats, left: Floats, lines: Floats, furthest: np.float32) -> int:
    """The number of points of a stroke that lie in a row."""
    rows, columns = lines.shape[:2]
    count = 0
    for i in range(len(points)):
        met = np.zeros((2, 2), np.float32)
        for s in range(2):
            x, y = left[i, 0] * (1 - 2 * s), left[i, 1] * (1 - 2 * s)
            hits = 0
            out = np.float32(4)
            while out < 2 * furthest and hits < 2:
                r, c = int(np.floor(points[i, 1] + out * y)), int(np.floor(points[i, 0] + out * x))
                if r < 0 or c < 0 or r >= rows or c >= columns:
                    break
                turn = abs(lines[r, c, 0] * x + lines[r, c, 1] * y)
                if turn > PARALLEL:
                    met[s, hits] = out + 1  # the middle of the line
                    hits += 1
                    out += np.float32(4)
                out += np.float32(0.5)
        one, other = met[0, 0], met[1, 0]
        both = 0 < one <= furthest and 0 < other <= furthest
        if both and max(one, other) <= ALIKE * min(one, other):
            count += 1
            continue
        for s in range(2):
            near, far = met[s, 0], met[s, 1] - met[s, 0]
            if 0 < near <= furthest and met[s, 1] > 0 and max(near, far) <= ALIKE * min(near, far):
                count += 1
                break
    return count


@compiled
def _beside(
    points: Floats,
    left: Floats,
    lines: Floats,
    owner: NDArray[np.int32],
    repeated: NDArray[np.bool_],
    furthest: np.float32,
) -> int:
    """The number of points of a stroke whose next parallel line, on either side, repeats."""
    rows, columns = owner.shape
    count = 0
    for i in range(len(points)):
        for s in range(2):
            x, y = left[i, 0] * (1 - 2 * s), left[i, 1] * (1 - 2 * s)
            next_line = -1
            out = np.float32(4)
            while out < furthest and next_line < 0:
                r, c = int(np.floor(points[i, 1] + out * y)), int(np.floor(points[i, 0] + out * x))
                if r < 0 or c < 0 or r >= rows or c >= columns:
                    break
                if abs(lines[r, c, 0] * x + lines[r, c, 1] * y) > PARALLEL_BESIDE:
                    next_line = owner[r, c]
                out += np.float32(0.5)
            if next_line >= 0 and repeated[next_line]:
                count += 1
                break
    return count
