"""Carries points of one drawing to another, with the motion of the character between them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .registration import Registration
from .sample import sampled
from .thumbnail import RegistrationThumbnail
from .window import Window

Points = NDArray[np.float32]

_LEAST_TRUST = 0.3
"""Mean trust of a stroke below which it is not carried: the drawings differ there."""


def carry_points(
    points: Points, here: RegistrationThumbnail, there: RegistrationThumbnail, seen: Registration
) -> Points | None:
    """Where ``points`` of the drawing ``here`` lie in the drawing ``there``.

    Args:
        points: (N, 2) float32, x right and y down, pixels of the drawing.
        seen: the registration of ``here`` with ``there``.

    Returns:
        (N, 2) float32 pixels of ``there``; None where the two drawings have too little in common.
    """
    cells = _cells(here.window, points)
    planes = np.concatenate([seen.places, seen.trust[None]])
    row, column, trust = sampled(planes, cells[:, None])[:, 0]
    if trust.mean() < _LEAST_TRUST:
        return None
    return _pixels(there.window, row, column)


def _cells(window: Window, points: Points) -> Points:
    """(2, N) rows and columns on the window's coarse grid."""
    at = (points[:, 1] - window.top, points[:, 0] - window.left)
    scale = [cells / size for cells, size in zip(window.coarse, window.size, strict=True)]
    cells = [a * s - 0.5 for a, s in zip(at, scale, strict=True)]
    return np.stack(cells, dtype=np.float32, casting="same_kind")


def _pixels(window: Window, row: Points, column: Points) -> Points:
    """(N, 2) x and y of the canvas."""
    scale = [size / cells for cells, size in zip(window.coarse, window.size, strict=True)]
    y, x = (row + 0.5) * scale[0] + window.top, (column + 0.5) * scale[1] + window.left
    return np.stack([x, y], axis=1, dtype=np.float32, casting="same_kind")
