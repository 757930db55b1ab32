"""Lumo with its regions: normals of the outline mixed with those of every closed region."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from lampblack.normals.silhouette import lumo_normals

INK = 0.3
SMALLEST_SHARE = 0.004
WEIGHT = 0.35
"""Weight of the regions. Johnston leaves it to the artist; this is the best on validation."""


def lumo_mixed_normals(
    lines: NDArray[np.float32], mask: NDArray[np.bool_], weight: float = WEIGHT
) -> NDArray[np.float32]:
    """(H, W, 3) float32 normals of the (H, W) drawing; every region that ink encloses is
    inflated alone, and mixed with the whole character (Johnston 2002, sections 3 and 4).
    """
    whole = lumo_normals(mask)
    regions, count = ndimage.label(mask & (lines < INK))
    if count < 2:
        return whole
    sizes = np.bincount(regions.reshape(-1), minlength=count + 1)
    inflated = whole.copy()
    # Ink belongs to the region that is nearest.
    nearest = ndimage.distance_transform_edt(
        regions == 0, return_distances=False, return_indices=True
    )
    owner = np.where(mask, regions[tuple(nearest)], 0)
    for index, box in enumerate(ndimage.find_objects(owner), start=1):
        if box is None or sizes[index] < SMALLEST_SHARE * mask.sum():
            continue
        region = owner[box] == index
        inflated[box][region] = lumo_normals(region)[region]
    mixed = (1 - weight) * whole + weight * inflated
    mixed /= np.maximum(np.linalg.norm(mixed, axis=2, keepdims=True), 1e-6)
    result: NDArray[np.float32] = (mixed * mask[..., None]).astype(np.float32)
    return result
