"""What the artist says of overlaps wins over what was found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..choices import FrontSide
from ..scene import DepthHint
from .cuts import across
from .occlusions import CLOSE, SHORTEST, Occlusion
from .strokes import Stroke, mean_along

SNAP = 0.015
"""A hint follows a stroke of ink this near to it; share of the character's length."""
ALONG = 0.6
"""It follows a single stroke if that is the nearest for this share of its points."""
BLUR = 0.01
"""Otherwise its snapped points are averaged this far along; share of the length."""
COVERS = 0.02
"""What was found this near to a hint is replaced by it; share of the length."""

Points = NDArray[np.float64]


def apply_hints(
    found: list[Occlusion],
    strokes: list[Stroke],
    hints: Sequence[DepthHint],
    mask: NDArray[np.bool_],
    length: float,
) -> list[Occlusion]:
    """``found``, changed as ``hints`` say, later ones last.

    A hint applies where it is drawn. It is snapped to the ink, and cuts the surface there if
    nothing was found. A hint of one point is a click: it applies to all of the nearest occlusion.

    Args:
        found: the occlusions of the drawing; they stay as they are where no hint is near.
        hints: their points in pixels of the grid, as those of ``found``.
        mask: (H, W) bool. length: of the character, in pixels.
    """
    for hint in hints:
        path = _path(hint, found, strokes, length)
        if len(path) < 2:
            continue
        kept: list[Occlusion] = []
        for occlusion in found:
            kept += _uncovered(occlusion, path, hint.front, length)
        ends = _joins_beyond(path, kept, mask, length)
        points = path.astype(np.float32)
        found = [*kept, Occlusion(points, hint.front, ends, True, hint.amount)]
    return found


def _path(hint: DepthHint, found: list[Occlusion], strokes: list[Stroke], length: float) -> Points:
    """The line that a hint is about, in its direction, points about a pixel apart."""
    points = np.array([(p.x, p.y) for p in hint.points], np.float64).reshape(-1, 2)
    points = np.clip(points, -length, 3 * length)  # nothing lies further away
    if len(points) == 1 and found:
        gaps = [float(np.hypot(*(line.points - points[0]).T).min()) for line in found]
        nearest = int(np.argmin(gaps))
        return np.asarray(found[nearest].points if gaps[nearest] < COVERS * length else points[:0])
    if len(points) < 2:
        return points[:0]
    dense = _dense(points)
    lines = [line.points for line in strokes]
    if not lines:
        return dense
    owner = np.repeat(np.arange(len(lines)), [len(line) for line in lines])
    every = np.concatenate(lines)
    gap, nearest_at = cKDTree(every).query(dense, distance_upper_bound=SNAP * length)
    near = np.isfinite(gap)
    if not near.any():
        return dense
    counts = np.bincount(owner[nearest_at[near]], minlength=len(lines))
    most = int(np.argmax(counts))
    if counts[most] >= ALONG * len(dense):
        at = nearest_at[near][owner[nearest_at[near]] == most] - int(np.argmax(owner == most))
        part = _part(strokes[most], at, len(dense))
        if part is not None:
            return part
    dense[near] = every[nearest_at[near]]
    reach = max(1, round(BLUR * length))
    every_point = np.ones(len(dense), bool)
    smooth = [mean_along(axis, every_point, reach) for axis in dense.T.astype(np.float32)]
    return np.stack(smooth, axis=1).astype(np.float64)


def _dense(points: Points) -> Points:
    """The same line with points about a pixel apart."""
    along = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    if along[-1] <= 0:
        return points[:0]
    at = np.linspace(0, along[-1], max(2, int(np.ceil(along[-1])) + 1))
    return np.stack([np.interp(at, along, axis) for axis in points.T], axis=1)


def _part(stroke: Stroke, at: NDArray[np.intp], drawn: int) -> Points | None:
    """The part of a stroke over the points ``at``, in their order; None if it is much longer or
    shorter than what was ``drawn``."""
    count = len(stroke.points)
    if stroke.closed:  # steps of the shorter way around
        moves = (np.diff(at) + count // 2) % count - count // 2
        at = at[0] + np.concatenate([[0], np.cumsum(moves)])
    low, high = int(at.min()), int(at.max())
    if not 0.5 * drawn < high - low + 1 < 2 * drawn:
        return None
    part = stroke.points[np.arange(low, high + 1) % count]
    forth = at[len(at) // 2 :].mean() >= at[: len(at) // 2 + 1].mean()
    return np.asarray(part if forth else part[::-1], np.float64)


def _uncovered(
    occlusion: Occlusion, path: Points, front: FrontSide, length: float
) -> list[Occlusion]:
    """The parts of an occlusion that a hint says nothing about. Where the hint has the same side
    in front they run on to it, so that the step does not sink between the two."""
    points, count = occlusion.points, len(occlusion.points)
    gap, at = cKDTree(path).query(points)
    far = gap > COVERS * length
    if far.all() or not far.any():
        return [occlusion] if far.all() else []
    towards = occlusion.towards
    if np.array_equal(points[0], points[-1]):  # a ring: start where it is covered
        start = -int(np.argmin(far))
        points, towards, far, at = (np.roll(a, start, axis=0) for a in (points, towards, far, at))
    agree = np.zeros(count, bool)
    if front != "joined":
        hinted = across(path.astype(np.float32), front)
        agree = np.einsum("nc,nc->n", towards, hinted[at]) > 0
    bounds = np.flatnonzero(np.diff(np.concatenate([[False], far, [False]]))).reshape(-1, 2)
    more = round(COVERS * length)
    parts = []
    for first, last in bounds:
        if last - first < SHORTEST * length:
            continue
        head, tail = occlusion.open_ends
        if first > 0:
            head = not agree[first]
            first = first if head else max(0, first - more)
        if last < count:
            tail = not agree[last - 1]
            last = last if tail else min(count, last + more)
        parts.append(replace(occlusion, points=points[first:last], open_ends=(head, tail)))
    return parts


def _joins_beyond(
    path: Points, others: list[Occlusion], mask: NDArray[np.bool_], length: float
) -> tuple[bool, bool]:
    """Whether the surface is joined beyond the ends of a path: it is unless the path is a ring, or
    ends at another overlap or at the outline of the character."""
    close = CLOSE * length
    if len(path) > 4 * close and np.hypot(*(path[0] - path[-1])) < close:
        return False, False
    joins = []
    for point, inward in ((path[0], path[min(len(path) - 1, 3)]), (path[-1], path[-4:][0])):
        met = any(
            np.hypot(*(other.points - point).T).min() < close
            for other in others
            if other.front != "joined"
        )
        ahead = (point - inward) / max(float(np.hypot(*(point - inward))), 1e-9)
        x, y = np.floor(point + np.arange(close + 1)[:, None] * ahead).astype(int).T
        seen = (x >= 0) & (y >= 0) & (x < mask.shape[1]) & (y < mask.shape[0])
        inside = seen & mask[np.where(seen, y, 0), np.where(seen, x, 0)]
        joins.append(bool(inside.all()) and not met)
    return joins[0], joins[1]
