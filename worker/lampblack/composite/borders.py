"""Anti-aliased borders between flat colours: a pixel that mixes two colours also mixes their
materials, so that borders between materials are not jagged."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..colour import hex_linear
from ..drawing.morphology import highest, lowest
from ..drawing.palette import Palette

_LEAST = 0.002
_ASTRAY = 0.05
"""Largest squared distance of a mixed colour from the line between its two colours, relative to
the squared length of that line."""

Labels = NDArray[np.int16]


def swatch_albedos(palette: Palette) -> NDArray[np.float32]:
    """(n + 1, 3) scene-linear colours by label; the last, for label -1, is black."""
    colours = [hex_linear(swatch.colour) for swatch in palette.swatches]
    return np.stack([*colours, np.zeros(3, np.float32)])


def mixed_labels(
    labels: Labels, albedo: NDArray[np.float32], palette: Palette, reach: int = 1
) -> tuple[Labels, NDArray[np.float32]]:
    """The second label of each pixel that mixes two flat colours, and its share of the pixel.

    Args:
        labels: (H, W) int16 index into ``palette.swatches``, -1 outside.
        albedo: (H, W, 3) scene-linear.
        reach: largest distance of a mixed pixel from the second colour, in pixels.

    Returns:
        (H, W) int16, the pixel's own label if it is not mixed; (H, W) float32 in 0..1.
    """
    other, share = labels.copy(), np.zeros(labels.shape, np.float32)
    counted = (labels + 1).astype(np.uint16)
    most = highest(counted, reach)
    least = lowest(np.where(counted == 0, np.uint16(65535), counted), reach)
    row, column = np.nonzero((counted > 0) & (least < most))
    if not len(row):
        return other, share
    swatches = swatch_albedos(palette)
    own, colour = labels[row, column], albedo[row, column]
    nearest = np.full(len(row), _ASTRAY, np.float32)
    for found in (most, least):
        mate = (found[row, column].astype(np.int32) - 1).astype(np.int16)
        apart = swatches[mate] - swatches[own]
        length = np.maximum(np.square(apart).sum(axis=1), 1e-6)
        away = colour - swatches[own]
        part = np.clip((away * apart).sum(axis=1) / length, 0, 1)
        astray = np.square(away - part[:, None] * apart).sum(axis=1) / length
        better = (mate != own) & (part > _LEAST) & (astray < nearest)
        nearest = np.where(better, astray, nearest)
        other[row[better], column[better]] = mate[better]
        share[row[better], column[better]] = part[better]
    return other, share
