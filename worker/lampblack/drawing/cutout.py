"""The character cut out of its paper: straight colour and coverage."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..errors import DrawingError, LampblackWarning, NothingDrawnError
from .mask import MIN_CHARACTER, is_line_art, outside_of
from .morphology import Mask, highest, lowest, without_specks
from .unfilled import slivers, unfilled

Colours = NDArray[np.uint8]

_DUST = 7
"""Isolated specks of fewer pixels are paper grain or dust."""


@dataclass(frozen=True)
class Cutout:
    """The character without its paper.

    Attributes:
        colour: (H, W, 3) uint8 sRGB, the character's own colour without the paper's.
        coverage: (H, W) float32 in 0..1.
        mask: (H, W) bool, True inside.
        grain: noise of the paper, in levels of 255; 0 for transparent art.
        bare: (3,) uint8 sRGB, the paper inside line art; None where fills are painted.
    """

    colour: Colours
    coverage: NDArray[np.float32]
    mask: Mask
    grain: float = 0.0
    bare: Colours | None = None


def cut_out(pixels: NDArray[np.uint8], inside: NDArray[np.float32] | None = None) -> Cutout:
    """Cut the character in ``pixels``, (H, W, 4) uint8, out of its background.

    A picture with transparency is cut by its alpha. Otherwise the colour of the picture's
    border is the paper, which is flooded inwards up to the character. Empty regions enclosed
    by line belong to the character and are filled with paper. Holes in filled, transparent
    art stay holes, except those of ``unfilled.py``. ``inside``, (H, W) in 0..1, overrides all of
    this.

    Raises:
        DrawingError: nothing is drawn, or fewer than ``MIN_CHARACTER`` pixels.
    """
    alpha = pixels[..., 3]
    top = int(alpha.max())
    if top == 0:
        raise NothingDrawnError(
            "The picture is fully transparent.", "Export the drawing with its ink."
        )
    if inside is not None:
        cutout = _by_override(pixels, inside)
    elif np.count_nonzero(alpha < 128) > 0.001 * alpha.size:
        cutout = _by_alpha(pixels, alpha >= max(top / 2, 1))
    else:
        cutout = _from_paper(_over_white(pixels))
    count = np.count_nonzero(cutout.mask)
    if count < MIN_CHARACTER:
        raise DrawingError(
            f"The character is only {count} pixels large." if count else "Nothing is drawn here.",
            "Draw or export the character larger.",
        )
    return cutout


def character_mask(pixels: NDArray[np.uint8]) -> Mask:
    """(H, W) bool, the character in ``pixels``; see ``cut_out``."""
    return cut_out(pixels).mask


def _by_override(pixels: NDArray[np.uint8], inside: NDArray[np.float32]) -> Cutout:
    return _cover_with_paper(pixels, inside >= 0.5, inside)


def _by_alpha(pixels: NDArray[np.uint8], drawn: Mask) -> Cutout:
    alpha = pixels[..., 3].astype(np.float32) / 255.0
    if is_line_art(drawn):
        cutout = _cover_with_paper(pixels, _enclosed(drawn), alpha)
        return replace(cutout, bare=np.full(3, 255, np.uint8))
    papered = slivers(pixels[..., 3]) | unfilled(pixels, drawn)
    if not papered.any():
        return Cutout(pixels[..., :3].copy(), alpha, drawn)
    colour = np.where(papered[..., None], _over_white(pixels), pixels[..., :3])
    return Cutout(colour, np.where(papered, np.float32(1), alpha), drawn | papered)


def _enclosed(drawn: Mask) -> Mask:
    """The lines and all that they enclose."""
    mask = ~outside_of(drawn, line_art=True)
    if MIN_CHARACTER <= np.count_nonzero(mask) < 1.5 * np.count_nonzero(drawn):
        warnings.warn(
            "The outline is not closed, so there is nothing inside the lines to light; "
            "close its gaps, or give a mask.",
            LampblackWarning,
            stacklevel=2,
        )
    return mask


def _cover_with_paper(pixels: NDArray[np.uint8], mask: Mask, edge: NDArray[np.float32]) -> Cutout:
    """Put white paper under ``mask``. Only its rim keeps the coverage ``edge``."""
    within = lowest(mask, 1)
    drawn = pixels[..., 3] >= 128
    hollow = within & ~drawn
    # Line thinner than two pixels has the rim on one side and the hollow on the other.
    covered = within | (mask & highest(hollow, 2) & ~drawn)
    colour = np.where(covered[..., None], _over_white(pixels), pixels[..., :3])
    return Cutout(colour, np.where(covered, np.float32(1), edge).astype(np.float32), mask)


def _over_white(pixels: NDArray[np.uint8]) -> Colours:
    if pixels[..., 3].min() == 255:
        return pixels[..., :3]
    alpha = pixels[..., 3:].astype(np.uint16)
    return ((pixels[..., :3] * alpha + 255 * (255 - alpha) + 127) // 255).astype(np.uint8)


def _from_paper(picture: Colours) -> Cutout:
    paper, grain = _paper_of(picture)
    tolerance = int(np.clip(8 + 2 * grain, 10, 48))
    difference = _difference(picture, paper)
    drawn = without_specks(difference > tolerance, _DUST)
    if not drawn.any():
        raise NothingDrawnError(
            "The picture is blank: nothing is drawn on it.",
            "Choose a picture with a drawing on it.",
        )
    line_art = is_line_art(drawn)
    mask = _enclosed(drawn) if line_art else ~outside_of(drawn, line_art=False)
    colour, coverage = _lift(picture, paper, ~mask, difference, tolerance)
    return Cutout(colour, coverage, coverage >= 0.5, grain, paper if line_art else None)


def _difference(picture: Colours, paper: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """(H, W) the largest difference of any channel from the paper, in levels."""
    stray = np.zeros(picture.shape[:2], np.uint8)
    for channel in range(3):
        plane, level = picture[..., channel], paper[channel]
        np.maximum(stray, np.maximum(plane, level) - np.minimum(plane, level), out=stray)
    return stray


def _paper_of(picture: Colours) -> tuple[NDArray[np.uint8], float]:
    """The lightest of the common colours of the border, and the noise around it in levels."""
    border = np.concatenate([picture[0], picture[-1], picture[1:-1, 0], picture[1:-1, -1]]).astype(
        np.int16
    )
    coarse = (border >> 5) @ np.array([64, 8, 1], np.int16)
    # Ink may reach the border too; paper is lighter than ink.
    counts = np.bincount(coarse, minlength=512)
    often = np.flatnonzero(counts >= max(0.15 * len(coarse), 1))
    lightness = (often >> 6) + (often >> 3 & 7) + (often & 7)
    common = often[lightness.argmax()] if len(often) else counts.argmax()
    paper = np.median(border[coarse == common], axis=0).astype(np.int16)
    stray = np.abs(border - paper).max(axis=1)
    near = stray[stray < 48]
    if len(near) < 0.5 * len(stray):
        warnings.warn(
            "The background is not plain paper, so the character may be cut out wrongly; "
            "give a mask, or export the drawing with transparency.",
            LampblackWarning,
            stacklevel=2,
        )
    return paper.astype(np.uint8), float(np.percentile(near, 98)) if len(near) else 0.0


def _lift(
    picture: Colours,
    paper: NDArray[np.uint8],
    outside: Mask,
    difference: NDArray[np.uint8],
    tolerance: int,
) -> tuple[Colours, NDArray[np.float32]]:
    """Solve pixel = coverage x colour + (1 - coverage) x paper along the character's rim.

    The colour is that of the nearby pixel that differs most from the paper.
    """
    edge = ~outside & highest(outside, 1)
    # Soft edges are two pixels deep: behind the edge the colour still grows away from paper.
    growing = difference > highest(np.where(edge, difference, 0), 1)
    behind = ~outside & ~edge & growing & highest(edge, 1)
    rim = edge | behind | (outside & highest(~outside, 2))
    rows, columns = np.nonzero(rim)
    best = difference[rows, columns].astype(np.int32)
    solid = picture[rows, columns].astype(np.int16)
    height, width = outside.shape
    for dy in range(-2, 3):
        for dx in range(-2, 3):
            y, x = np.clip(rows + dy, 0, height - 1), np.clip(columns + dx, 0, width - 1)
            better = difference[y, x] > best
            best[better] = difference[y, x][better]
            solid[better] = picture[y, x][better]
    towards = solid.astype(np.float32) - paper
    offset = picture[rows, columns].astype(np.float32) - paper
    share = (offset * towards).sum(axis=1) / np.maximum((towards**2).sum(axis=1), 1)
    share = np.clip(share, 0, 1)
    share[(best <= tolerance) & outside[rows, columns]] = 0
    # Where the line has a gap, an enclosed white region reaches the rim: it is character.
    share[(best <= tolerance) & ~outside[rows, columns]] = 1

    coverage = (~outside).astype(np.float32)
    coverage[rows, columns] = share
    colour = picture.copy()
    solved = share > 1 / 255
    clean = paper + offset[solved] / share[solved, None]
    colour[rows[solved], columns[solved]] = np.clip(np.rint(clean), 0, 255).astype(np.uint8)
    return colour, coverage
