"""The relief mesh: the figure's front surface, skirted and closed at the back."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Relief:
    """A closed triangle mesh in canvas pixels: x right, y down, z towards the viewer.

    Pixel (row, column) has its centre at ``(column + 0.5, row + 0.5)``.

    Attributes:
        vertices: (V, 3) float32.
        faces: (F, 3) int32, counter-clockwise seen from outside in the right-handed frame
            (x, -y, z), so that the normals of the front point at the viewer.
    """

    vertices: NDArray[np.float32]
    faces: NDArray[np.int32]
