"""Surfaces that give light: emissive colours of the character, and painted light."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..surface.relief import Relief

Floats = NDArray[np.float32]

OUTWARDS = 0.002
"""Distance of an emitter from the surface that it lies on, in default heights: a shadow ray to it
must not end in that surface."""


@dataclass(frozen=True, eq=False)
class Emitter:
    """A mesh that gives light on the side of its normals, and is not seen itself.

    Attributes:
        vertices: (V, 3) float32, canvas pixels.
        faces: (F, 3) int32.
        radiance: (V, 3) float32, scene-linear; 1 is that of a white surface which is fully lit.
    """

    vertices: Floats
    faces: NDArray[np.int32]
    radiance: Floats

    @property
    def arrays(self) -> tuple[Floats, NDArray[np.int32], Floats]:
        """What is sent to the renderer."""
        return self.vertices, self.faces, self.radiance


def glowing_parts(relief: Relief, radiance: Floats, unit: float) -> Emitter | None:
    """The faces of ``relief`` with a vertex of some ``radiance``, (V, 3), just above it; None if
    there are none.

    Args:
        unit: the default height of a light, canvas pixels.
    """
    faces = relief.faces[radiance.any(axis=1)[relief.faces].any(axis=1)]
    if not len(faces):
        return None
    used, corners = np.unique(faces, return_inverse=True)
    faces = corners.reshape(-1, 3).astype(np.int32)
    vertices = relief.vertices[used]
    outside = vertices + np.float32(OUTWARDS * unit) * _normals(vertices, faces)
    return Emitter(outside.astype(np.float32), faces, radiance[used].astype(np.float32))


def painted_plane(paint: Floats, size: tuple[int, int], height: float) -> Emitter | None:
    """A plane ``height`` canvas pixels above the paper that shines on it where ``paint`` does; None
    if it is dark.

    Args:
        paint: (h, w, 3) float32, radiance over a drawing of ``size`` (width, height).
    """
    lit = paint.any(axis=2)
    if not lit.any():
        return None
    rows, columns = lit.shape
    # Paint belongs to cells; a vertex at the centre of each, and one around the whole.
    padded = np.pad(paint, ((1, 1), (1, 1), (0, 0)))
    shining = np.pad(lit, 1)
    index = np.arange(shining.size).reshape(shining.shape)
    row, column = np.indices(shining.shape, np.float32)
    places = np.stack(
        [
            (column - 0.5) * np.float32(size[0] / columns),
            (row - 0.5) * np.float32(size[1] / rows),
            np.full_like(row, height),
        ],
        axis=2,
    ).reshape(-1, 3)
    a, b, c, d = (part.ravel() for part in (
        index[:-1, :-1], index[:-1, 1:], index[1:, :-1], index[1:, 1:]
    ))  # fmt: skip
    # y points down here, and up in the renderer: these face away from the viewer.
    faces = np.concatenate([np.stack([a, b, c], 1), np.stack([b, d, c], 1)])
    faces = faces[shining.ravel()[faces].any(axis=1)]
    used, corners = np.unique(faces, return_inverse=True)
    radiance = padded.reshape(-1, 3)[used]
    return Emitter(places[used], corners.reshape(-1, 3).astype(np.int32), radiance)


def _normals(vertices: Floats, faces: NDArray[np.int32]) -> Floats:
    """(V, 3), of length 1, outwards, in the frame of the vertices: y points down in it."""
    corners = vertices[faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(vertices)
    for corner in range(3):
        np.add.at(normals, faces[:, corner], -across)
    length = np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-9)
    return np.asarray(normals / length, np.float32)
