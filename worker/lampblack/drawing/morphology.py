"""Morphology: square windows, distances and nearest pixels.

scipy's filters and distance transform convert to doubles, several per pixel. These functions
keep the picture's own type and work in bands, so that a drawing of 4096 pixels fits in memory.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

Mask = NDArray[np.bool_]
Sample = TypeVar("Sample", bound=np.generic)

_BAND = 256


def highest(image: NDArray[Sample], reach: int) -> NDArray[Sample]:
    """The greatest value in the square of ``2 reach + 1`` pixels around each pixel.

    Args:
        image: (H, W), bool or not negative. Pixels beyond its edge count as 0.
    """
    return _highest_across(_highest_down(image, reach), reach)


def _highest_down(image: NDArray[Sample], reach: int) -> NDArray[Sample]:
    high, length, size = np.pad(image, ((reach, reach), (0, 0))), 1, 2 * reach + 1
    while length < size:
        step = min(length, size - length)
        high = np.maximum(high[:-step], high[step:])
        length += step
    return high


def _highest_across(image: NDArray[Sample], reach: int) -> NDArray[Sample]:
    high, length, size = np.pad(image, ((0, 0), (reach, reach))), 1, 2 * reach + 1
    while length < size:
        step = min(length, size - length)
        high = np.maximum(high[:, :-step], high[:, step:])
        length += step
    return high


def lowest(image: NDArray[Sample], reach: int) -> NDArray[Sample]:
    """The least value in the same square, for bool and unsigned images. Pixels beyond the edge
    count as the type's greatest value."""
    return np.asarray(np.invert(highest(np.invert(image), reach)))


def depth_within(area: Mask) -> NDArray[np.float32]:
    """Distance of each pixel of ``area`` to the nearest pixel outside it, 0 outside."""
    depth = np.zeros(area.shape, np.float32)
    if area.all():
        depth[:] = max(area.shape)
        return depth
    rows, columns = _nearest(~area)
    across = np.arange(area.shape[1], dtype=np.int32)
    for band in _bands(area):
        down = np.arange(band.start, band.stop, dtype=np.int32)[:, None]
        depth[band] = np.hypot(rows[band] - down, columns[band] - across, dtype=np.float32)
    return depth


def near(places: Mask, distance: float) -> Mask:
    """Pixels at most ``distance`` from one of ``places``."""
    return np.asarray(depth_within(~places) <= distance) if places.any() else places


def from_nearest(image: NDArray[Sample], places: Mask) -> NDArray[Sample]:
    """For every pixel the value of ``image`` at the nearest of ``places``."""
    taken = np.empty_like(image)
    rows, columns = _nearest(places)
    for band in _bands(places):
        taken[band] = image[rows[band], columns[band]]
    return taken


def regions_holding(area: Mask, seeds: Mask) -> Mask:
    """The connected regions of ``area`` that contain at least one of ``seeds``."""
    regions, count = ndimage.label(area, np.ones((3, 3)))
    chosen = np.zeros(count + 1, bool)
    chosen[regions[seeds]] = True
    chosen[0] = False
    return np.asarray(chosen[regions])


def without_specks(area: Mask, smallest: int) -> Mask:
    """The connected regions of ``area`` that have at least ``smallest`` pixels."""
    regions, count = ndimage.label(area, np.ones((3, 3)))
    keep = np.bincount(regions.ravel(), minlength=count + 1) >= smallest
    keep[0] = False
    return np.asarray(keep[regions])


def _nearest(places: Mask) -> NDArray[np.int32]:
    """Row and column of the nearest True pixel, for each pixel: (2, H, W)."""
    indices: NDArray[np.int32] = ndimage.distance_transform_edt(
        ~places, return_distances=False, return_indices=True
    )
    return indices


def _bands(image: NDArray[np.generic]) -> Iterator[slice]:
    for start in range(0, len(image), _BAND):
        yield slice(start, min(start + _BAND, len(image)))
