"""The artist's line: thin, dark valleys in the colour of the figure."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .cutout import Colours
from .mask import Mask, figure_span, is_line_art, regions_holding

_HAIRLINE = 0.005
_BRUSH = 0.02
"""Reach of the search for lines, as shares of the figure's diagonal: lines of any colour up
to twice the first wide, lines of the main ink up to twice the second."""

_SHALLOWEST = 22
"""How much darker than both its sides a line must be, in levels of luma."""

_SAME_INK = 45
"""Levels a pixel may stray from the main ink and still be of it."""


def find_ink(colour: Colours, mask: Mask) -> Mask:
    """Where the figure is line rather than fill.

    Args:
        colour: (H, W, 3) uint8 sRGB.
        mask: (H, W) bool, the figure.

    A line is a valley of luma that a closing fills: narrow and darker than what lies on its
    sides. The colour most valleys share is the main ink; all that wears it is line, even
    where there is fill on one side only or none (outlines, whiskers), except areas wider
    than the drawing's own lines: those are filled blacks.

    Returns:
        (H, W) bool; nowhere True when the drawing has fewer lines than would go a quarter
        of the way around it; the whole figure when it is bare line that encloses nothing.
    """
    span = figure_span(mask)
    light = luma(colour)
    hairline = max(2, round(_HAIRLINE * span))
    brush = max(4, round(_BRUSH * span))
    lines = _valleys(light, mask, hairline)
    main = _main_ink(colour, _valleys(light, mask, brush) | lines)
    if main is not None:
        alike = mask & (np.abs(colour.astype(np.int16) - main).max(axis=2) <= _SAME_INK)
        lines = _without_specks(lines & ~alike | alike & ~_wide_parts(alike, brush), 8)
        lines = _without_specks(lines, 2 * hairline) | regions_holding(lines, alike & lines)
    outline = np.count_nonzero(mask & ~ndimage.binary_erosion(mask))
    if _length(lines) > 0.25 * outline:
        return lines
    return mask.copy() if is_line_art(mask) else np.zeros_like(mask)


def luma(colour: Colours) -> NDArray[np.uint8]:
    """Rec. 601 luma of sRGB values, (H, W) uint8."""
    red, green, blue = (colour[..., i].astype(np.uint16) for i in range(3))
    return np.asarray((77 * red + 150 * green + 29 * blue) >> 8, np.uint8)


def _valleys(light: NDArray[np.uint8], mask: Mask, reach: int) -> Mask:
    """Pixels at least half as deep as the deepest of a valley up to ``2 reach`` wide.

    The closing looks at the figure only, so an outline counts by the fill on its one side.
    """
    size = 2 * reach + 1
    hill = ndimage.maximum_filter(np.where(mask, light, np.uint8(0)), size, mode="constant")
    hill = np.where(mask, hill, np.uint8(255))
    depth = ndimage.minimum_filter(hill, size, mode="constant", cval=255) - light
    depth[~mask] = 0
    deepest = ndimage.maximum_filter(depth, size)
    return np.asarray((depth >= _SHALLOWEST) & (depth >= deepest // 2))


def _main_ink(colour: Colours, lines: Mask) -> NDArray[np.int16] | None:
    """The most common colour in the middle of the lines."""
    middle = lines & ndimage.binary_erosion(lines, np.ones((2, 2)))
    drawn = colour[middle if middle.any() else lines].astype(np.int16)
    if not len(drawn):
        return None
    coarse = (drawn >> 4) @ np.array([256, 16, 1], np.int16)
    common = np.bincount(coarse, minlength=4096).argmax()
    return np.asarray(np.median(drawn[coarse == common], axis=0), np.int16)


def _wide_parts(area: Mask, widest: int) -> Mask:
    """The parts of ``area`` that a ball clearly wider than most of its lines can roll in."""
    depth = ndimage.distance_transform_edt(np.pad(area, 1))[1:-1, 1:-1]
    ridge = depth[area & (depth >= ndimage.maximum_filter(depth, 3))]
    if not len(ridge):
        return np.zeros_like(area)
    usual = float(np.median(ridge))
    radius = min(max(2.5, 1.6 * usual), widest)
    wide = depth > radius
    core = regions_holding(wide, depth > min(max(4.0, 2.8 * usual), widest))
    if not core.any():
        return core
    grown = ndimage.distance_transform_edt(~core) < radius + 2.5
    wide = area & grown
    # The ball does not reach into corners; what it leaves there is no line.
    rest = area & ~wide
    corners = rest & ~_without_specks(rest, round(4 * usual**2))
    return regions_holding(wide | corners, wide)


def _without_specks(lines: Mask, smallest: int) -> Mask:
    regions, count = ndimage.label(lines, np.ones((3, 3)))
    keep = np.bincount(regions.ravel(), minlength=count + 1) >= smallest
    keep[0] = False
    return np.asarray(keep[regions])


def _length(lines: Mask) -> float:
    """Length of the lines: half their boundary."""
    return np.count_nonzero(lines & ~ndimage.binary_erosion(lines)) / 2
