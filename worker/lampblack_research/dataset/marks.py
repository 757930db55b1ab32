"""Random marks that are no edges of the shape: hatching, stripes, spots, fur.

A network learns from them that not every line is a step or a crease.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.float32]

PATCHES = (1, 6)
RADIUS = (0.06, 0.3)
SPACING = (0.014, 0.12)
WIDTH = (0.002, 0.01)
"""Ranges of: the number of marked places, and their radius, the distance between marks, and the
width of their ink, as shares of the character's length (the square root of its area)."""
LEAN = 1.5
"""Largest share of the depth in the direction of marks that follow the form."""
STEEPEST = 4.0
"""No mark is drawn where it would follow a steeper slope than this: the shape has a step there."""


def random_marks(depth: Image, mask: NDArray[np.bool_], rng: np.random.Generator) -> Image:
    """Ink of random marks: (H, W) float32 in 0..1, 0 outside ``mask``.

    Args:
        depth: (H, W) pixels towards the viewer. Half of the marks follow it, like hatching along
            the form; the others are straight on the paper.
        mask: (H, W), not empty.
    """
    length = float(mask.sum()) ** 0.5
    ink = np.zeros(mask.shape, np.float32)
    rows, columns = np.nonzero(mask)
    for place in rng.integers(len(rows), size=rng.integers(*PATCHES)):
        radius = length * rng.uniform(*RADIUS)
        down, across = rows[place], columns[place]
        box = (
            slice(max(0, int(down - 1.3 * radius)), int(down + 1.3 * radius) + 2),
            slice(max(0, int(across - 1.3 * radius)), int(across + 1.3 * radius) + 2),
        )
        y, x = np.indices(mask[box].shape, np.float32)
        y, x = y + (box[0].start - down), x + (box[1].start - across)
        relative = np.where(mask[box], depth[box] - depth[down, across], 0)
        spacing = length * _even_ratio(SPACING, rng)
        width = min(max(1.0, length * _even_ratio(WIDTH, rng)), 0.5 * spacing)
        distance = _distance(x, y, relative.astype(np.float32), spacing, rng)
        # Strokes of a hand do not end on a circle.
        ragged = 1 + 0.25 * np.sin(3 * np.arctan2(y, x) + rng.uniform(0, 2 * np.pi))
        drawn = np.clip(width / 2 - distance + 0.5, 0, 1) * rng.uniform(0.6, 1)
        drawn *= np.hypot(x, y) < radius * ragged
        ink[box] = np.maximum(ink[box], drawn)
    return np.where(mask, ink, 0).astype(np.float32)


def _distance(x: Image, y: Image, depth: Image, spacing: float, rng: np.random.Generator) -> Image:
    """Distance to the middle of the nearest mark, pixels, of a random kind of marks."""
    kind = rng.choice(["hatching", "crossed", "stripes", "spots", "fur"])
    angle = rng.uniform(0, np.pi)
    lean = rng.uniform(-LEAN, LEAN) if rng.random() < 0.5 else 0.0
    first = _coordinate(x, y, depth, angle, lean)
    turn = np.pi / 2 if kind in ("spots", "fur") else rng.uniform(np.pi / 4, np.pi / 2)
    second = _coordinate(x, y, depth, angle + turn, lean)
    if kind == "spots":
        cells = [np.round(at / spacing) for at in (first, second)]
        sizes = spacing * rng.uniform(0.15, 0.4, (17, 17))
        radius = sizes[cells[0].astype(int) % 17, cells[1].astype(int) % 17]
        away = np.hypot(first - spacing * cells[0], second - spacing * cells[1])
        outline: Image = np.abs(away - radius).astype(np.float32)
        return outline
    if kind == "stripes":
        first = first + 0.3 * spacing * np.sin(second / (0.7 * spacing)).astype(np.float32)
    lines = _to_lines(first, spacing)
    if kind == "crossed":
        lines = np.minimum(lines, _to_lines(second, spacing))
    if kind == "fur":
        starts = rng.uniform(0, 1, 64)[np.round(first / spacing).astype(int) % 64]
        lines = np.where((second / (5 * spacing) + starts) % 1 < 0.55, lines, np.inf)
    return lines


def _coordinate(x: Image, y: Image, depth: Image, angle: float, lean: float) -> Image:
    found: Image = (np.cos(angle) * x + np.sin(angle) * y + lean * depth).astype(np.float32)
    return found


def _to_lines(coordinate: Image, spacing: float) -> Image:
    """Distance on the paper to where the coordinate is a multiple of ``spacing``."""
    slope = np.hypot(*np.gradient(coordinate))
    away = np.abs(coordinate - spacing * np.round(coordinate / spacing))
    near = away / np.maximum(slope, 0.3)
    return np.where(slope < STEEPEST, near, np.inf).astype(np.float32)


def _even_ratio(bounds: tuple[float, float], rng: np.random.Generator) -> float:
    return float(np.exp(rng.uniform(*np.log(bounds))))
