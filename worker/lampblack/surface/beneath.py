"""What lies beneath an overlap: the back of the part in front, and the surface behind that goes on.

Without this, a part in front is a solid column down to the relief's back, and no light gets
under an arm. So its back mirrors its front about the rim that the overlap gives it, and the
surface behind continues under it, as a closed piece of its own that nobody sees from the front.
Both end smoothly some way from the overlap, where the parts are one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..compiled import compiled
from .nodes import Nodes

REACH = 0.2
"""How far under the part in front; share of the longer side of the character's box."""
SOLID = 0.6
"""Share of the reach from which the part in front thickens to the relief's back."""
SUNK = 0.5
"""How much lower the hidden piece lies than what it continues, so that it stays hidden; share of
the distance between nodes."""
_STRIP = 2
"""Nodes of the visible surface behind that the hidden piece begins with."""
_CONE = 0.5
"""Cosine between a step's direction and that from the step to a node beneath whose part it goes
on: it goes on straight ahead, not around its end."""

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class Beneath:
    """On the grid of nodes, R x C.

    Attributes:
        back: (R, C) float32, height of the back; NaN where it is the relief's.
        height: (R, C) float32, the surface behind as it goes on. inside: (R, C) bool, where.
    """

    back: Floats
    height: Floats
    inside: NDArray[np.bool_]


def find_beneath(nodes: Nodes, stride: int, depth: float, thickness: float) -> Beneath | None:
    """None if nothing overlaps.

    Args:
        nodes: heights as they are meshed, in pixels. stride: pixels from node to node.
        depth: share of its front's height that a back has.
        thickness: pixels between front and back where the front is lowest.
    """
    occupied = nodes.number >= 0
    level = np.zeros(occupied.shape, np.float32)
    level[occupied] = nodes.points[nodes.number[occupied], 2]
    steps = _steps(level, occupied, nodes.link_right, nodes.link_down)
    if not len(steps):
        return None
    rows, columns = np.flatnonzero(occupied.any(1)), np.flatnonzero(occupied.any(0))
    reach = REACH * (float(max(np.ptp(rows), np.ptp(columns))) + 1)
    origin, distance = _flood(
        steps[:, :4].astype(np.int32), nodes.link_right, nodes.link_down, occupied, reach
    )
    _close_gaps(origin, distance, occupied)
    found = origin >= 0
    rim, behind = (np.where(found, steps[origin, k], 0) for k in (4, 5))
    mirrored = rim - depth * np.maximum(level - rim, 0) - thickness
    solid = np.minimum(level, -depth * np.maximum(level, 0)) - thickness
    share = np.clip((1 - distance / reach) / (1 - SOLID), 0, 1)
    share = share * share * (3 - 2 * share)
    back = np.minimum(solid + (mirrored - solid) * share, level - thickness)
    hollow = found & (back > behind)
    height = np.where(hollow, behind, level) - SUNK * stride
    strip = _strip(steps, occupied, hollow)
    return Beneath(
        np.where(found, back, np.nan).astype(np.float32),
        height.astype(np.float32),
        hollow | strip,
    )


def _steps(
    level: Floats,
    occupied: NDArray[np.bool_],
    link_right: NDArray[np.bool_],
    link_down: NDArray[np.bool_],
) -> NDArray[np.float64]:
    """(S, 6) row and column of the nearer node, those of the step to it from the farther one,
    and the heights of both."""
    found = [np.zeros((0, 6))]
    for axis, link in enumerate((link_down, link_right)):
        first = tuple(slice(0, -1) if k == axis else slice(None) for k in range(2))
        second = tuple(slice(1, None) if k == axis else slice(None) for k in range(2))
        rise = level[second] - level[first]
        at = np.nonzero(occupied[first] & occupied[second] & ~link & (rise != 0))
        ahead = rise[at] > 0
        to = [(1, 0), (0, 1)][axis]
        near = [where + ahead * to[k] for k, where in enumerate(at)]
        sign = np.where(ahead, 1, -1)
        low, high = level[first][at], level[second][at]
        heights = np.where(ahead, high, low), np.where(ahead, low, high)
        found.append(np.stack([*near, sign * to[0], sign * to[1], *heights], axis=1))
    steps = np.concatenate(found)
    # The highest first: of two steps at one node it counts.
    return steps[np.argsort(steps[:, 5] - steps[:, 4], kind="stable")]


