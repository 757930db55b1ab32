"""Fast guided filter (He and Sun, 2015) of the height map, as in the paper.

The guide is the height together with the pixel's position. With the height alone, the filter
would flatten every slope and pull rims inwards. With the position in the local linear model, a
window is smoothed towards its best plane: slopes and rims keep their place, and only departures
from the plane smaller than ``detail`` are smoothed. A guide of nz would blur a ridge between
two slopes of equal nz; the height does not.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

Floats = NDArray[np.float64]


def guided_filter(
    height: NDArray[np.float32],
    mask: NDArray[np.bool_],
    *,
    radius: int = 4,
    detail: float = 0.2,
    subsample: int = 2,
) -> NDArray[np.float32]:
    """Smooth ``height`` where it departs from a plane by less than about ``detail``.

    Pixels outside the mask do not count: a window is averaged over its pixels in the mask.

    Args:
        height: (H, W) float32, pixels towards the viewer.
        mask: (H, W) bool, True inside the character.
        radius: of the square window, in pixels.
        detail: pixels of height; its square is the filter's regularisation.
        subsample: local models are fitted on every ``subsample``-th row and column.

    Returns:
        (H, W) float32, 0 outside the mask.
    """
    z = height[::subsample, ::subsample].astype(np.float64)
    weight = mask[::subsample, ::subsample].astype(np.float64)
    size = 2 * max(round(radius / subsample), 1) + 1
    places = (np.arange(count) * float(subsample) for count in z.shape)
    row, column = np.meshgrid(*places, indexing="ij")
    share = ndimage.uniform_filter(weight, size, mode="constant")
    norm = weight / np.maximum(share, 1e-9)

    def mean(values: Floats) -> Floats:
        return np.asarray(ndimage.uniform_filter(values * weight, size, mode="constant") * norm)

    mean_row, mean_column, mean_z = mean(row), mean(column), mean(z)
    row_row = mean(row * row) - mean_row**2 + 1e-3
    column_column = mean(column * column) - mean_column**2 + 1e-3
    row_column = mean(row * column) - mean_row * mean_column
    row_z = mean(row * z) - mean_row * mean_z
    column_z = mean(column * z) - mean_column * mean_z
    determinant = row_row * column_column - row_column**2
    slope_row = (column_column * row_z - row_column * column_z) / determinant
    slope_column = (row_row * column_z - row_column * row_z) / determinant
    off_plane = mean(z * z) - mean_z**2 - slope_row * row_z - slope_column * column_z
    keep = np.maximum(off_plane, 0)
    keep /= keep + detail**2
    plane = 1 - keep
    level = mean_z - slope_row * mean_row - slope_column * mean_column

    at = np.argwhere(mask).T
    low = at / subsample

    def spread(values: Floats) -> Floats:
        fine = ndimage.map_coordinates(values * weight, low, order=1, mode="nearest")
        return np.asarray(fine / np.maximum(seen, 1e-9))

    seen = ndimage.map_coordinates(weight, low, order=1, mode="nearest")
    here = height[mask].astype(np.float64)
    smooth = (
        spread(mean(keep)) * here
        + spread(mean(plane * slope_row)) * at[0]
        + spread(mean(plane * slope_column)) * at[1]
        + spread(mean(plane * level))
    )
    result = np.zeros(mask.shape, np.float32)
    result[mask] = np.where(seen > 1e-6, smooth, here)
    return result
