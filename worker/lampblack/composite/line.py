"""The artist's line in the light."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..colour import linear, srgb
from ..drawing.drawing import Drawing

DARK_INK, PALE_INK = 0.15, 0.35
"""Luma up to which a line stays as drawn, and from which it takes light as the fill does."""
OWN_COLOUR = 0.2
"""Share of the lit fill's colour in a line that takes light."""

Floats = NDArray[np.float32]


def lit_line(
    drawing: Drawing, light: Floats | None, fill: Floats, diffuse: NDArray[np.bool_], takes: float
) -> Floats:
    """The colour of the line, sRGB (H, W, 3).

    A pale line is shaded as the fill is; it would glow in the shade otherwise. A dark one stays as
    drawn, unless the line takes light: then it is shaded too, and the lit fill colours it.

    Args:
        light: (H, W, 3) the diffuse light; None is the light that shows everything as drawn.
        fill: (H, W, 3) scene-linear, the lit fill.
        diffuse: (H, W) where the fill is lit.
        takes: how far the line takes light, 0 to 1.
    """
    if light is None:
        return drawing.ink_colour
    shaded = np.maximum(paleness(drawing.ink_colour), np.float32(takes)) * (drawing.ink > 0)
    inked = diffuse & (shaded > 0)
    if not inked.any():
        return drawing.ink_colour
    line = drawing.ink_colour.copy()
    own = linear(line[inked]) * (1 + shaded[inked, None] * (np.minimum(light[inked], 1) - 1))
    own += np.float32(takes * OWN_COLOUR) * fill[inked]
    line[inked] = srgb(np.minimum(own, 1))
    return line


def paleness(ink_colour: Floats) -> Floats:
    """(...) how far a line of this colour, (..., 3) sRGB, takes light as the fill does, 0 to 1."""
    light = ink_colour @ np.array([0.299, 0.587, 0.114], np.float32)
    share = np.clip((light - DARK_INK) / (PALE_INK - DARK_INK), 0, 1)
    return np.asarray(share * share * (3 - 2 * share), np.float32)


def lay_ink(drawing: Drawing, line: Floats, fill: Floats) -> Floats:
    """The artist's line in the colour ``line`` composited over the fill, sRGB (H, W, 3)."""
    ink = drawing.ink[..., None]
    return (fill + ink * (line - fill)).astype(np.float32)
