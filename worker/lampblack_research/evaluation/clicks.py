"""The artist's correction, simulated: of all overlaps that a surface has wrong or lacks, the worst
is clicked or drawn."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import connected_components, dijkstra
from scipy.spatial import cKDTree

from lampblack.choices import FrontSide
from lampblack.scene import DepthHint, DepthPoint
from lampblack.surface import Overlap

from .jumps import STEP, Floats, Image, Pairs, figure_length, jump_pairs, nearest

BESIDE = 0.01
"""Distance from an overlap to the true depths on either side, as a share of the figure's length."""


APART = 3.0
"""Points of one line are at most this far apart, pixels."""
HELD = 0.25
"""Of a jump that is there, a surface holds at least this share."""
MOST_POINTS = 32


class Correction(NamedTuple):
    """What the artist does, and the wrong that it rights: pixels of height times pixels along."""

    hint: DepthHint | None
    wrong: float


def best_correction(overlaps: Sequence[Overlap], height: Image, depth: Image) -> DepthHint | None:
    """The click or stroke that sets most right; None if nothing is wrong.

    Args:
        overlaps, height: of the surface; (H, W). depth: (H, W) the truth, nan outside the figure.
    """
    return max(
        worst_overlap(overlaps, depth), worst_missing(height, depth), key=lambda made: made.wrong
    ).hint


def worst_overlap(overlaps: Sequence[Overlap], depth: Image) -> Correction:
    """A click that sets right the overlap that is wrong along the most length and height.

    An overlap is wrong if the other side is in front in truth, or neither by more than 1 % of the
    figure's length, along most of it; what has no truth on both sides is left alone.

    Returns:
        A hint of one point in the middle of the overlap, of no given amount; None if no overlap is
        wrong.
    """
    length = figure_length(np.isfinite(depth))
    worst = Correction(None, 0.0)
    for overlap in overlaps:
        rise = left_above_right(overlap.points, depth, BESIDE * length)
        known = np.isfinite(rise)
        if len(rise) < 2 or known.mean() < 0.5:
            continue
        true = float(np.median(rise[known]))
        front: FrontSide = "joined"
        if abs(true) > STEP * length:
            front = "left" if true > 0 else "right"
        found = overlap.amount if overlap.front == "left" else -overlap.amount
        wrong = 0.0 if front == overlap.front else abs(true - found) * len(rise)
        if wrong > worst.wrong:
            x, y = overlap.points[len(rise) // 2].tolist()
            worst = Correction(DepthHint(1, (DepthPoint(x, y),), front), wrong)
    return worst


def worst_missing(height: Image, depth: Image) -> Correction:
    """A stroke along the jump of ``depth`` of which ``height`` lacks most, of no given amount."""
    pairs, jumps = jump_pairs(depth, figure_length(np.isfinite(depth)))
    lacking = jumps - np.nan_to_num(pairs.difference(height))
    missing = lacking > (1 - HELD) * jumps
    pairs, lacking = pairs.only(missing), lacking[missing]
    if len(pairs) < 2:
        return Correction(None, 0.0)
    gaps = _gaps_between(pairs)
    _, owner = connected_components(gaps, directed=False)
    wrong = np.bincount(owner, weights=lacking)
    worst = np.flatnonzero(owner == int(wrong.argmax()))
    path = worst[_longest_path(gaps[worst][:, worst])]
    return Correction(_stroke(pairs.only(path)), float(wrong.max()))


def _gaps_between(pairs: Pairs) -> sparse.csr_matrix:
    """(N, N) distances between the middles of pairs that are near each other."""
    middles = np.column_stack([pairs.column, pairs.row])
    near = cKDTree(middles)
    return near.sparse_distance_matrix(near, APART, output_type="coo_matrix").tocsr()


def _longest_path(gaps: sparse.csr_matrix) -> NDArray[np.intp]:
    """The points from one end of a line to the other, given the ``gaps`` between them."""
    far = int(dijkstra(gaps, directed=False, indices=0).argmax())
    reach, before = dijkstra(gaps, directed=False, indices=far, return_predecessors=True)
    at = int(reach.argmax())
    path = [at]
    while at != far:
        at = int(before[at])
        path.append(at)
    return np.array(path)


def _stroke(pairs: Pairs) -> DepthHint | None:
    if len(pairs) < 2:
        return None
    ahead_x, ahead_y = np.gradient(pairs.column), np.gradient(pairs.row)
    # Of a walker to the right, the left hand is up the canvas.
    to_left = float((pairs.right * ahead_y - pairs.down * ahead_x).sum())
    few = np.unique(np.linspace(0, len(pairs) - 1, min(MOST_POINTS, len(pairs))).astype(int))
    points = tuple(
        DepthPoint(float(x) + 0.5, float(y) + 0.5)
        for x, y in zip(pairs.column[few], pairs.row[few], strict=True)
    )
    return DepthHint(1, points, "left" if to_left > 0 else "right")


def left_above_right(points: NDArray[np.float32], depth: Image, reach: float) -> Image:
    """(N,) ``depth`` on the left of a line less that on its right, ``reach`` pixels away; nan
    outside.

    Args:
        points: (N, 2), x right and y down, N at least 2.
    """
    ahead: Floats = np.gradient(points.astype(np.float64), axis=0)
    ahead /= np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
    column, row = points.astype(np.float64).T - 0.5
    # Of a walker to the right, the left hand is up the canvas.
    left, right = (
        nearest(depth, row - side * reach * ahead[:, 0], column + side * reach * ahead[:, 1])
        for side in (1, -1)
    )
    return left - right
