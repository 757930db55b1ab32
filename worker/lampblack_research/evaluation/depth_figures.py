"""How much of the true depth jumps a height map holds, and what it invents.

No single figure suffices. Heights three times too large recover more of every jump, and are wrong
everywhere else; so ``recovered`` and ``quarter`` are read together with ``false`` and ``angle``.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import nan

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .jumps import (
    JUMP,
    STEP,
    Image,
    distance_from_steps,
    figure_length,
    jump_pairs,
    smooth_pairs,
)

LEAST_PAIRS = 50
"""A drawing with fewer jump pairs has no figures of jumps."""


@dataclass(frozen=True)
class DepthFigures:
    """Figures of one height map. L is the figure's length, the longer side of its box.

    A *jump link* joins neighbouring pixels whose true depth differs by more than 2 % L, and by 1 %
    L more than the slopes of the links on either side. A *jump pair* are the points 0.75 % L to
    either side of one, across the edge, if all between lies in the figure and crosses no other
    step of more than 1 % L, and their true depth differs by more than 2 % L. That difference is
    the jump J; R is the same difference of the height, nearer side less farther side.

    A *smooth pair* are two random points 1.5 % L apart, if all between lies in the figure, at least
    1.5 % L from every true step of more than 1 % L, and has no true slope above 0.5 % L a pixel.

    Attributes:
        recovered: mean over jump pairs of R / J, limited to -1..1.5; nan, like the next four,
            with fewer than 50 pairs.
        recovered_median: their median.
        quarter: share of jump pairs with R of at least J / 4.
        sign: share of jump pairs with R above 0.
        over: share of jump pairs with R above 1.5 J.
        false: share of smooth pairs where the difference is wrong by more than 2 % L.
        cut: share of smooth pairs with a step of more than 1 % L within a pixel.
        height_angle: mean angle in degrees between the normals of the height, by central
            differences, and the true ones, at least 1 % L from true steps and from the border.
        rmse: error of the height in percent of L, after the best scale (not below 0) and shift.
    """

    recovered: float
    recovered_median: float
    quarter: float
    sign: float
    over: float
    false: float
    cut: float
    height_angle: float
    rmse: float


class DepthTruth:
    """The truth of one drawing, against which height maps are measured.

    Args:
        depth: (H, W) float32, pixels towards the viewer, nan outside the figure.
        normals: (H, W, 3) float32, x right, y up, z to the viewer, unit in the figure.
    """

    def __init__(self, depth: Image, normals: Image) -> None:
        self._depth, self._normals = depth, normals
        self._inside = np.isfinite(depth)
        self.length = figure_length(self._inside)
        self._pairs, self._jumps = jump_pairs(depth, self.length)
        self._smooth = smooth_pairs(depth, self.length)
        self._rises = self._smooth.difference(depth)
        border = ndimage.distance_transform_edt(np.pad(self._inside, 1))[1:-1, 1:-1]
        clear = distance_from_steps(depth, self.length) > STEP * self.length
        self._interior = clear & (border > STEP * self.length)

    def measure(self, height: Image) -> DepthFigures:
        """Measure (H, W) float32 ``height``, pixels towards the viewer; any shift, no rescaling.
        Pixels of the figure without a height (not finite) count as wrong."""
        found = np.where(self._inside, height, np.nan).astype(np.float32)
        right = np.abs(self._smooth.difference(found) - self._rises) <= JUMP * self.length
        return DepthFigures(
            *self._at_jumps(found),
            false=float((~right).mean()) if len(right) else nan,
            cut=float(self._smooth.crosses_step(found, STEP * self.length).mean())
            if len(right)
            else nan,
            height_angle=self._angle(found),
            rmse=self._rmse(found),
        )

    def _at_jumps(self, height: Image) -> tuple[float, float, float, float, float]:
        if len(self._pairs) < LEAST_PAIRS:
            return nan, nan, nan, nan, nan
        rise, jump = np.nan_to_num(self._pairs.difference(height)), self._jumps
        share = np.clip(rise / jump, -1, 1.5)
        return (
            float(share.mean()),
            float(np.median(share)),
            float((rise >= jump / 4).mean()),
            float((rise > 0).mean()),
            float((rise > 1.5 * jump).mean()),
        )

    def _angle(self, height: Image) -> float:
        down, right = np.gradient(height)
        normals = np.stack([-right, down, np.ones_like(height)], axis=2)
        normals /= np.linalg.norm(normals, axis=2, keepdims=True)
        known = self._interior & np.isfinite(normals).all(axis=2)
        if not known.any():
            return nan
        cosine = np.einsum("nc,nc->n", normals[known], self._normals[known])
        return float(np.degrees(np.arccos(np.clip(cosine, -1, 1))).mean())

    def _rmse(self, height: Image) -> float:
        known = self._inside & np.isfinite(height)
        if not known.any():
            return nan
        found, true = (_centred(plane[known]) for plane in (height, self._depth))
        scale = max(float(found @ true) / max(float(found @ found), 1e-9), 0.0)
        return 100 * float(np.sqrt(np.mean((scale * found - true) ** 2))) / self.length


def mean_known(values: list[float]) -> float:
    """Mean of the values that are not nan, rounded; nan if there are none."""
    known = [value for value in values if np.isfinite(value)]
    return round(float(np.mean(known)), 5) if known else nan


def _centred(values: Image) -> NDArray[np.float64]:
    wide = values.astype(np.float64)
    centred: NDArray[np.float64] = wide - wide.mean()
    return centred
