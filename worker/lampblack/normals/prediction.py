"""What a network says of a drawing: normals, and what lies in front of what."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .character import bounding_box
from .resize import resize

ORDER_PX = 320
"""Longest side at which depth and edges are kept; the network predicts them on fewer cells."""


@dataclass(frozen=True, eq=False)
class Prediction:
    """The prediction for one drawing.

    Attributes:
        normals: (H, W, 3) float32, x right, y up, z to the viewer; unit in the mask, 0 outside.
        depth: (H, W) float32 pixels of the drawing towards the viewer, about 0 on average, 0
            outside the mask. It is blurred, so it holds no slopes, but it tells the two sides of
            an occlusion apart. None: the network predicts none.
        edge: (H, W) float32, 0 to 1: how likely the pixel lies at an occlusion, on either side
            of it; 0 outside the mask. None where ``depth`` is.
        votes: (H, W, 2) float32 x right, y up: near an overlap, the direction to the side in
            front; its length is the share of this and the neighbouring drawings that show the
            overlap. None: there are no neighbours.
    """

    normals: NDArray[np.float32]
    depth: NDArray[np.float32] | None = None
    edge: NDArray[np.float32] | None = None
    votes: NDArray[np.float32] | None = None


def pack_order(prediction: Prediction, mask: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Depth and edge of the character's box, (h, w, 2) float32 of at most ``ORDER_PX``; (0, 0, 2)
    where there are none."""
    if prediction.depth is None or prediction.edge is None or not mask.any():
        return np.zeros((0, 0, 2), np.float32)
    box = bounding_box(mask)
    planes = np.dstack([prediction.depth[box], prediction.edge[box]])
    scale = min(1.0, ORDER_PX / max(planes.shape))
    return resize(planes, tuple(max(1, round(side * scale)) for side in planes.shape[:2]))


def unpack_order(
    normals: NDArray[np.float32], packed: NDArray[np.float32], mask: NDArray[np.bool_]
) -> Prediction:
    """The prediction of ``normals`` with depth and edge from ``pack_order``."""
    if not packed.size:
        return Prediction(normals)
    box = bounding_box(mask)
    planes = resize(packed, mask[box].shape) * mask[box][..., None]
    depth, edge = np.zeros(mask.shape, np.float32), np.zeros(mask.shape, np.float32)
    depth[box], edge[box] = planes[..., 0], planes[..., 1]
    return Prediction(normals, depth, edge)
