"""From a grid of nodes to polygons: marching squares that can also cut between nodes.

A cell is the square between four neighbouring nodes. Its corners are counted counter-clockwise
as the viewer sees them (rows run down): top left, bottom left, bottom right, top right. Side k
joins corner k to corner k + 1. A side is linked if the surface continues along it. A node ends
half way along every side that is not linked, in a *rim* vertex of its own.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from itertools import pairwise

CORNERS = ((0, 0), (1, 0), (1, 1), (0, 1))
"""(row, column) of the corners within the cell."""

HEADINGS = (("down", "up"), ("right", "left"), ("up", "down"), ("left", "right"))
"""For side k: the direction from its first corner to its second, and the reverse."""

WHOLE = 0b1111_1111
"""The code of a cell with four nodes and four linked sides."""


def rim_slot(corner: int, side: int) -> int:
    """Slots 0 to 3 are the corners; 4 to 11 are two rims per side, first corner's then second's."""
    return 4 + 2 * side + (corner != side)


@dataclass(frozen=True)
class Pieces:
    """Surface of one cell, by slot: its triangles and its open edges."""

    triangles: tuple[tuple[int, int, int], ...]
    open_edges: tuple[tuple[int, int], ...]


@cache
def pieces(code: int) -> Pieces:
    """Cut up a cell that is not ``WHOLE``.

    Args:
        code: bit k says that corner k is a node, bit 4 + k that side k is linked.
    """
    node = [bool(code >> k & 1) for k in range(4)]
    linked = [bool(code >> (4 + k) & 1) for k in range(4)]
    triangles: list[tuple[int, int, int]] = []
    open_edges: list[tuple[int, int]] = []
    for first in range(4):
        if not node[first] or linked[first - 1]:
            continue
        run = [first]
        while linked[run[-1]]:
            run.append((run[-1] + 1) % 4)
        start = rim_slot(first, (first - 1) % 4)
        end = rim_slot(run[-1], run[-1])
        # A fan about the second corner of the run: no triangle lies along one side.
        about = len(run) > 2
        ring = [*run[about:], end, start, *run[:about]]
        triangles += [(ring[0], a, b) for a, b in pairwise(ring[1:])]
        open_edges.append((end, start))
    return Pieces(tuple(triangles), tuple(open_edges))
