"""Dense registration of two drawings: variational flow, from coarse to fine.

A robust data term over several feature planes and a robust first-order smoothness, linearised
and solved by successive over-relaxation at every level (Brox et al., "High accuracy optical flow
estimation based on a theory for warping", ECCV 2004).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ...compiled import compiled
from .sample import sampled

Planes = NDArray[np.float32]

_SMOOTHNESS = np.float32(0.15)
_FAINT = np.float32(0.05)
"""Difference of features up to which the penalty is quadratic; beyond it is linear."""
_BEND = np.float32(0.1)
"""The same for the gradient of the flow, cells per cell."""
_COARSEST_PX = 20
_WARPS = 3
_SWEEPS = 20
_OVER_RELAXATION = np.float32(1.8)
_LONGEST_STEP = 2.0


def dense_flow(fixed: Planes, moving: Planes) -> Planes:
    """The displacement of each cell of ``fixed`` in ``moving``.

    Args:
        fixed, moving: (C, h, w) float32 feature planes, about 0 to 1, h and w at least 2.

    Returns:
        (2, h, w) float32 rows, columns: point p of ``fixed`` is at p + flow in ``moving``.
    """
    if min(fixed.shape[1:]) <= _COARSEST_PX:
        flow = np.zeros((2, *fixed.shape[1:]), np.float32)
    else:
        coarse = dense_flow(_halved(fixed), _halved(moving))
        flow = 2 * sampled(coarse, np.indices(fixed.shape[1:], np.float32) / 2.0)
    at = np.indices(fixed.shape[1:], np.float32)
    for _ in range(_WARPS):
        change = _change(fixed, sampled(moving, at + flow), flow, _SWEEPS)
        stepped = flow + np.clip(change, -_LONGEST_STEP, _LONGEST_STEP)
        flow = ndimage.median_filter(stepped, (1, 3, 3))
    return flow


@compiled
def _change(fixed: Planes, there: Planes, flow: Planes, sweeps: int) -> Planes:
    """The (2, h, w) change of ``flow`` that brings ``there``, ``moving`` warped by it, nearer to
    ``fixed``: linearised, then solved by red-black over-relaxation."""
    channels, rows, columns = fixed.shape
    system = np.zeros((rows, columns, 5), np.float32)
    stiffness = np.empty((rows, columns), np.float32)
    for r in range(rows):
        up, down = max(r - 1, 0), min(r + 1, rows - 1)
        for c in range(columns):
            left, right = max(c - 1, 0), min(c + 1, columns - 1)
            total = np.float32(0)
            for k in range(channels):
                y = (there[k, down, c] - there[k, up, c] + fixed[k, down, c] - fixed[k, up, c]) / 4
                x = (there[k, r, right] - there[k, r, left]) / 4
                x += (fixed[k, r, right] - fixed[k, r, left]) / 4
                off = there[k, r, c] - fixed[k, r, c]
                system[r, c, 0] += y * y
                system[r, c, 1] += y * x
                system[r, c, 2] += x * x
                system[r, c, 3] += y * off
                system[r, c, 4] += x * off
                total += off * off
            weight = 1 / np.sqrt(total + _FAINT**2)
            system[r, c, :] *= weight
            bend = _BEND**2
            for k in range(2):
                bend += ((flow[k, down, c] - flow[k, up, c]) / 2) ** 2
                bend += ((flow[k, r, right] - flow[k, r, left]) / 2) ** 2
            stiffness[r, c] = _SMOOTHNESS / np.sqrt(bend)
    change = np.zeros_like(flow)
    for sweep in range(2 * sweeps):
        for r in range(rows):
            for c in range((r + sweep) % 2, columns, 2):
                held = np.float32(0)
                pull_y = np.float32(0)
                pull_x = np.float32(0)
                for side in range(4):
                    i = r + (side == 0) - (side == 1)
                    j = c + (side == 2) - (side == 3)
                    if 0 <= i < rows and 0 <= j < columns:
                        link = (stiffness[r, c] + stiffness[i, j]) / 2
                        held += link
                        pull_y += link * (flow[0, i, j] + change[0, i, j] - flow[0, r, c])
                        pull_x += link * (flow[1, i, j] + change[1, i, j] - flow[1, r, c])
                yy = system[r, c, 0] + held
                yx = system[r, c, 1]
                xx = system[r, c, 2] + held
                pull_y -= system[r, c, 3]
                pull_x -= system[r, c, 4]
                area = yy * xx - yx * yx
                new_y = (xx * pull_y - yx * pull_x) / area
                new_x = (yy * pull_x - yx * pull_y) / area
                change[0, r, c] += _OVER_RELAXATION * (new_y - change[0, r, c])
                change[1, r, c] += _OVER_RELAXATION * (new_x - change[1, r, c])
    return change


def _halved(planes: Planes) -> Planes:
    smooth = ndimage.gaussian_filter(planes, (0, 0.8, 0.8), mode="nearest")
    return np.ascontiguousarray(smooth[:, ::2, ::2])
