"""Parts of filled, transparent art that the artist left without fill, but that are no holes: closed
shapes beside a filled figure, the whites of its eyes, and slivers that a bucket left along ink."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .mask import character_span, is_line_art
from .morphology import Mask, highest, lowest

SOLID = 0.98
"""Share of the picture's opacity from which a pixel shows nothing of what is behind it."""
SMALLEST = 12
"""Holes of fewer pixels are gaps between strokes."""
LARGEST = 0.015
"""Largest share of the figure's area that the white of an eye takes."""
ROUND = 0.6
"""Least share of its box that the white of an eye fills: an ellipse fills 0.79, a wedge 0.5."""
AROUND = 0.02
"""Width of the rim around a hole that is looked at, as a share of the figure's diagonal."""
ONE_COLOUR = 0.75
"""Least share of one colour in the fill around the white of an eye."""

Pixels = NDArray[np.uint8]


def slivers(alpha: Pixels) -> Mask:
    """Translucent gaps up to two pixels wide between opaque paint.

    Args:
        alpha: (H, W) uint8.
    """
    clear = alpha < SOLID * int(alpha.max())
    wide = highest(lowest(np.pad(clear, 2, constant_values=True), 1), 2)[2:-2, 2:-2]
    return np.asarray(clear & ~wide)


def unfilled(pixels: Pixels, drawn: Mask) -> Mask:
    """The enclosed empty areas that belong to the character, with the soft edge of their line.

    An area is part of it if only lines enclose it; if something is drawn inside it, such as a
    pupil; or if it is small and round, outlined, and amid fill of one colour. Other holes, such as
    that between an arm and the body, stay holes.

    Args:
        pixels: (H, W, 4) uint8, sRGB, straight alpha.
        drawn: (H, W) bool.
    """
    empty = np.pad(~drawn, 1, constant_values=True)
    areas, count = ndimage.label(empty)
    outside = (areas == areas[0, 0])[1:-1, 1:-1]
    areas = areas[1:-1, 1:-1]
    found = np.zeros_like(drawn)
    if count < 2:
        return found
    solid = ~outside
    parts, _ = ndimage.label(solid, np.ones((3, 3)))
    part_boxes = ndimage.find_objects(parts)
    lines: dict[int, bool] = {}
    for number, box in enumerate(ndimage.find_objects(areas), 1):
        if box is None or number == areas[outside][0]:
            continue
        hole = areas[box] == number
        area = np.count_nonzero(hole)
        if area < SMALLEST:
            continue
        part = int(parts[box][hole][0])
        window = part_boxes[part - 1]
        if part not in lines:
            inside = drawn[window] & (parts[window] == part)
            lines[part] = is_line_art(inside)
        figure = int(np.count_nonzero(parts[window] == part))
        if lines[part] or _holds_more(hole) or _is_eye(pixels, drawn, box, hole, figure):
            found[box] |= hole
    rim = highest(found, 2) & ~highest(outside, 1) if found.any() else found
    return np.asarray(found | rim & (pixels[..., 3] < 255))


def _holds_more(hole: Mask) -> bool:
    """Whether something is drawn inside the hole."""
    within = ndimage.binary_fill_holes(hole) & ~hole
    return bool(np.count_nonzero(within) >= SMALLEST)


def _is_eye(pixels: Pixels, drawn: Mask, box: tuple[slice, slice], hole: Mask, figure: int) -> bool:
    height, width = hole.shape
    round_ = np.count_nonzero(hole) >= ROUND * hole.size and max(hole.shape) < 2.5 * min(hole.shape)
    if not round_ or np.count_nonzero(hole) > LARGEST * figure:
        return False
    reach = max(4, round(AROUND * character_span(drawn)))
    top, left = max(0, box[0].start - reach), max(0, box[1].start - reach)
    window = slice(top, box[0].stop + reach), slice(left, box[1].stop + reach)
    near = np.zeros_like(drawn[window])
    row, column = box[0].start - top, box[1].start - left
    near[row : row + height, column : column + width] = hole
    rim = highest(near, reach) & ~near
    if np.count_nonzero(drawn[window][rim]) < 0.95 * np.count_nonzero(rim):
        return False
    light = pixels[window][..., :3] @ np.array([0.299, 0.587, 0.114])
    line, fill = light[highest(near, 2) & rim], rim & ~highest(near, max(2, reach // 2))
    paint = pixels[window][fill][:, :3]
    if not len(paint) or np.median(line) > np.median(light[fill]) - 22:
        return False
    shades = np.bincount((paint >> 5) @ np.array([64, 8, 1], np.int64))
    return bool(shades.max() >= ONE_COLOUR * len(paint))
