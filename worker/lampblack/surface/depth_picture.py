"""A height as a picture and as an array for other programs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .corrections import normals_of

CLAY = 0.45
"""Share of the brightness that a clay picture's light gives."""
_LIGHT = np.array([-0.48, 0.48, 0.73], np.float32)


def depth_picture(height: NDArray[np.float32], mask: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """(H, W, 4) uint8: grey, nearer is brighter, opaque in the character.

    Args:
        height: (H, W) float32 pixels towards the viewer. mask: (H, W) bool.
    """
    low, high = (float(height[mask].min()), float(height[mask].max())) if mask.any() else (0, 0)
    grey = np.clip((height - low) / max(high - low, 1e-6), 0, 1) * 255 * mask
    return np.dstack([*[np.rint(grey)] * 3, mask * 255]).astype(np.uint8)


def clay_picture(
    height: NDArray[np.float32], mask: NDArray[np.bool_], scale: float
) -> NDArray[np.uint8]:
    """The same, shaded as clay under a light from the upper left: small bumps are seen too.

    Args:
        scale: pixels of the drawing in one element of ``height``.
    """
    picture = depth_picture(height, mask)
    shade = np.clip(normals_of(height / np.float32(scale), mask) @ _LIGHT, 0, 1)
    picture[..., :3] = np.rint(picture[..., :3] * (1 - CLAY + CLAY * shade)[..., None])
    return picture


def full_size(
    height: NDArray[np.float32], mask: NDArray[np.bool_], size: tuple[int, int]
) -> NDArray[np.float32]:
    """(H, W) float32 for a drawing of ``size`` (width, height): NaN outside the character.

    A large drawing has a smaller surface, whose pixels are repeated.

    Args:
        height: (h, w) float32, pixels of the drawing towards the viewer. mask: (h, w) bool.
    """
    found = np.where(mask, height, np.float32(np.nan))
    step = max(1, -(-size[0] // height.shape[1]), -(-size[1] // height.shape[0]))
    if step > 1:
        found = found.repeat(step, axis=0).repeat(step, axis=1)
    whole = np.full((size[1], size[0]), np.nan, np.float32)
    rows, columns = (min(a, b) for a, b in zip(whole.shape, found.shape, strict=True))
    whole[:rows, :columns] = found[:rows, :columns]
    return whole
