"""Membranes: smooth surfaces over a region, joined to what is around it, and free where the
character ends or the surface is cut. The system is that of inflation without slopes, and is solved
in the same way.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..compiled import compiled
from .cuts import Cuts
from .direct import solve_laplacian
from .multigrid import Graph

Floats = NDArray[np.float32]
Mask = NDArray[np.bool_]

EXACT = 1e-6
"""Tolerance of the solver: all that drives a membrane is at its border, far from its middle."""


def membrane(height: Floats, region: Mask, mask: Mask, cuts: Cuts) -> Floats:
    """The smoothest surface over ``region``, spanned by the height around it, and ``height``
    elsewhere: it is harmonic.

    A part of the region that is joined to nothing lies at the mean height of its own border.

    Args:
        height: (H, W) pixels. region, mask: (H, W) bool; the region lies in the mask.
    """
    found = height.copy()
    if not region.any():
        return found
    level = np.float32(height[region].mean())  # smaller numbers are more exact
    place = _box(region)
    inside, part = region[place], found[place]
    solved, held = _solved(height[place] - level, inside, mask[place], _part(cuts, place), 0)
    part[inside] = solved + level
    parts, several = ndimage.label(inside)
    joined = np.zeros(several + 1, bool)
    joined[parts[inside][held]] = True
    for free in np.flatnonzero(~joined[1:]) + 1:
        own = parts == free
        edge = own & ~ndimage.binary_erosion(own)
        part[own] = height[place][edge].mean()
    return found


def ramp(region: Mask, mask: Mask, cuts: Cuts, reach: float) -> Floats:
    """(H, W) float32: how far inside ``region`` a pixel is, 0 at its border to 1 some ``reach``
    pixels within. It rises smoothly, without a crease in the middle of the region. 1 where the
    region is joined to nothing; 0 outside.

    It is one minus what remains of a border at 1 that decays inwards: v = reach^2 laplacian(v).
    """
    found = np.zeros(region.shape, np.float32)
    if not region.any():
        return found
    place = _box(region)
    inside = region[place]
    around = np.ones(inside.shape, np.float32)
    remains, _ = _solved(around, inside, mask[place], _part(cuts, place), 1 / max(reach, 0.5) ** 2)
    found[place][inside] = 1 - np.clip(remains, 0, 1)
    return found


Place = tuple[slice, slice]


def _box(region: Mask) -> Place:
    """Rows and columns around a region, with a margin of 1."""
    rows, columns = np.flatnonzero(region.any(axis=1)), np.flatnonzero(region.any(axis=0))
    top, left = max(0, int(rows[0]) - 1), max(0, int(columns[0]) - 1)
    return slice(top, int(rows[-1]) + 2), slice(left, int(columns[-1]) + 2)


def _part(cuts: Cuts, place: Place) -> Cuts:
    return Cuts(cuts.right[place], cuts.down[place])


def _solved(
    height: Floats, region: Mask, mask: Mask, cuts: Cuts, pull: float
) -> tuple[NDArray[np.float64], Mask]:
    """The surface at each pixel of the region, and which of these are joined to what is around.
    ``pull`` is the weight with which each is drawn to 0, against 1 of a link."""
    count = int(np.count_nonzero(region))
    number = np.full(region.shape, -1, np.int32)
    number[region] = np.arange(count, dtype=np.int32)
    starts, ends, weights, inverse, rhs, held = _link(
        number, count, mask, height, cuts.right, cuts.down, np.float32(pull)
    )
    solved = solve_laplacian(Graph(starts, ends, weights, inverse), rhs, EXACT)
    return solved[:count] - solved[count], held


@compiled
def _link(
    number: NDArray[np.int32],
    count: int,
    mask: Mask,
    height: Floats,
    cut_right: Floats,
    cut_down: Floats,
    pull: np.float32,
) -> tuple[NDArray[np.int32], NDArray[np.int32], Floats, Floats, NDArray[np.float64], Mask]:
    """The fields of the region's ``Graph`` and its right side, and which pixels are joined to what
    is around; the last node is all that is around, at height 0."""
    rows, columns = number.shape
    starts = np.zeros(count + 2, np.int32)
    ends, weights = np.empty(6 * count, np.int32), np.empty(6 * count, np.float32)
    inverse, rhs = np.zeros(count + 1, np.float32), np.zeros(count + 1)
    outer = np.zeros(count, np.float32)
    used = 0
    for row in range(rows):
        for column in range(columns):
            i = number[row, column]
            if i < 0:
                continue
            total = pull
            for down, right in ((-1, 0), (0, -1), (0, 1), (1, 0)):
                r, c = row + down, column + right
                if r < 0 or c < 0 or r >= rows or c >= columns or not mask[r, c]:
                    continue
                cut = cut_right[row, min(column, c)] if down == 0 else cut_down[min(row, r), column]
                if cut != 0:
                    continue
                total += np.float32(1)
                if number[r, c] >= 0:
                    ends[used], weights[used] = number[r, c], np.float32(1)
                    used += 1
                else:
                    outer[i] += np.float32(1)
                    rhs[i] += height[r, c]
            if outer[i] + pull > 0:
                ends[used], weights[used] = count, outer[i] + pull
                used += 1
            if total > 0:
                inverse[i] = np.float32(1) / total
            starts[i + 1] = used
    ground = np.float32(0)
    for i in range(count):
        if outer[i] + pull > 0:
            ends[used], weights[used] = i, outer[i] + pull
            used += 1
            ground += outer[i] + pull
            rhs[count] -= rhs[i]
    starts[count + 1] = used
    if ground > 0:
        inverse[count] = np.float32(1) / ground
    return starts, ends[:used].copy(), weights[:used].copy(), inverse, rhs, outer > 0
