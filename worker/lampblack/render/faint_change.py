"""Noise of the floor's light, where the character hardly changes it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

UNSEEN = 0.01
"""Smaller changes are residual noise: paper far from the character stays as drawn."""
FAINT, PLAIN = 0.04, 0.08
"""Changes below the first are smoothed, those above the second stay as they are."""
WIDTH = 0.035
"""Deviation of the smoothing, as a share of the longer side."""

Floats = NDArray[np.float32]


def without_blotches(change: Floats) -> Floats:
    """Smooth what is too faint to be a shadow.

    The ambient light that a character takes from far paper changes slowly, by a few hundredths, and
    the denoiser leaves blotches in it. Faint changes are averaged among themselves, so that nothing
    leaks out of a shadow.

    Args:
        change: (h, w, 3) the floor's light with the character over that without it, less 1.

    Returns:
        the same, and 0 where it cannot be seen.
    """
    strength = np.abs(change).max(axis=2, keepdims=True)
    faint = np.clip((PLAIN - strength) / (PLAIN - FAINT), 0, 1).astype(np.float32)
    deviation = WIDTH * max(change.shape)
    sums, weight = (
        ndimage.gaussian_filter(plane, (deviation, deviation, 0), truncate=2, mode="nearest")
        for plane in (faint * change, faint)
    )
    smooth = change + faint * (sums / np.maximum(weight, 1e-3) - change)
    return np.asarray(smooth - np.clip(smooth, -UNSEEN, UNSEEN), np.float32)
