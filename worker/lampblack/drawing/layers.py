"""Separation of line and fill: how much ink covers each pixel, and the fill under it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .cutout import Colours, Cutout
from .ink import luma
from .morphology import Mask, from_nearest, highest, lowest, without_specks

_ALIKE = 4
"""Levels of luma between two pixels of the same fill."""


@dataclass(frozen=True)
class Layers:
    """``over(ink_colour x ink, albedo)`` is the cutout's colour inside its mask.

    Attributes:
        ink: (H, W) float32 in 0..1.
        ink_colour: (H, W, 3) float32 sRGB in 0..1.
        albedo: (H, W, 3) float32 sRGB in 0..1, continued under the ink and around the
            character.
        fill: (H, W, 3) uint8 sRGB, the albedo before it is adjusted to the rounding of mixed
            pixels: flat where the fill is flat.
    """

    ink: NDArray[np.float32]
    ink_colour: NDArray[np.float32]
    albedo: NDArray[np.float32]
    fill: Colours


def separate_layers(
    cutout: Cutout, lines: Mask, given: NDArray[np.float32] | None = None
) -> Layers:
    """Solve pixel = ink x ink_colour + (1 - ink) x albedo for all three.

    Pixels away from the line are fill, pixels in its middle are ink. The colour of a mixed
    pixel is projected onto the line from the nearest fill to the nearest ink. The remaining
    difference goes to the layer that covers more of the pixel, so that the layers always
    reproduce the drawing.

    Args:
        cutout: the character.
        lines: (H, W) bool, pixels that are at least about half ink.
        given: (H, W) float32, the ink's coverage if the artist painted it.
    """
    colour, mask = cutout.colour, cutout.mask
    touched = highest(lines, 2) & (cutout.coverage > 0)
    fill = _continue_fill(cutout, touched, lines)
    rows, columns = np.nonzero(touched if given is None else given > 0)
    pixel = colour[rows, columns].astype(np.float32) / 255.0
    under = fill[rows, columns].astype(np.float32) / 255.0
    over = _pure_ink(colour, lines)[rows, columns].astype(np.float32) / 255.0
    if given is None:
        share = _share(pixel, under, over)
        middle = lowest(lines, 1)
        share[middle[rows, columns]] = 1
        share[~mask[rows, columns] & lines[rows, columns]] = 1
    else:
        share = given[rows, columns]
    over, under = _absorb_remainder(pixel, share, over, under)

    ink = np.zeros(mask.shape, np.float32)
    ink[rows, columns] = share
    ink_colour = np.zeros((*mask.shape, 3), np.float32)
    ink_colour[rows, columns] = over
    albedo = np.multiply(fill, np.float32(1 / 255), dtype=np.float32)
    albedo[rows, columns] = under
    return Layers(ink, ink_colour, albedo, fill)


def _continue_fill(cutout: Cutout, touched: Mask, lines: Mask) -> Colours:
    """The fill's colours, continued from the nearest pixel without ink."""
    solid = cutout.mask & (cutout.coverage >= 0.99 * cutout.coverage.max())
    sure = solid & ~touched
    # Between two close lines every pixel is near ink. The lightest pixels there, if several
    # are alike, are fill.
    light = np.where(solid & ~lines, luma(cutout.colour), np.uint8(0))
    lightest = (light > 0) & (highest(light, 2) - light <= _ALIKE)
    sure |= lightest & without_specks(lightest, 3) & ~highest(sure, 2)
    if not sure.any():
        return np.full_like(cutout.colour, 255)
    carried = from_nearest(cutout.colour, sure)
    own = (cutout.coverage > 0.1) & ~touched
    carried[own] = cutout.colour[own]
    return carried


def _pure_ink(colour: Colours, lines: Mask) -> Colours:
    """For every pixel the nearest ink that covers fully: the darkest of its line."""
    if not lines.any():
        return colour
    light = np.where(lines, luma(colour), np.uint8(255))
    darkest = lines & (light <= lowest(light, 2))
    return from_nearest(colour, darkest)


Samples = NDArray[np.float32]


def _share(pixel: Samples, under: Samples, over: Samples) -> Samples:
    """The share of ink of each pixel between the fill under it and the ink over it."""
    way = over - under
    length = (way**2).sum(axis=1)
    share = ((pixel - under) * way).sum(axis=1) / np.maximum(length, 1e-4)
    share = np.clip(share, 0, 1)
    share[share < 0.02] = 0
    share[share > 0.98] = 1
    return np.asarray(share, np.float32)


def _absorb_remainder(
    pixel: Samples, share: Samples, over: Samples, under: Samples
) -> tuple[Samples, Samples]:
    """Adjust the layers where they miss ``pixel`` by more than rounding."""
    part = share[:, None]
    mostly_ink = part >= 0.5
    # Errors within rounding stay: solving for them would amplify them in the fill.
    missed = np.abs(part * over + (1 - part) * under - pixel).max(axis=1) > 1.2 / 255
    for first in (True, False):
        solved_over = np.clip((pixel - (1 - part) * under) / np.maximum(part, 1e-3), 0, 1)
        solved_under = np.clip((pixel - part * over) / np.maximum(1 - part, 1e-3), 0, 1)
        take_over = (mostly_ink == first) & (part > 0) & missed[:, None]
        take_under = (mostly_ink != first) & (part < 1) & missed[:, None]
        over = np.where(take_over, solved_over, over)
        under = np.where(take_under, solved_under, under)
    return over.astype(np.float32), under.astype(np.float32)
