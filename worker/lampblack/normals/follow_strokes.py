"""Surfaces that follow the artist's strokes also where the network does not."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .bend_strokes import BendStroke, cells_along

TILT = 0.2
"""How far normals lean to a stroke of a hollow, or away from one of a round part, at most."""
REACH = 1 / 64
"""Where they lean most: the distance from the stroke, as a share of the character's longer side.
Both are chosen on validation views: a wide, steep trench is worse than the error that it mends."""


def follow_strokes(
    normals: NDArray[np.float32], mask: NDArray[np.bool_], strokes: Sequence[BendStroke]
) -> None:
    """Lean the normals beside each stroke so that the surface is round or hollow there, as far as
    it is not yet.

    Args:
        normals: (H, W, 3) unit normals in ``mask``, changed in place: x right, y up, z to the
            viewer. mask: (H, W) bool. Both cropped to the character.
        strokes: in pixels of ``mask``.
    """
    size = max(mask.shape)
    reach = REACH * size
    for stroke in strokes:
        points = np.clip(stroke.points, -size, 2 * size).astype(float)  # bounds their number
        part = _around(points, mask.shape, 4 * reach)
        if not mask[part].any() or min(mask[part].shape) < 2:
            continue
        row, column = cells_along(points)
        row, column = row - part[0].start, column - part[1].start
        off = np.ones(mask[part].shape, bool)
        inside = (row >= 0) & (row < off.shape[0]) & (column >= 0) & (column < off.shape[1])
        off[row[inside], column[inside]] = False
        if off.all():
            continue
        distance, nearest = ndimage.distance_transform_edt(off, return_indices=True)
        down, right = nearest - np.indices(off.shape)
        vectors = normals[part]
        sigma = size / 128
        wrong = divergence(vectors, mask[part], sigma) * stroke.bend <= 0
        lean = TILT / reach * np.exp((1 - (distance / reach) ** 2) / 2) * mask[part]
        lean *= ndimage.gaussian_filter((wrong & mask[part]).astype(np.float32), sigma / 2)
        vectors[..., 0] -= stroke.bend * lean * right
        vectors[..., 1] += stroke.bend * lean * down
        vectors /= np.maximum(np.linalg.norm(vectors, axis=2, keepdims=True), 1e-12)


def divergence(
    normals: NDArray[np.float32], mask: NDArray[np.bool_], sigma: float
) -> NDArray[np.float32]:
    """(H, W) divergence of (H, W, 3) normals per pixel, after a blur of ``sigma`` pixels inside
    ``mask``: above 0 where the surface is round, below 0 where it is hollow."""
    share = ndimage.gaussian_filter(mask.astype(np.float32), sigma)[..., None]
    smooth = ndimage.gaussian_filter(normals[..., :2], (sigma, sigma, 0)) / np.maximum(share, 1e-3)
    slopes = np.gradient(smooth[..., 0], axis=1) - np.gradient(smooth[..., 1], axis=0)
    return np.asarray(slopes, np.float32)


def _around(
    points: NDArray[np.float64], size: tuple[int, ...], margin: float
) -> tuple[slice, slice]:
    """The part of a picture of ``size`` (rows, columns) that is ``margin`` or less from the box of
    (N, 2) ``points`` x, y."""
    low = np.floor(points.min(axis=0) - margin).astype(int)[::-1]
    high = np.ceil(points.max(axis=0) + margin).astype(int)[::-1] + 1
    rows, columns = (
        slice(int(np.clip(a, 0, n)), int(np.clip(b, 0, n)))
        for a, b, n in zip(low, high, size, strict=True)
    )
    return rows, columns
