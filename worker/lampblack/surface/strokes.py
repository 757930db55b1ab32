"""The strokes of a drawing: its ink thinned to lines one pixel wide, as smooth curves.

The ink is thinned (Zhang and Suen 1984), and cut up where lines meet. There, two lines that
continue each other are joined again, so a stroke passes through a junction, and a line that only
reaches it ends there.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.spatial import cKDTree

from .thinning import junctions_of, thinned, trace_lines

SPUR = 0.012
"""A shorter line with a free end is a burr of thinning; share of the character's length."""
STRAIGHT_ON = 0.7
"""Cosine of the largest turn of a stroke through a junction."""
LOOK = 0.02
"""How far along a line its direction at a junction is taken; share of the length."""
GAP = 0.02
"""Largest gap that a stroke bridges; share of the length."""
SMOOTH = 0.004
"""Points are averaged with those this near along the stroke; share of the length."""

Floats = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Stroke:
    """A line of ink.

    Attributes:
        points: (N, 2) float32 x, y in pixels of the ink, about one pixel apart.
        meets: whether the first and the last point lie on another stroke; both False for a free
            stroke.
        closed: whether the last point leads on to the first.
    """

    points: Floats
    meets: tuple[bool, bool]
    closed: bool


def find_strokes(ink: NDArray[np.bool_], length: float) -> list[Stroke]:
    """The strokes of (H, W) ``ink`` of a character of this ``length`` in pixels."""
    thin = thinned(ink)
    pixels, starts, looped = trace_lines(thin)
    junctions, count = ndimage.label(junctions_of(thin), np.ones((3, 3)))
    if count:
        centres = np.array(ndimage.center_of_mass(junctions > 0, junctions, range(1, count + 1)))
    lines = [pixels[a:b].astype(np.float32) for a, b in pairwise(starts)]
    ends = [
        (-1, -1) if loop else (_junction_at(junctions, a[0]), _junction_at(junctions, a[-1]))
        for a, loop in zip(lines, looped, strict=True)
    ]
    kept = [
        index
        for index, (line, (first, last)) in enumerate(zip(lines, ends, strict=True))
        if (first >= 0) == (last >= 0) or len(line) >= SPUR * length
    ]
    for index in kept:
        first, last = ends[index]
        head = [centres[first - 1 : first]] if first > 0 else []
        tail = [centres[last - 1 : last]] if last > 0 else []
        lines[index] = np.concatenate([*head, lines[index], *tail]).astype(np.float32)
    look = max(3, round(LOOK * length))
    partner = _partners(lines, ends, kept, count, look)
    _bridge(lines, ends, looped, kept, partner, look, GAP * length)
    reach = max(1, round(SMOOTH * length))
    found = []
    for points, meets, closed in _joined(lines, ends, looped, kept, partner):
        if len(points) > 2:
            smooth = _smoothed(_even(points[:, ::-1] + 0.5), reach, closed)
            found.append(_reaching(Stroke(smooth, meets, closed), ink, GAP * length))
    return found


