"""One picture in, one ``Drawing`` out."""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..errors import DrawingError
from .cutout import Cutout, cut_out
from .drawing import Drawing
from .ink import find_ink
from .layers import separate_layers
from .lines import line_drawing
from .load import MAX_PIXELS, MAX_SIDE
from .mask import ink_from_picture, mask_from_picture
from .palette import find_palette

_MARGIN = 8
_CLEAN = 2.0
"""Levels of paper grain above which the flat colours are read from a blurred copy."""

Sample = TypeVar("Sample", bound=np.generic)


def decompose_drawing(
    pixels: NDArray[np.uint8],
    *,
    mask: NDArray[np.uint8] | None = None,
    ink: NDArray[np.uint8] | None = None,
) -> Drawing:
    """Decompose a picture into character mask, ink and fill.

    Line art counts as drawn on paper: inside its outline the coverage is 1 and the albedo is
    white (or the paper's colour), even where the picture itself is transparent.

    Args:
        pixels: (H, W, 4) uint8, sRGB, straight alpha.
        mask: the artist's own character mask, same shape and type; white or opaque is inside.
        ink: the artist's own line, same shape and type; dark or opaque is ink.

    Raises:
        DrawingError: nothing is drawn, the character is too small, or a picture has another
            size.

    Warns:
        LampblackWarning: the background is not plain, or the art has very many colours.
    """
    if pixels.ndim != 3 or pixels.shape[2] != 4 or pixels.dtype != np.uint8:
        raise DrawingError("The picture is not 8-bit RGBA.", "Load it with load_picture.")
    height, width = pixels.shape[:2]
    if not height or not width or max(height, width) > MAX_SIDE or height * width > MAX_PIXELS:
        raise DrawingError(f"A picture of {width} x {height} pixels cannot be used.")
    size = (width, height)
    inside = None if mask is None else mask_from_picture(mask, size)
    given = None if ink is None else ink_from_picture(ink, size)

    whole = cut_out(pixels, inside)
    window = _window(whole)
    cutout = replace(
        whole,
        colour=whole.colour[window],
        coverage=whole.coverage[window],
        mask=whole.mask[window],
    )
    if given is not None:
        given = np.where(cutout.mask, given[window], np.float32(0)).astype(np.float32)
    lines = find_ink(cutout) if given is None else given >= 0.5
    layers = separate_layers(cutout, lines, given)
    fill = layers.fill
    if cutout.grain > _CLEAN:
        fill = ndimage.uniform_filter(fill, (5, 5, 0))
    palette, labels = find_palette(fill, cutout.mask)
    drawn = line_drawing(layers.ink, fill, labels, cutout.mask)

    return Drawing(
        pixels=pixels,
        mask=whole.mask,
        coverage=whole.coverage,
        lines=_placed(drawn, window, whole.mask.shape),
        ink=_placed(layers.ink, window, whole.mask.shape),
        ink_colour=_placed(layers.ink_colour, window, whole.mask.shape),
        albedo=_placed(layers.albedo, window, whole.mask.shape),
        labels=_placed(labels, window, whole.mask.shape, -1),
        palette=palette,
    )


def _window(cutout: Cutout) -> tuple[slice, slice]:
    """The box around the character, with a margin for layers that continue past its edge."""
    drawn = cutout.coverage > 0
    rows = np.flatnonzero(drawn.any(axis=1))
    columns = np.flatnonzero(drawn.any(axis=0))
    top, left = max(0, rows[0] - _MARGIN), max(0, columns[0] - _MARGIN)
    bottom, right = rows[-1] + 1 + _MARGIN, columns[-1] + 1 + _MARGIN
    if (bottom - top) * (right - left) > 0.5 * drawn.size:
        return slice(None), slice(None)  # not worth a second copy of every layer
    return slice(top, bottom), slice(left, right)


def _placed(
    part: NDArray[Sample], window: tuple[slice, slice], size: tuple[int, ...], empty: int = 0
) -> NDArray[Sample]:
    if part.shape[:2] == size:
        return part
    whole = np.full((*size, *part.shape[2:]), empty, part.dtype)
    whole[window] = part
    return whole
