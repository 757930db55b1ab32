"""The character mask: which pixels belong to the character."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..errors import DrawingError
from .morphology import Mask, depth_within, highest, near, regions_holding

MIN_CHARACTER = 16
"""Fewer pixels than this are dust, not a character."""

_WIDEST_LINE = 0.018
_GAPS = (0.008, 0.012, 0.024)
"""Shares of the character's diagonal: half the widest line, and gaps in an outline."""


def mask_from_picture(picture: NDArray[np.uint8], size: tuple[int, int]) -> NDArray[np.float32]:
    """The character as the artist painted it: white or opaque is inside.

    Args:
        picture: (H, W, 4) uint8, sRGB, straight alpha.
        size: (width, height) of the drawing it belongs to.

    Returns:
        (H, W) float32 in 0..1.

    Raises:
        DrawingError: the mask has another size than the drawing, or nothing is inside.
    """
    inside = _painted(picture, size, "mask", white=True)
    if np.count_nonzero(inside >= 0.5) < MIN_CHARACTER:
        raise DrawingError(
            "The mask has nothing inside.", "Paint the character white, or opaque on transparency."
        )
    return inside


def ink_from_picture(picture: NDArray[np.uint8], size: tuple[int, int]) -> NDArray[np.float32]:
    """The ink as the artist painted it: dark or opaque is ink; see ``mask_from_picture``."""
    return _painted(picture, size, "ink", white=False)


def _painted(
    picture: NDArray[np.uint8], size: tuple[int, int], name: str, *, white: bool
) -> NDArray[np.float32]:
    height, width = picture.shape[:2]
    if (width, height) != size:
        raise DrawingError(
            f"The {name} picture is {width} x {height} pixels, "
            f"but the drawing is {size[0]} x {size[1]}.",
            "Export both at the same size.",
        )
    alpha = picture[..., 3].astype(np.float32) / 255.0
    if alpha.min() < 0.5:
        return alpha
    level: NDArray[np.float32] = picture[..., :3].mean(axis=2, dtype=np.float32) / 255.0
    return level if white else 1 - level


def is_line_art(drawn: Mask) -> bool:
    """Whether nearly all drawn pixels belong to thin lines, so that nothing is filled."""
    span = character_span(drawn)
    stride = max(1, int(span // 500))
    depth = depth_within(np.pad(drawn[::stride, ::stride], 1)) * stride
    deep = np.count_nonzero(depth > max(2.0, _WIDEST_LINE * span))
    return bool(deep < 0.1 * np.count_nonzero(depth))


def character_span(drawn: Mask) -> float:
    """Diagonal in pixels of the bounding box of ``drawn``: line widths are measured against it."""
    rows = np.flatnonzero(drawn.any(axis=1))
    columns = np.flatnonzero(drawn.any(axis=0))
    if not len(rows):
        return 0.0
    return float(np.hypot(rows[-1] - rows[0] + 1, columns[-1] - columns[0] + 1))


def outside_of(drawn: Mask, *, line_art: bool) -> Mask:
    """The background: all pixels connected to the border of the picture without crossing
    ``drawn``.

    Line art may have gaps in its outline. Its background is found by trapped-ball flooding
    (Zhang et al., "Vectorizing Cartoon Animations", TVCG 2009): a ball too large for the gaps
    floods the background; then narrow bays that the ball could not enter are added, unless
    they lead into a wider region. The edge lies exactly at the line. The smallest ball that
    encloses nearly as much as the largest is used. Line art cut by the picture's edge is
    closed there: only the parts of the edge next to a corner count as background.
    """
    if not line_art:
        return _reached(np.pad(~drawn, 1, constant_values=True))[1:-1, 1:-1]
    gaps = [max(1.0, share / 2 * character_span(drawn)) for share in _GAPS]
    margin = int(gaps[-1]) + 2
    empty = np.pad(_closed_at_edges(~drawn), margin - 1, constant_values=True)
    depth = depth_within(empty)
    widest = chosen = _rolled_around(empty, depth, gaps[-1])
    for gap in gaps[:-1]:
        outside = _rolled_around(empty, depth, gap)
        if np.count_nonzero(~outside) >= 0.9 * np.count_nonzero(~widest):
            chosen = outside
            break
    return np.asarray(chosen[margin:-margin, margin:-margin])


def _rolled_around(empty: Mask, depth: NDArray[np.float32], gap: float) -> Mask:
    """The area that a ball of radius ``gap`` reaches from outside, and its narrow bays."""
    outside = empty & near(_reached(depth > gap), gap)
    bays = empty & ~outside
    bays &= ~regions_holding(bays, depth > gap)
    outside |= regions_holding(bays, bays & highest(outside, 1))
    return np.asarray(outside)


def _closed_at_edges(empty: Mask) -> Mask:
    """``empty`` in a frame one pixel wide. The frame is open only next to the corners, up to
    where the first line leaves the picture."""
    framed = np.pad(empty, 1, constant_values=True)
    for side in range(4):
        edge = np.rot90(empty, side)[0]
        from_corner = np.logical_and.accumulate(edge)
        from_corner |= np.logical_and.accumulate(edge[::-1])[::-1]
        np.rot90(framed, side)[0, 1:-1] = from_corner
    return framed


def _reached(empty: Mask) -> Mask:
    """The connected part of ``empty`` that contains its corner."""
    regions, _ = ndimage.label(empty)
    return np.asarray(regions == regions[0, 0])
