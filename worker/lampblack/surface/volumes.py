"""Corrections of the surface of flat colours: rounder or flatter, nearer or farther.

A colour stands on the membrane that the surface around it spans. How far it stands out from that is
multiplied, and it is moved as a whole. Towards its borders a correction fades away, so the surface
stays smooth there; where it is cut, or the character ends, a correction has all of its effect.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .cuts import Cuts
from .membrane import membrane, ramp

FADE = 0.006
"""A correction of volume is two thirds there this far from a border; share of the character's
length."""
SLOPE = 1.0
"""Greatest slope, about, by which a colour rises from its border to where it is nearer."""

Floats = NDArray[np.float32]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Volume:
    """The correction of a region, (H, W) bool: ``factor`` on how far it stands out, and ``nearer``
    pixels towards the viewer."""

    region: Mask
    factor: float = 1.0
    nearer: float = 0.0


def with_volumes(
    height: Floats, mask: Mask, cuts: Cuts, volumes: Sequence[Volume], length: float
) -> Floats:
    """``height``, (H, W) pixels, with all corrections; all of them start from ``height``.

    What lies inside a region without being of it, such as the eyes in a face, moves with it.

    Args:
        mask: (H, W) bool. length: of the character, in pixels.
    """
    moved = np.zeros_like(height)
    for volume in volumes:
        moved += _moved(height, mask, cuts, volume, length)
    return height + moved


def _moved(height: Floats, mask: Mask, cuts: Cuts, volume: Volume, length: float) -> Floats:
    region = volume.region & mask
    if not region.any() or (volume.factor == 1 and volume.nearer == 0):
        return np.zeros_like(height)
    filled = ndimage.binary_fill_holes(region) & mask
    moved = np.zeros_like(height)
    if volume.factor != 1:
        base = membrane(height, filled, mask, cuts)
        share = _smooth(ramp(filled, mask, cuts, FADE * length))
        moved += np.float32(volume.factor - 1) * share * (height - base)
    if volume.nearer != 0:
        share = ramp(filled, mask, cuts, abs(volume.nearer) / SLOPE)
        # A narrow colour gets as near in its middle as a wide one.
        moved += np.float32(volume.nearer) * _smooth(share / max(float(share.max()), 1e-6))
    moved = np.where(region, moved, np.float32(0)).astype(np.float32)
    return membrane(moved, filled & ~region, filled, cuts)


def _smooth(share: Floats) -> Floats:
    """0 to 1 without a crease at either end."""
    return np.asarray(share * share * (3 - 2 * share), np.float32)
