"""Strokes of a brush: humps and hollows along a line, and normals that turn to where it goes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from ..scene import DepthStroke
from .cuts import Cuts
from .solver import NZ_FLOOR

Floats = NDArray[np.float32]

FLAT_CORE = 0.25
"""Share of the radius over which a turn is whole."""
FIRM = 2.0
"""The normals in the middle of a turn weigh as much as those of (1 + this)^2 pixels: the surface
around gives way, since it is not sure of its own."""
FINE = 12
"""Points of a stroke in each radius; its curve runs smoothly through those that were drawn."""
MOST_POINTS = 2000
STEEPEST = 80.0
"""Degrees that a turned surface leans at the most."""


@dataclass(frozen=True, eq=False)
class _Trace:
    """A stroke on a part of the canvas.

    Attributes:
        place: rows and columns of the part.
        near: (h, w) float32, 0 on the line to 1 at the radius and beyond.
        towards: (h, w, 2) float32 x, y, unit, the way that the line goes at its nearest point; 0
            for a stroke of one point.
    """

    place: tuple[slice, slice]
    near: Floats
    towards: Floats


def hump(near: Floats) -> Floats:
    """The height of a hump, 1 on the line and 0 from the radius on, smooth in between: the square
    of 1 - ``near``^2."""
    return np.asarray(np.square(1 - np.minimum(near, 1) ** 2), np.float32)


def humped(
    height: Floats, mask: NDArray[np.bool_], cuts: Cuts, strokes: Sequence[DepthStroke]
) -> Floats:
    """``height`` with the bumps and dents of ``strokes``.

    They end at cuts: a bump on an arm does not raise the body behind it.

    Args:
        height: (H, W) pixels. mask: (H, W) bool.
        strokes: in pixels of (H, W).
    """
    found = height.copy()
    for stroke in strokes:
        if stroke.brush not in ("bump", "dent"):
            continue
        amount = stroke.amount * stroke.radius * (1 if stroke.brush == "bump" else -1)
        for trace in _traces(stroke, mask.shape):
            reached = _reached(trace, mask, cuts)
            found[trace.place] += np.float32(amount) * hump(trace.near) * reached
    return found


def turned(normals: Floats, mask: NDArray[np.bool_], strokes: Sequence[DepthStroke]) -> Floats:
    """``normals``, (H, W, 3) from ``usable_normals``, turned where ``strokes`` say so.

    A normal is rotated towards the way that the stroke goes, so the surface keeps its shape under
    the brush. The longer a normal is, the more it weighs: the solver takes the squares of their
    lengths as weights.
    """
    found = normals
    for stroke in strokes:
        if stroke.brush != "turn":
            continue
        most = np.radians(min(90 * stroke.amount, STEEPEST))
        for trace in _traces(stroke, mask.shape):
            if not trace.towards.any():
                continue
            found = normals.copy() if found is normals else found
            along = trace.towards * np.array([1, -1], np.float32)  # normals count y upwards
            outer = np.clip((trace.near - FLAT_CORE) / (1 - FLAT_CORE), 0, 1)
            share = ((1 - outer * outer * (3 - 2 * outer)) * mask[trace.place])[..., None]
            part = found[trace.place]
            found[trace.place] = np.where(
                share > 0, _leaning(part, along, most * share) * (1 + FIRM * share), part
            )
    return found


def _leaning(normals: Floats, along: Floats, lean: Floats) -> Floats:
    """Unit normals rotated by ``lean``, (h, w, 1) radians, from the viewer towards ``along``,
    (h, w, 2) unit, x right and y up; they still face the viewer."""
    unit = normals / np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), 1e-6)
    forward = (unit[..., :2] * along).sum(axis=2, keepdims=True)
    up, sine, cosine = unit[..., 2:], np.sin(lean), np.cos(lean)
    level = unit[..., :2] + (forward * (cosine - 1) + up * sine) * along
    turned_up = np.maximum(up * cosine - forward * sine, NZ_FLOOR)
    found = np.concatenate([level, turned_up], axis=2)
    return np.asarray(found / np.linalg.norm(found, axis=2, keepdims=True), np.float32)


def brushed(mask: NDArray[np.bool_], strokes: Sequence[DepthStroke]) -> NDArray[np.bool_]:
    """(H, W) bool: what the strokes can reach."""
    found = np.zeros_like(mask)
    for stroke in strokes:
        for trace in _traces(stroke, mask.shape):
            found[trace.place] |= (trace.near < 1) & mask[trace.place]
    return found


def _traces(stroke: DepthStroke, shape: tuple[int, ...]) -> Iterator[_Trace]:
    """The stroke on the part of the canvas that it reaches; nothing if it lies beyond."""
    radius = max(stroke.radius, 1e-3)
    points = _curve(stroke, radius)
    if not len(points):
        return
    low = np.maximum(np.floor(points.min(axis=0) - radius), 0).astype(int)
    high = np.minimum(np.ceil(points.max(axis=0) + radius) + 1, shape[1::-1]).astype(int)
    if (high <= low).any():
        return
    place = slice(low[1], high[1]), slice(low[0], high[0])
    pixels = np.stack([axis.ravel() + 0.5 for axis in np.mgrid[place][::-1]], axis=1)
    away, nearest = cKDTree(points).query(pixels, distance_upper_bound=1.1 * radius + 1)
    found = np.flatnonzero(np.isfinite(away))
    distance = np.full(len(pixels), np.inf)
    towards = np.zeros((len(pixels), 2))
    ways = _ways(points)
    for first in (nearest[found] - 1, nearest[found]):  # the two parts that meet in that point
        at = np.clip(first, 0, max(0, len(points) - 2))
        after = np.minimum(at + 1, len(points) - 1)
        step, out = points[after] - points[at], pixels[found] - points[at]
        share = (out * step).sum(axis=1) / np.maximum((step * step).sum(axis=1), 1e-12)
        share = np.clip(share, 0, 1)[:, None]
        gap = np.hypot(*(out - share * step).T)
        nearer = gap < distance[found]
        distance[found[nearer]] = gap[nearer]
        towards[found[nearer]] = (ways[at] + share * (ways[after] - ways[at]))[nearer]
    length = np.maximum(np.hypot(*towards.T), 1e-9)[:, None]
    size = high[1] - low[1], high[0] - low[0]
    yield _Trace(
        place,
        np.minimum(distance / radius, 1).reshape(size).astype(np.float32),
        (towards / length).reshape(*size, 2).astype(np.float32),
    )


def _curve(stroke: DepthStroke, radius: float) -> NDArray[np.float64]:
    """(N, 2) points x, y close to one another on the smooth curve through those of a stroke."""
    drawn = np.array([(p.x, p.y) for p in stroke.points], np.float64).reshape(-1, 2)
    step = np.hypot(*np.diff(drawn, axis=0).T)
    drawn = drawn[np.concatenate([[True], step > 1e-6])] if len(drawn) else drawn
    if len(drawn) < 2:
        return drawn
    along = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(drawn, axis=0).T))])
    count = int(np.clip(np.ceil(along[-1] / radius * FINE), 1, MOST_POINTS)) + 1
    at = np.union1d(np.linspace(0, along[-1], count), along)
    if len(drawn) == 2:
        return np.stack([np.interp(at, along, axis) for axis in drawn.T], axis=1)
    # Most drawings have no strokes of the brush, and this takes a tenth of a second to load.
    from scipy.interpolate import CubicSpline

    ring = len(drawn) > 3 and np.hypot(*(drawn[0] - drawn[-1])) < 1e-6
    return np.asarray(CubicSpline(along, drawn, bc_type="periodic" if ring else "natural")(at))


def _ways(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """(N, 2) unit, the way that a line goes at each of its points."""
    if len(points) < 2:
        return np.zeros_like(points)
    along = np.gradient(points, axis=0)
    return np.asarray(along / np.maximum(np.hypot(*along.T), 1e-9)[:, None])


def _reached(trace: _Trace, mask: NDArray[np.bool_], cuts: Cuts) -> NDArray[np.bool_]:
    """(h, w) bool: what is joined with the line of the stroke, within its radius and without a way
    through a cut."""
    inside = mask[trace.place] & (trace.near < 1)
    if not (cuts.right[trace.place].any() or cuts.down[trace.place].any()):
        return inside
    number = np.arange(inside.size).reshape(inside.shape)
    right = inside[:, :-1] & inside[:, 1:] & (cuts.right[trace.place][:, :-1] == 0)
    down = inside[:-1] & inside[1:] & (cuts.down[trace.place][:-1] == 0)
    start = np.concatenate([number[:, :-1][right], number[:-1][down]])
    end = np.concatenate([number[:, 1:][right], number[1:][down]])
    links = coo_array((np.ones(len(start), np.int8), (start, end)), (inside.size, inside.size))
    _, part = connected_components(links, directed=False)
    part = part.reshape(inside.shape)
    on_line = part[inside & (trace.near <= max(float(trace.near[inside].min(initial=1)), 1e-3))]
    drawn = part[inside & (trace.near * 8 < 1)]
    chosen = np.unique(drawn if len(drawn) else on_line)
    return np.asarray(inside & np.isin(part, chosen))
