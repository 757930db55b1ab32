"""Rasterisation of a mesh, orthographic: the nearest face at the centre of every pixel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..compiled import compiled

Floats = NDArray[np.float64]
Indices = NDArray[np.int32]


@dataclass(frozen=True)
class VisibleFaces:
    """For every pixel, row 0 at y = 0.

    Attributes:
        face: (H, W) int32, -1 where there is none.
        u, v: (H, W) float64, the weights of the face's second and third corner.
    """

    face: Indices
    u: Floats
    v: Floats


def visible_faces(
    vertices: NDArray[np.float32], faces: NDArray[np.integer[Any]], size: tuple[int, int]
) -> VisibleFaces:
    """Project (V, 3) ``vertices``, x and y in pixels, z to the viewer, onto (rows, columns).

    Both sides of a face are visible. Faces that share an edge leave no gap between them.
    """
    face = np.full(size, -1, np.int32)
    u, v = np.zeros(size), np.zeros(size)
    nearest = np.full(size, -np.inf)
    _rasterise(vertices[faces].astype(np.float64), face, u, v, nearest)
    return VisibleFaces(face, u, v)


@compiled
def _rasterise(corners: Floats, face: Indices, u: Floats, v: Floats, nearest: Floats) -> None:
    rows, columns = face.shape
    for index in range(len(corners)):
        a, b, c = corners[index]
        top = max(0, int(np.ceil(min(a[1], b[1], c[1]) - 0.5)))
        bottom = min(rows - 1, int(np.floor(max(a[1], b[1], c[1]) - 0.5)))
        left = max(0, int(np.ceil(min(a[0], b[0], c[0]) - 0.5)))
        right = min(columns - 1, int(np.floor(max(a[0], b[0], c[0]) - 0.5)))
        for row in range(top, bottom + 1):
            y = row + 0.5
            for column in range(left, right + 1):
                x = column + 0.5
                # Of one edge, the two faces beside it compute the same number with the other sign.
                in_a = (b[0] - x) * (c[1] - y) - (c[0] - x) * (b[1] - y)
                in_b = (c[0] - x) * (a[1] - y) - (a[0] - x) * (c[1] - y)
                in_c = (a[0] - x) * (b[1] - y) - (b[0] - x) * (a[1] - y)
                whole = in_a + in_b + in_c
                if whole == 0 or min(in_a, in_b, in_c) < 0 < max(in_a, in_b, in_c):
                    continue
                z = (in_a * a[2] + in_b * b[2] + in_c * c[2]) / whole
                if z > nearest[row, column]:
                    nearest[row, column] = z
                    face[row, column] = index
                    u[row, column], v[row, column] = in_b / whole, in_c / whole
