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
from .layers import separate
from .lines import line_drawing
from .load import MAX_PIXELS, MAX_SIDE
from .mask import ink_from_picture, mask_from_picture
from .palette import find_palette

_MARGIN = 8
_CLEAN = 2.0
"""Levels of grain above which a scan's flat colours are read from a blurred copy."""

Sample = TypeVar("Sample", bound=np.generic)


def decompose_drawing(
    pixels: NDArray[np.uint8],
    *,
    mask: NDArray[np.uint8] | None = None,
    ink: NDArray[np.uint8] | None = None,
) -> Drawing:
    """Take a picture apart into figure, line and fill.

    Line art is drawn on paper: inside its outline the coverage is 1 and the albedo white
    (or the paper's colour), also where the picture itself is transparent.

    Args:
        pixels: (H, W, 4) uint8, sRGB, straight alpha.
        mask: a picture of the same size and kind; white or opaque is the figure.
        ink: a picture of the same size and kind; dark or opaque is ink.

    Raises:
        DrawingError: nothing is drawn, the figure is a speck, or a picture does not fit.

    Warns:
        LampblackWarning: the background is not plain, or the art is painted.
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
    figure = replace(
        whole,
        colour=whole.colour[window],
        coverage=whole.coverage[window],
        mask=whole.mask[window],
    )
    if given is not None:
        given = np.where(figure.mask, given[window], np.float32(0)).astype(np.float32)
    lines = find_ink(figure) if given is None else given >= 0.5
    layers = separate(figure, lines, given)
    fill = layers.fill
    if figure.grain > _CLEAN:
        fill = ndimage.uniform_filter(fill, (5, 5, 0))
    palette, labels = find_palette(fill, figure.mask)
    drawn = line_drawing(layers.ink, fill, labels, figure.mask)

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


def _window(figure: Cutout) -> tuple[slice, slice]:
    """The box around the figure with a margin for what continues past its edge."""
    drawn = figure.coverage > 0
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