def _strip(
    steps: NDArray[np.float64], occupied: NDArray[np.bool_], hollow: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """The first nodes of the surface behind, seen from the steps."""
    strip = np.zeros(occupied.shape, bool)
    row, column, down, right = steps[:, :4].astype(np.intp).T
    for back in range(1, _STRIP + 1):
        r, c = row - back * down, column - back * right
        on = (r >= 0) & (c >= 0) & (r < occupied.shape[0]) & (c < occupied.shape[1])
        on &= hollow[row, column]
        strip[r[on], c[on]] = True
    return strip & occupied & ~hollow


@compiled
def _flood(
    steps: NDArray[np.int32],
    link_right: NDArray[np.bool_],
    link_down: NDArray[np.bool_],
    occupied: NDArray[np.bool_],
    reach: float,
) -> tuple[NDArray[np.int32], Floats]:
    """The nearest step of each node of a part in front, -1 beyond ``reach``, and its distance."""
    rows, columns = occupied.shape
    origin = np.full((rows, columns), -1, np.int32)
    distance = np.full((rows, columns), np.float32(np.inf), np.float32)
    size = rows * columns
    queue = np.empty(size, np.int32)
    waiting = np.zeros(size, np.bool_)
    begin, count = 0, 0
    for s in range(len(steps)):
        r, c = steps[s, 0], steps[s, 1]
        if origin[r, c] < 0:
            origin[r, c], distance[r, c] = s, 0
            queue[count] = r * columns + c
            waiting[r * columns + c] = True
            count += 1
    while count:
        at = queue[begin]
        begin = (begin + 1) % size
        count -= 1
        waiting[at] = False
        r, c = at // columns, at % columns
        s = origin[r, c]
        for down, right in ((-1, 0), (0, -1), (0, 1), (1, 0)):
            i, j = r + down, c + right
            if i < 0 or j < 0 or i >= rows or j >= columns or not occupied[i, j]:
                continue
            linked = link_right[r, min(c, j)] if right else link_down[min(r, i), c]
            if not linked:
                continue
            y, x = i - steps[s, 0], j - steps[s, 1]
            away = np.float32(np.sqrt(y * y + x * x))
            if away > reach or away >= distance[i, j]:
                continue
            if away > 1.5 and y * steps[s, 2] + x * steps[s, 3] < _CONE * away:
                continue
            origin[i, j], distance[i, j] = s, away
            if not waiting[i * columns + j]:
                queue[(begin + count) % size] = i * columns + j
                waiting[i * columns + j] = True
                count += 1
    return origin, distance


@compiled
def _close_gaps(origin: NDArray[np.int32], distance: Floats, occupied: NDArray[np.bool_]) -> None:
    """Give nodes between reached ones the step of a neighbour: between the cones of two steps
    they would stand as thin walls, and throw shadows."""
    rows, columns = origin.shape
    for _ in range(_STRIP):
        before = origin.copy()
        for r in range(1, rows - 1):
            for c in range(1, columns - 1):
                if before[r, c] >= 0 or not occupied[r, c]:
                    continue
                for down, right in ((0, 1), (1, 0), (1, 1), (1, -1)):
                    if before[r - down, c - right] >= 0 and before[r + down, c + right] >= 0:
                        origin[r, c] = before[r - down, c - right]
                        distance[r, c] = max(
                            distance[r - down, c - right], distance[r + down, c + right]
                        )
                        break
