"""Strokes of one flat colour: line or fill as a whole, at every slant."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .cutout import Colours
from .morphology import Mask, depth_within

Place = tuple[slice, ...]

_MOST_COLOURS = 32
_LONG = 4.0
"""Length of the shortest stroke, in its own widths."""
_EVEN = 1.5
"""Deepest pixel of a stroke, as a multiple of half its width."""


def whole_strokes(lines: Mask, colour: Colours, area: Mask, widest: float) -> Mask:
    """``lines``, with every stroke of one flat colour either in it or not.

    The windows that find lines are square, so a stroke whose width is near their limit is found
    where it is slanted and missed where it is level. Such a stroke is measured as a whole: it is
    line up to a width of ``widest`` pixels.

    Args:
        lines: (H, W) bool, pixels that are line.
        colour: (H, W, 3) uint8 sRGB.
        area: (H, W) bool, pixels that may belong to strokes.
    """
    keys = colour.astype(np.int32) @ np.array([65536, 256, 1], np.int32)
    found = lines.copy()
    drawn, counts = np.unique(keys[lines], return_counts=True)
    common = drawn[counts >= widest]
    for key in common[np.argsort(-counts[counts >= widest])][:_MOST_COLOURS]:
        alike = area & (keys == key)
        if not (alike & ~lines).any():
            continue
        box = _around(alike)
        for place, stroke in _split_regions(alike[box], lines[box], widest):
            width = stroke_width(stroke)
            if width is None:
                continue
            found[box][place] |= stroke
            if width > widest:
                found[box][place] &= ~_with_edge(stroke)
    return found


def _around(mask: Mask) -> Place:
    """The box of ``mask``, with room for a stroke's soft edge."""
    rows, columns = (np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
    return tuple(slice(max(0, int(k[0]) - 3), int(k[-1]) + 4) for k in (rows, columns))


def _split_regions(alike: Mask, lines: Mask, least: float) -> Iterator[tuple[Place, Mask]]:
    """The regions of ``alike``, of at least so many pixels, that are line in part only: a place
    around each, and its mask there."""
    regions, count = ndimage.label(alike, np.ones((3, 3)))
    inked = np.bincount(regions[lines], minlength=count + 1)
    size = np.bincount(regions.ravel(), minlength=count + 1)
    split = (inked > 0) & (inked < size) & (size >= least)
    split[0] = False
    boxes = ndimage.find_objects(regions)
    for number in np.flatnonzero(split):
        place = tuple(slice(max(0, side.start - 3), side.stop + 3) for side in boxes[number - 1])
        yield place, regions[place] == number


def stroke_width(region: NDArray[np.bool_]) -> float | None:
    """Width in pixels of a long region of even width, its soft edge included; None for another."""
    depth = depth_within(np.pad(region, 1))[1:-1, 1:-1]
    inner = depth[region]
    # The mean distance to the edge of a strip is a quarter of its width, whatever its slant;
    # distances are to the middle of the nearest pixel outside, half a pixel too far.
    width = 4 * float(inner.mean()) - 2
    if width <= 0 or len(inner) < _LONG * width**2 or inner.max() - 0.5 > _EVEN * (width / 2 + 0.5):
        return None
    return width + 1


def _with_edge(stroke: Mask) -> Mask:
    """``stroke`` with its soft edge, two pixels wide."""
    return np.asarray(ndimage.binary_dilation(stroke, np.ones((3, 3)), iterations=2))
