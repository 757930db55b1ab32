"""A line along which one part of a character is in front of another."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import get_args

import numpy as np
from numpy.typing import NDArray

from ..choices import FrontSide

_FRONTS: tuple[FrontSide, ...] = get_args(FrontSide)


@dataclass(frozen=True, eq=False)
class Overlap:
    """A step of the height along a line of the drawing.

    Attributes:
        points: (N, 2) float32, x right and y down, in pixels of the drawing.
        front: the side in front, for a walker from the first point to the last, as seen on the
            drawing. ``joined``: a hint has closed the step.
        amount: height of the step in pixels of the drawing, the mean along the line.
        hinted: a hint made it so.
    """

    points: NDArray[np.float32]
    front: FrontSide
    amount: float
    hinted: bool = False


def pack_overlaps(overlaps: Sequence[Overlap]) -> NDArray[np.float32]:
    """All of them as one array: a row (number, x, y, front, amount, hinted) for each point."""
    rows = [
        np.column_stack(
            [
                np.full(len(overlap.points), number),
                overlap.points,
                np.full(
                    (len(overlap.points), 3),
                    (_FRONTS.index(overlap.front), overlap.amount, overlap.hinted),
                ),
            ]
        )
        for number, overlap in enumerate(overlaps)
    ]
    packed: NDArray[np.float32] = np.concatenate([np.zeros((0, 6)), *rows]).astype(np.float32)
    return packed


def unpack_overlaps(rows: NDArray[np.float32]) -> tuple[Overlap, ...]:
    """The overlaps of ``pack_overlaps``."""
    parts = np.split(rows, np.flatnonzero(np.diff(rows[:, 0])) + 1) if len(rows) else []
    return tuple(
        Overlap(part[:, 1:3], _FRONTS[int(part[0, 3])], float(part[0, 4]), bool(part[0, 5]))
        for part in parts
    )
