"""A line along which one part of a character is in front of another."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..choices import FrontSide


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
