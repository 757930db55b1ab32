"""How far each pixel is from the edge that a rim of light follows."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..drawing.morphology import Mask, depth_within, highest, near

REACH = 1 / 16
"""Largest distance that is told apart, as a share of the drawing's longer side."""
STEP = 0.012
"""Least step of the height between two pixels at an edge, as a share of the longer side."""
WIDEST_LINE = 0.04
"""Widest line along an edge, as a share of the longer side."""

Bytes = NDArray[np.uint8]
Floats = NDArray[np.float32]


def edge_distance(mask: Mask, ink: Floats, height: Floats | None = None) -> Bytes:
    """The distance to the character's silhouette, or to the edge of the part that the pixel is on
    where that part is in front of another.

    It is counted from the inner side of the line along the edge, so that a rim lies beside the
    outline, not under it. A part behind an edge is not near it.

    Args:
        mask: (H, W) bool, the character.
        ink: (H, W) float32 in 0..1.
        height: (H, W) float32 in pixels towards the viewer; None is a surface without steps.

    Returns:
        (H, W) uint8, 255 is ``reach_of(mask)`` pixels or more.
    """
    longest = max(mask.shape)
    line = (ink > 0.5) & mask
    reach = _line_width(line, WIDEST_LINE * longest)
    rim = ~mask | line & near(~mask, reach)
    distance = depth_within(~rim)
    if height is not None:
        drop = height - _lowest_beside(height, mask)
        front = mask & (drop > STEP * longest)
        if front.any():
            nearest = ndimage.distance_transform_edt(
                ~front, return_distances=False, return_indices=True
            )
            row, column = nearest
            ahead = mask & (height > height[row, column] - 0.5 * drop[row, column])
            start = ahead & (front | line & near(front, reach))
            distance = np.where(ahead, np.minimum(distance, depth_within(~start)), distance)
    smooth = ndimage.gaussian_filter(np.maximum(distance - 0.5, 0), 1.2)
    return np.asarray(np.rint(np.minimum(smooth * (255 / reach_of(mask.shape)), 255)), np.uint8)


def reach_of(shape: tuple[int, ...]) -> float:
    """The largest distance, in pixels of the drawing."""
    return max(8.0, REACH * max(shape[:2]))


def _lowest_beside(height: Floats, mask: Mask) -> Floats:
    """The lowest of the four neighbours inside the mask, (H, W)."""
    solid = np.pad(np.where(mask, height, np.float32(np.inf)), 1, constant_values=np.inf)
    sides = solid[:-2, 1:-1], solid[2:, 1:-1], solid[1:-1, :-2], solid[1:-1, 2:]
    return np.asarray(np.minimum.reduce([*sides, np.where(mask, height, 0)]), np.float32)


def _line_width(line: Mask, most: float) -> float:
    """Usual width of the line in pixels, and a little more."""
    if not line.any():
        return 1.5
    depth = depth_within(np.pad(line, 1))[1:-1, 1:-1]
    ridge = depth[line & (depth >= highest(depth, 1))]
    return float(min(2 * float(np.median(ridge)) + 1.5, max(most, 2.0)))
