"""Marks that are no edges: hatching, stripes and spots, drawn onto drawings whose shape is known.

A surface must not be cut along them, and normals should not change.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import nan

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .jumps import Image, Mask, distance_from_steps, figure_length

MARKS = ("hatching", "stripes", "spots")
PATCHES = {"hatching": (5, 0.08), "stripes": (3, 0.22), "spots": (5, 0.12)}
"""How many places of the figure bear marks, and their radius as a share of its length."""
SPACING = {"hatching": 0.02, "stripes": 0.055, "spots": 0.07}
"""Distance between marks as a share of the length."""
WIDTH = {"hatching": 0.004, "stripes": 0.007, "spots": 0.006}
"""Width of the ink as a share of the length; at least one pixel."""
CLEAR = 0.015
"""Marks nearer to a true step or to the border, share of the length, are drawn but not counted."""


@dataclass(frozen=True)
class MarkedDrawing:
    """``lines`` (H, W) float32 ink in 0..1, marks included; ``centre`` (H, W) bool, the middles of
    the marks, one pixel wide; ``width`` of their ink, pixels."""

    lines: NDArray[np.float32]
    centre: Mask
    width: float


def draw_marks(lines: NDArray[np.float32], mask: Mask, kind: str, seed: int = 0) -> MarkedDrawing:
    """Draw marks of a kind (``MARKS``) inside (H, W) ``mask`` over ``lines``; the same at every
    run."""
    rng = np.random.default_rng([seed, MARKS.index(kind)])
    length = figure_length(mask)
    width, spacing = max(1.0, WIDTH[kind] * length), SPACING[kind] * length
    distance, free = np.full(mask.shape, 1e9, np.float32), mask.copy()
    rows, columns = np.nonzero(mask)
    row, column = np.indices(mask.shape, np.float32)
    number, radius = PATCHES[kind]
    for place in rng.integers(len(rows), size=number):
        down, right = row - rows[place], column - columns[place]
        angle = rng.uniform(0, np.pi)
        across = down * np.cos(angle) + right * np.sin(angle)
        along = right * np.cos(angle) - down * np.sin(angle)
        if kind == "spots":
            found, away = _from_spots(across, along, spacing, rng)
        else:
            waves = np.sin(along / (0.7 * spacing)) if kind == "stripes" else 0
            bent = across + 0.3 * spacing * waves
            found = np.abs(bent - spacing * np.round(bent / spacing))
            # Strokes of a hand do not end on a circle.
            away = np.hypot(down, right) / (1 + 0.25 * np.sin(3 * np.arctan2(down, right) + angle))
        within = free & (away < radius * length)
        distance[within] = found[within]
        free &= ~within
    ink = np.clip(width / 2 - distance + 0.5, 0, 1)
    return MarkedDrawing(
        lines=np.maximum(lines, ink).astype(np.float32), centre=distance <= 0.5, width=width
    )


def wrongly_cut(marked: MarkedDrawing, with_marks: Image, without: Image, depth: Image) -> float:
    """Share of the marks' length, in pixels of their middles, where the height has a step of more
    than 1 % of the figure's length within the ink of the mark, and has none there without marks.

    Args:
        with_marks, without: (H, W) heights of both drawings, pixels towards the viewer.
        depth: (H, W) the truth, nan outside the figure.

    Returns:
        The share; nan if no marks count.
    """
    inside = np.isfinite(depth)
    length = figure_length(inside)
    border = ndimage.distance_transform_edt(np.pad(inside, 1))[1:-1, 1:-1]
    clear = np.minimum(distance_from_steps(depth, length), border) >= CLEAR * length
    counted = marked.centre & clear
    if not counted.any():
        return nan
    before, after = (
        distance_from_steps(np.where(inside, height, np.nan).astype(np.float32), length)
        for height in (without, with_marks)
    )
    reach = marked.width / 2 + 1
    new = (after <= reach) & ~(before <= reach)
    return float(new[counted].mean())


def _from_spots(
    across: NDArray[np.float32],
    along: NDArray[np.float32],
    spacing: float,
    rng: np.random.Generator,
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Distance to the outline of the round spot in every cell of a grid, of varied size; and of
    the spot's own centre to the origin."""
    cell = [np.round(at / spacing).astype(int) for at in (across, along)]
    sizes = rng.uniform(0.2, 0.38, (17, 17))
    radius = spacing * sizes[cell[0] % 17, cell[1] % 17]
    away = np.hypot(across - spacing * cell[0], along - spacing * cell[1])
    return np.abs(away - radius), spacing * np.hypot(*cell)
