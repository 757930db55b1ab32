"""The line drawing from which the normals are predicted."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .cutout import Colours
from .morphology import Mask, highest, lowest, without_specks

_SHORTEST = 12
"""Borders of fewer pixels are flecks of an airbrush."""

_STRONG = 16
"""Levels by which two fills must differ for their border to count as a line."""


def line_drawing(
    ink: NDArray[np.float32], fill: Colours, labels: NDArray[np.int16], mask: Mask
) -> NDArray[np.float32]:
    """The ink; where none is drawn, the character's outline and the borders of its fills, two
    pixels wide.

    Args:
        ink: (H, W) float32 in 0..1.
        fill: (H, W, 3) uint8 sRGB.
        labels: (H, W) int16, the flat colour of each pixel, -1 outside.
        mask: (H, W) bool.

    Returns:
        (H, W) float32 in 0..1, 0 outside the mask.
    """
    borders = mask & ~lowest(mask, 2)
    borders |= _colour_borders(fill, labels)
    inked = highest(ink > 0.3, 3)
    lines = np.maximum(ink, without_specks(borders & ~inked, _SHORTEST))
    return np.where(mask, lines, np.float32(0)).astype(np.float32)


def _colour_borders(fill: Colours, labels: NDArray[np.int16]) -> Mask:
    """Both pixels at each change of label where the colour changes clearly too: the steps of a
    painted gradient are no borders."""
    found = np.zeros(labels.shape, bool)
    for swap in (False, True):
        kind = labels.T if swap else labels
        colour = fill.swapaxes(0, 1) if swap else fill
        border = found.T if swap else found
        change = kind[:, 1:] != kind[:, :-1]
        change[:, 1:-1] &= (
            np.abs(colour[:, 3:].astype(np.int16) - colour[:, :-3]).max(axis=2) >= _STRONG
        )
        change &= (kind[:, 1:] >= 0) & (kind[:, :-1] >= 0)
        border[:, 1:] |= change
        border[:, :-1] |= change
    return found
