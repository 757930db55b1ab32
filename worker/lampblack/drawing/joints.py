"""Joints: where a body's outline was left open, because it grows out of what is below it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .drawing import Drawing
from .mask import character_span
from .morphology import depth_within, highest, lowest, without_specks

INK = 0.3
"""Ink of at least this coverage closes an outline."""
BESIDE = 0.006
"""Ink lies within this share of the body's diagonal of the outline that it closes."""
MOSTLY = 0.5
"""A body whose outline is open along more than this share is drawn without ink, not open."""
SHORTEST = 0.25
"""A shorter opening is a gap in the ink; share of the body's width."""


def body_width(drawing: Drawing) -> float:
    """Width of a body at its widest place, in pixels."""
    return 2 * float(depth_within(drawing.mask).max())


def joint_of(drawing: Drawing) -> NDArray[np.float32]:
    """(H, W) float32 in 0..1: 1 at openings of the outline, falling to 0 over a body's width."""
    mask = drawing.mask
    rim = mask & ~lowest(mask, 1)
    reach = max(2, round(BESIDE * character_span(mask)))
    free = rim & ~highest(drawing.ink > INK, reach)
    none = np.zeros(mask.shape, np.float32)
    if np.count_nonzero(free) > MOSTLY * np.count_nonzero(rim):
        return none
    width = body_width(drawing)
    free = without_specks(free, max(4, round(SHORTEST * width)))
    if not free.any():
        return none
    share = np.clip(1 - depth_within(~free) / width, 0, 1)
    smooth: NDArray[np.float32] = (share * share * (3 - 2 * share)).astype(np.float32)
    return np.where(mask, smooth, np.float32(0))