def mean_along(
    values: Floats, counted: NDArray[np.bool_], reach: int, *, closed: bool = False
) -> Floats:
    """Means over the points of a line that are ``counted`` and at most ``reach`` points away.

    Args:
        values: (N,). counted: (N,) bool. closed: the last point leads on to the first.

    Returns:
        (N,) float32; 0 where no point near is counted.
    """
    reach = min(reach, (len(values) - 1) // 2)
    mode: Literal["wrap", "constant"] = "wrap" if closed else "constant"
    total = np.cumsum(np.pad(np.where(counted, values, 0).astype(np.float64), reach, mode))
    number = np.cumsum(np.pad(counted.astype(np.float64), reach, mode))
    total, number = (np.concatenate([[0.0], sums]) for sums in (total, number))
    width = 2 * reach + 1
    mean = (total[width:] - total[:-width]) / np.maximum(number[width:] - number[:-width], 1)
    result: Floats = mean.astype(np.float32)
    return result


def _junction_at(junctions: NDArray[np.int32], pixel: Floats) -> int:
    """The junction that touches a pixel; -1 if none does."""
    row, column = int(pixel[0]), int(pixel[1])
    around = junctions[max(row - 1, 0) : row + 2, max(column - 1, 0) : column + 2]
    return int(around.max()) or -1


def _partners(
    lines: list[Floats], ends: list[tuple[int, int]], kept: list[int], count: int, look: int
) -> dict[tuple[int, int], tuple[int, int]]:
    """For each (line, end) that continues in another: that line and its end."""
    at: list[list[tuple[int, int]]] = [[] for _ in range(count + 1)]
    for index in kept:
        for end in (0, 1):
            if ends[index][end] > 0:
                at[ends[index][end]].append((index, end))
    partner: dict[tuple[int, int], tuple[int, int]] = {}
    for arms in at:
        outward = []
        for index, end in arms:
            line = lines[index] if end == 0 else lines[index][::-1]
            ray = line[min(look, len(line) - 1)] - line[0]
            outward.append(ray / max(float(np.hypot(*ray)), 1e-6))
        pairs = sorted(
            (float(outward[i] @ outward[j]), i, j) for i in range(len(arms)) for j in range(i)
        )
        for turn, i, j in pairs:
            met = arms[i] in partner or arms[j] in partner or arms[i][0] == arms[j][0]
            if not met and (turn < -STRAIGHT_ON or len(arms) == 2):
                partner[arms[i]], partner[arms[j]] = arms[j], arms[i]
    return partner


def _bridge(
    lines: list[Floats],
    ends: list[tuple[int, int]],
    looped: NDArray[np.bool_],
    kept: list[int],
    partner: dict[tuple[int, int], tuple[int, int]],
    look: int,
    gap: float,
) -> None:
    """Make partners of free ends that point at each other over a small gap."""
    free = [(i, e) for i in kept for e in (0, 1) if ends[i][e] < 0 and not looped[i]]
    if len(free) < 2:
        return
    tips = np.array([lines[i][0 if e == 0 else -1] for i, e in free])
    inner = np.array(
        [
            lines[i][min(look, len(lines[i]) - 1)] if e == 0 else lines[i][-1 - look :][0]
            for i, e in free
        ]
    )
    outward = (tips - inner) / np.maximum(np.hypot(*(tips - inner).T), 1e-6)[:, None]
    pairs = cKDTree(tips).query_pairs(gap, output_type="ndarray")
    order = np.argsort(np.hypot(*(tips[pairs[:, 0]] - tips[pairs[:, 1]]).T), kind="stable")
    for i, j in pairs[order]:
        across = (tips[j] - tips[i]) / max(float(np.hypot(*(tips[j] - tips[i]))), 1e-6)
        aligned = min(outward[i] @ across, -(outward[j] @ across), -(outward[i] @ outward[j]))
        met = free[i] in partner or free[j] in partner or free[i][0] == free[j][0]
        if not met and aligned > STRAIGHT_ON:
            partner[free[i]], partner[free[j]] = free[j], free[i]


def _even(points: Floats) -> Floats:
    """The same line, with points added where they are further apart than two pixels."""
    apart = np.hypot(*np.diff(points, axis=0).T)
    if not (apart > 2).any():
        return points
    along = np.concatenate([[0], np.cumsum(apart)])
    extra = [np.linspace(a, b, int(b - a) + 1)[1:-1] for a, b in pairwise(along) if b - a > 2]
    at = np.sort(np.concatenate([along, *extra]))
    even: Floats = np.stack([np.interp(at, along, axis) for axis in points.T], axis=1)
    return even.astype(np.float32)


def _reaching(stroke: Stroke, ink: NDArray[np.bool_], gap: float) -> Stroke:
    """The stroke, extended over a small gap to the ink that a free end points at."""
    if stroke.closed:
        return stroke
    points, meets = stroke.points, list(stroke.meets)
    for end in (0, 1):
        line = points if end else points[::-1]
        if not meets[end]:
            ray = _ray_to_ink(line, ink, gap)
            if len(ray):
                line = np.concatenate([line, ray])
                points, meets[end] = (line if end else line[::-1]), True
    return Stroke(points, (meets[0], meets[1]), False)


def _ray_to_ink(line: Floats, ink: NDArray[np.bool_], gap: float) -> Floats:
    """Points from the end of a line straight on, into the first ink beyond its own; none if there
    is no such ink within ``gap`` of its own."""
    back = line[-1 - min(len(line) - 1, 8)]
    ahead = (line[-1] - back) / max(float(np.hypot(*(line[-1] - back))), 1e-6)
    far = np.arange(1, 2 * gap + 2, dtype=np.float32)
    ray = line[-1] + far[:, None] * ahead
    x, y = np.floor(ray).astype(int).T
    seen = (x >= 0) & (y >= 0) & (x < ink.shape[1]) & (y < ink.shape[0])
    drawn = np.zeros(len(ray), bool)
    drawn[seen] = ink[y[seen], x[seen]]
    own = int(np.argmin(drawn))  # where its own ink ends
    hit = np.flatnonzero(drawn[own:])
    if drawn.all() or own > gap or not len(hit) or hit[0] > gap:
        own, hit = -2, np.zeros(1, np.intp)
    reached: Floats = ray[: own + int(hit[0]) + 2].astype(np.float32)
    return reached


def _joined(
    lines: list[Floats],
    ends: list[tuple[int, int]],
    looped: NDArray[np.bool_],
    kept: list[int],
    partner: dict[tuple[int, int], tuple[int, int]],
) -> list[tuple[Floats, tuple[bool, bool], bool]]:
    """Chains of lines that continue each other, each from one of its ends."""
    done: set[int] = set()
    found = []
    starts = [(i, e) for i in kept for e in (0, 1) if (i, e) not in partner]
    starts += [(i, 0) for i in kept]  # what is left after the open chains are rings
    for index, end in starts:
        if index in done:
            continue
        first = ends[index][end] > 0 and (index, end) not in partner
        ring = bool(looped[index]) or (index, end) in partner
        parts = []
        while True:
            done.add(index)
            parts.append(lines[index] if end == 0 else lines[index][::-1])
            leaves = index, 1 - end
            if leaves not in partner or partner[leaves][0] in done:
                break
            index, end = partner[leaves]
        last = ends[leaves[0]][leaves[1]] > 0 and leaves not in partner
        found.append((np.concatenate(parts), (first, last), ring))
    return found


def _smoothed(points: Floats, reach: int, closed: bool) -> Floats:
    """Averages of points with their neighbours along the line; a free end stays in place."""
    count = len(points)
    reach = min(reach, (count - 1) // 2)
    if closed:
        padded = np.concatenate([points[count - reach :], points, points[:reach]])
    else:
        head = 2 * points[0] - points[reach:0:-1]
        tail = 2 * points[-1] - points[count - 2 : count - 2 - reach : -1]
        padded = np.concatenate([head, points, tail])
    total = np.cumsum(np.concatenate([np.zeros((1, 2)), padded]), axis=0)
    mean = (total[2 * reach + 1 :] - total[: -2 * reach - 1]) / (2 * reach + 1)
    result: Floats = mean.astype(np.float32)
    return result
