"""Surfaces of known shape, straight for the renderer."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lampblack.render.request import Surface
from lampblack.surface.relief import Relief

Heights = NDArray[np.float64]


def height_relief(height: Heights, mask: NDArray[np.bool_]) -> Relief:
    """A vertex at the centre of each masked pixel, closed by a mirrored, flattened back."""
    rows, columns = mask.shape
    row, column = np.mgrid[:rows, :columns]
    front = np.stack([column + 0.5, row + 0.5, height], axis=2).reshape(-1, 3)
    back = front * (1, 1, 0) - (0, 0, 1)
    index = np.arange(mask.size).reshape(mask.shape)
    whole = mask[:-1, :-1] & mask[1:, :-1] & mask[:-1, 1:] & mask[1:, 1:]
    a, b, c, d = (
        index[:-1, :-1][whole], index[:-1, 1:][whole], index[1:, :-1][whole], index[1:, 1:][whole]
    )  # fmt: skip
    faces = np.concatenate([np.stack([a, c, b], 1), np.stack([b, c, d], 1)])
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    forth, back_again = edges @ (mask.size, 1), edges[:, ::-1] @ (mask.size, 1)
    rim = edges[~np.isin(forth, back_again)]
    p, q = rim.T
    side = np.concatenate(
        [np.stack([q, p, p + mask.size], 1), np.stack([q, p + mask.size, q + mask.size], 1)]
    )
    faces = np.concatenate([faces, faces[:, ::-1] + mask.size, side])
    used, faces = np.unique(faces, return_inverse=True)
    vertices = np.concatenate([front, back])[used]
    return Relief(vertices.astype(np.float32), faces.reshape(-1, 3).astype(np.int32))


def surface(relief: Relief, albedo: float = 0.8, gloss: float = 0) -> Surface:
    count = len(relief.vertices)
    return Surface(
        relief,
        np.full((count, 3), albedo, np.float32),
        np.full(count, gloss, np.float32),
        np.full(count, 0.2, np.float32),
    )


def plane(width: int, height: int) -> Surface:
    shape = height, width
    return surface(height_relief(np.zeros(shape), np.ones(shape, bool)))


def ball(width: int, height: int, at: tuple[float, float], radius: float, **look: float) -> Surface:
    row, column = np.mgrid[:height, :width] + 0.5
    inside = 1 - ((column - at[0]) ** 2 + (row - at[1]) ** 2) / radius**2
    dome = height_relief(radius * np.sqrt(np.maximum(inside, 0)), inside > 0)
    return surface(dome, **look)
