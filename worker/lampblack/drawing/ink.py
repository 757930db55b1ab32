"""The artist's line: thin, dark valleys of luma."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .coloured_strokes import whole_strokes
from .cutout import Colours, Cutout
from .mask import character_span, is_line_art
from .morphology import (
    Mask,
    depth_within,
    highest,
    lowest,
    near,
    regions_holding,
    without_specks,
)

_HAIRLINE = 0.005
_BRUSH = 0.02
"""Reach of the search for lines, as shares of the character's diagonal. Lines of any colour may
be twice the first wide, lines of the main ink twice the second."""

_WIDEST = 2.45
"""Width of the widest line of another colour than the main ink, in hairlines."""

_SHALLOWEST = 22
"""How much darker than both sides a line must be, in levels of luma."""

_SAME_INK = 45
"""Levels by which a pixel may differ from the main ink and still belong to it."""


_BLOT = 1.15
"""How much wider than the narrowest filled area a blot may be where lines meet."""
_MEETING, _OPEN = 3, 0.2
"""Number of lines that run into such a blot, and the share of its boundary where they do."""


def find_ink(cutout: Cutout) -> Mask:
    """Find the pixels of the character that are line, not fill.

    A line is a valley of luma that a morphological closing fills: it is narrow and darker
    than both sides. The most common colour of the valleys is the main ink. All pixels of that
    colour are line, even with fill on one side or none (outlines, whiskers), except areas
    wider than the drawing's own lines, which are filled with black. Blots where lines meet are line
    too. A stroke of another flat colour is line or fill as a whole. In line art every pixel
    darker than the bare paper is line, however faint or broken.

    Returns:
        (H, W) bool. Nowhere True if the lines are shorter than a quarter of the outline. The
        whole character if it consists of lines that enclose nothing.
    """
    colour, mask = cutout.colour, cutout.mask
    span = character_span(mask)
    light = luma(colour)
    hairline = max(2, round(_HAIRLINE * span))
    brush = max(4, round(_BRUSH * span))
    if cutout.bare is not None:
        paper = luma(cutout.bare)
        marks = _deep(np.where(mask, paper - np.minimum(light, paper), np.uint8(0)), hairline)
        return marks & ~_wide_parts(marks, brush)
    lines = _valleys(light, mask, hairline)
    main = _main_ink(colour, _valleys(light, mask, brush) | lines)
    if main is not None:
        alike = mask & _alike(colour, main)
        coloured = whole_strokes(lines & ~alike, colour, mask & ~alike, _WIDEST * hairline)
        lines = without_specks(coloured | alike & ~_wide_parts(alike, brush), 8)
        lines = without_specks(lines, 2 * hairline) | regions_holding(lines, alike & lines)
    outline = np.count_nonzero(mask & ~lowest(mask, 1))
    if _length(lines) > 0.25 * outline:
        return lines
    return mask.copy() if is_line_art(mask) else np.zeros_like(mask)


def luma(colour: Colours) -> NDArray[np.uint8]:
    """Rec. 601 luma of sRGB values, (H, W) uint8."""
    red, green, blue = (colour[..., i].astype(np.uint16) for i in range(3))
    return np.asarray((77 * red + 150 * green + 29 * blue) >> 8, np.uint8)


def _valleys(light: NDArray[np.uint8], mask: Mask, reach: int) -> Mask:
    """Pixels at least half as deep as the deepest of a valley up to ``2 reach`` wide.

    Only the character is closed, so an outline is compared with the fill on its one side.
    """
    hill = highest(np.where(mask, light, np.uint8(0)), reach)
    depth = lowest(np.where(mask, hill, np.uint8(255)), reach) - light
    depth[~mask] = 0
    return _deep(depth, reach)


def _deep(depth: NDArray[np.uint8], reach: int) -> Mask:
    """Pixels at least half as deep as the deepest within ``reach``."""
    return np.asarray((depth >= _SHALLOWEST) & (depth >= highest(depth, reach) // 2))


def _main_ink(colour: Colours, lines: Mask) -> NDArray[np.int16] | None:
    """(3,) the most common colour in the middle of the lines; None if there is none."""
    middle = lines & np.roll(lines, 1, 0) & np.roll(lines, 1, 1)
    drawn = colour[middle if middle.any() else lines].astype(np.int16)
    if not len(drawn):
        return None
    coarse = (drawn >> 4) @ np.array([256, 16, 1], np.int16)
    common = np.bincount(coarse, minlength=4096).argmax()
    return np.asarray(np.median(drawn[coarse == common], axis=0), np.int16)


def _alike(colour: Colours, main: NDArray[np.int16]) -> Mask:
    alike = np.ones(colour.shape[:2], bool)
    for channel in range(3):
        plane, level = colour[..., channel], int(main[channel])
        alike &= plane >= max(0, level - _SAME_INK)
        alike &= plane <= min(255, level + _SAME_INK)
    return alike


def _wide_parts(area: Mask, widest: int) -> Mask:
    """The parts of ``area`` that fit a disc clearly wider than most of its lines."""
    depth = depth_within(np.pad(area, 1))[1:-1, 1:-1]
    ridge = depth[area & (depth >= highest(depth, 1))]
    if not len(ridge):
        return np.zeros_like(area)
    usual = float(np.median(ridge))
    radius = min(max(2.5, 1.6 * usual), widest)
    wide = depth > radius
    least = min(max(4.0, 2.8 * usual), max(widest, 2.2 * usual))
    core = regions_holding(wide, depth > least)
    if not core.any():
        return core
    wide = area & near(core, radius + 2.5)
    # The disc does not fit into corners; what remains there is no line.
    rest = area & ~wide
    corners = rest & ~without_specks(rest, round(4 * usual**2))
    found = regions_holding(wide | corners, wide)
    return found & ~_joints(found, area & ~found, depth, _BLOT * least)


def _joints(wide: Mask, lines: Mask, depth: NDArray[np.float32], least: float) -> Mask:
    """Those of the ``wide`` regions, none of them deeper than ``least``, into which lines run from
    several sides: blots where lines meet."""
    regions, _ = ndimage.label(wide, np.ones((3, 3)))
    joints = np.zeros_like(wide)
    for number, box in enumerate(ndimage.find_objects(regions), 1):
        window = tuple(slice(max(0, side.start - 1), side.stop + 1) for side in box)
        region = regions[window] == number
        if depth[window][region].max() > least:
            continue
        shore = highest(region, 1) & ~region
        mouths = shore & lines[window]
        _, count = ndimage.label(mouths, np.ones((3, 3)))
        if count >= _MEETING and np.count_nonzero(mouths) > _OPEN * np.count_nonzero(shore):
            joints[window] |= region
    return joints


def _length(lines: Mask) -> float:
    """Length of the lines: half their boundary."""
    return np.count_nonzero(lines & ~lowest(lines, 1)) / 2
