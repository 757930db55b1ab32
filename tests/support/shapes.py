"""Shapes painted by formula, for tests."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lampblack.drawing import Drawing

SIZE = 240
FINE = 4
Picture = NDArray[np.uint8]


def grid() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """x and y of every fine sample, in pixels."""
    step = (np.arange(SIZE * FINE) + 0.5) / FINE
    across, down = np.meshgrid(step, step)
    return across, down


def disc(x: float, y: float, radius: float) -> NDArray[np.bool_]:
    across, down = grid()
    return np.asarray(np.hypot(across - x, down - y) < radius)


def ring(x: float, y: float, radius: float, width: float) -> NDArray[np.bool_]:
    return disc(x, y, radius + width / 2) & ~disc(x, y, radius - width / 2)


def paint(*layers: tuple[NDArray[np.bool_], tuple[int, int, int]]) -> Picture:
    """Anti-aliased shapes on transparency, straight alpha."""
    colour = np.zeros((SIZE * FINE, SIZE * FINE, 3))
    alpha = np.zeros((SIZE * FINE, SIZE * FINE))
    for shape, paint_colour in layers:
        colour[shape] = paint_colour
        alpha[shape] = 1
    blocks = (SIZE, FINE, SIZE, FINE)
    cover = alpha.reshape(blocks).mean(axis=(1, 3))
    summed = colour.reshape(*blocks, 3).mean(axis=(1, 3))
    straight = summed / np.maximum(cover, 1e-6)[..., None]
    return np.asarray(np.rint(np.dstack([straight, cover * 255])), np.uint8)


def on_paper(picture: Picture, paper: tuple[int, int, int] = (255, 255, 255)) -> Picture:
    alpha = picture[..., 3:] / 255
    blend = picture[..., :3] * alpha + np.array(paper) * (1 - alpha)
    return np.asarray(np.rint(np.dstack([blend, np.full(alpha.shape[:2], 255)])), np.uint8)


def outlined(ink: tuple[int, int, int] = (0, 0, 0), width: float = 5) -> Picture:
    """A two-coloured body with an outline, an inner line and a whisker."""
    across, down = grid()
    right = disc(120, 120, 80) & (across > 120)
    whisker = (abs(down - 60) < 2) & (across > 178) & (across < 230)
    inner = ring(120, 120, 40, width)
    return paint(
        (disc(120, 120, 80), (230, 180, 60)),
        (right, (60, 160, 220)),
        (inner, ink),
        (ring(120, 120, 80, width), ink),
        (whisker, ink),
    )


def recomposed(drawing: Drawing, paper: tuple[int, int, int]) -> NDArray[np.float64]:
    ink, cover = drawing.ink[..., None], drawing.coverage[..., None]
    character = ink * drawing.ink_colour + (1 - ink) * drawing.albedo
    return np.asarray((cover * character + (1 - cover) * np.array(paper) / 255) * 255)
