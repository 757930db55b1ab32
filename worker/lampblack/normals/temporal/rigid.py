"""The rigid motion of a whole character from one drawing to another."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .sample import sampled

Planes = NDArray[np.float32]
Point = tuple[float, float]

_STEPS = 12
_COARSEST_PX = 32
_FINEST = 1
"""Halvings of the grid at which the search ends: the dense flow finds the rest."""
_SETTLED = 0.02


@dataclass(frozen=True)
class Motion:
    """A rotation by ``angle`` (radians, anticlockwise as seen) about ``source``, a scaling, and
    a shift of ``source`` to ``target``. Points are (row, column)."""

    source: Point
    target: Point
    angle: float = 0.0
    scale: float = 1.0

    def __call__(self, points: Planes) -> Planes:
        """(2, ...) float32 points -> the moved points."""
        y, x = points[0] - self.source[0], points[1] - self.source[1]
        cos, sin = self.scale * np.cos(self.angle), self.scale * np.sin(self.angle)
        moved = [cos * y - sin * x + self.target[0], sin * y + cos * x + self.target[1]]
        placed: Planes = np.stack(moved).astype(np.float32)
        return placed


def rigid_motion(fixed: Planes, moving: Planes, start: Motion, finest: int = _FINEST) -> Motion:
    """The motion that maps ``fixed``, (C, h, w), onto ``moving``, (C, h', w').

    Robust Gauss-Newton over the feature planes, from coarse to fine. ``start.scale`` is kept.
    The search ends at the grid halved ``finest`` times.
    """
    motion = start
    coarsest = max(finest, int(np.log2(max(fixed.shape[1:]) / _COARSEST_PX)))
    for halvings in range(coarsest, finest - 1, -1):
        step = 2**halvings
        sigma = (0, 0.5 * step, 0.5 * step) if step > 1 else 0
        blurred = ndimage.gaussian_filter(moving, sigma) if step > 1 else moving
        still = (ndimage.gaussian_filter(fixed, sigma) if step > 1 else fixed)[:, ::step, ::step]
        points = step * np.indices(still.shape[1:], np.float32)
        for _ in range(_STEPS):
            motion, change = _improved(still, blurred, points, motion, step)
            if change < _SETTLED * step:
                break
    return motion


def _improved(
    fixed: Planes, moving: Planes, points: Planes, motion: Motion, step: int
) -> tuple[Motion, float]:
    """One step, and the largest distance in cells by which it moves the character's border."""
    there = sampled(moving, motion(points))
    down, right = np.gradient(there, step, axis=(1, 2))
    y, x = points[0] - motion.source[0], points[1] - motion.source[1]
    difference = there - fixed
    weight = 1 / np.sqrt((difference**2).sum(axis=0) + 0.1**2)
    slopes = np.stack([right * y - down * x, down, right])
    flat = (slopes * weight).reshape(3, -1)
    normal = flat @ slopes.reshape(3, -1).T
    turn, *shift = np.linalg.solve(
        normal + 1e-6 * np.eye(3), -flat @ difference.reshape(-1).astype(np.float64)
    )
    # The gradients are along the fixed drawing's axes, the shift along the moving one's.
    cos, sin = motion.scale * np.cos(motion.angle), motion.scale * np.sin(motion.angle)
    target = (
        motion.target[0] + cos * shift[0] - sin * shift[1],
        motion.target[1] + sin * shift[0] + cos * shift[1],
    )
    reach = float(np.abs(points).max()) / 2
    moved = abs(turn) * reach + float(np.abs(shift).max())
    return Motion(motion.source, target, motion.angle + float(turn), motion.scale), moved
