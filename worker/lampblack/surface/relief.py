"""The relief mesh: the character's front surface, skirted and closed at the back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import cells
from .beneath import SUNK, Beneath, find_beneath
from .coarse import fans, flat_blocks, hidden_blocks, one_part
from .nodes import Nodes, place_nodes

BACK_DEPTH = 0.5
"""The back mirrors the front at this share of its height, so that light from the side or from
behind meets a round body instead of a flat card."""
HIDDEN_STRIDE = 2
"""Pixels between the vertices of a piece that nobody sees, in a coarse mesh."""
THICKNESS = 1.0
"""Pixels between the front and the back where the front is lowest."""


@dataclass(frozen=True)
class Relief:
    """A closed triangle mesh in canvas pixels: x right, y down, z towards the viewer.

    Pixel (row, column) has its centre at ``(column + 0.5, row + 0.5)``. The first vertices are the
    front. Unless the mesh is coarse, they are half of all, and vertex ``i + V / 2`` lies straight
    behind vertex ``i``.

    Attributes:
        vertices: (V, 3) float32.
        faces: (F, 3) int32, counter-clockwise seen from outside in the right-handed frame
            (x, -y, z), so that the normals of the front point at the viewer.
        bodies: (V,) int16, the body of each vertex, bottom first; None if there is only one.
        front: number of vertices of the front; None if it is not known.
    """

    vertices: NDArray[np.float32]
    faces: NDArray[np.int32]
    bodies: NDArray[np.int16] | None = None
    front: int | None = None


def build_relief(
    height: NDArray[np.float32],
    mask: NDArray[np.bool_],
    *,
    stride: int = 1,
    relief_scale: float = 1.0,
    parts: NDArray[np.integer[Any]] | None = None,
) -> Relief:
    """Mesh the height map, one vertex for each block of ``stride`` x ``stride`` pixels.

    The silhouette is the mask's outline with its pixel corners cut. Where the height changes
    far more than the slopes on either side imply, the surface is cut: the part in front has a
    back of its own there, and the surface behind goes on beneath it, see ``beneath.py``. Every
    front vertex has one behind it and every open edge has a wall, so the mesh is closed.

    Args:
        height: (H, W) float32, pixels towards the viewer.
        mask: (H, W) bool, True inside the character.
        stride: pixels between vertices.
        relief_scale: multiplies the height (1 / gamma in the paper's eq. 4).
        parts: (H, W). If they are given, triangles are larger on the back, and where the front is
            nearly flat and of one part.

    Raises:
        ValueError: the shapes differ, the height is not finite, or the stride is below 1.
    """
    if height.ndim != 2 or height.shape != mask.shape:
        raise ValueError(f"height {height.shape} and mask {mask.shape} are not the same (H, W)")
    if stride < 1:
        raise ValueError(f"stride {stride} is below 1")
    if not (np.isfinite(relief_scale) and np.isfinite(height[mask]).all()):
        raise ValueError("the height or its scale is not finite")
    nodes = place_nodes(height, mask, stride)
    nodes = replace(nodes, points=nodes.points * np.array([1, 1, relief_scale], np.float32))
    beneath = find_beneath(nodes, stride, BACK_DEPTH, THICKNESS)
    if beneath is None:
        return _closed(nodes, stride, parts)
    seen = _closed(nodes, stride, parts, beneath.back)
    hidden = _hidden(beneath, mask, stride, coarse=parts is not None)
    if hidden is None:
        return seen
    return replace(joined_reliefs([seen, hidden]), bodies=None)


def _hidden(
    beneath: Beneath, mask: NDArray[np.bool_], stride: int, *, coarse: bool
) -> Relief | None:
    """The piece of the surface behind that goes on beneath what is in front."""
    rows, columns = np.flatnonzero(beneath.inside.any(1)), np.flatnonzero(beneath.inside.any(0))
    if not len(rows):
        return None
    # Blocks have an empty frame around the canvas.
    top, left = (int(found[0]) - 1 for found in (rows, columns))
    box = slice(top + 1, int(rows[-1]) + 1), slice(left + 1, int(columns[-1]) + 1)
    height, inside = (
        plane[box].repeat(stride, axis=0).repeat(stride, axis=1)
        for plane in (beneath.height, beneath.inside)
    )
    part = mask[stride * top :, stride * left :][: inside.shape[0], : inside.shape[1]]
    inside = inside[: part.shape[0], : part.shape[1]].astype(bool) & part
    if not inside.any():
        return None
    height = height[: part.shape[0], : part.shape[1]].astype(np.float32)
    # Nobody sees the piece.
    grain = max(stride, HIDDEN_STRIDE) if coarse else stride
    one = np.zeros(inside.shape, np.int16) if coarse else None
    piece = _closed(place_nodes(height, inside, grain), grain, one)
    shift = np.array([stride * left, stride * top, SUNK * (stride - grain)], np.float32)
    return replace(piece, vertices=piece.vertices + shift)


def _closed(
    nodes: Nodes,
    stride: int,
    parts: NDArray[np.integer[Any]] | None,
    own_back: NDArray[np.float32] | None = None,
) -> Relief:
    """The front of ``nodes`` with walls and a back.

    Args:
        stride, parts: see ``build_relief``.
        own_back: (R, C) float32, height of the back behind each node; NaN where it mirrors the
            front.
    """
    front = nodes.points
    back = front.copy()
    back[:, 2] = np.minimum(front[:, 2], -BACK_DEPTH * np.maximum(front[:, 2], 0)) - THICKNESS
    if own_back is not None:
        own = np.isfinite(own_back)
        for number in (nodes.number, *nodes.rim.values()):
            vertex = number[own & (number >= 0)]
            level = own_back[own & (number >= 0)]
            back[vertex, 2] = np.minimum(level, front[vertex, 2] - THICKNESS)
    mesh = _Grid(nodes)
    if parts is None:
        seen = hidden = mesh.triangles()
    else:
        level, behind = (np.append(points[:, 2], 0)[nodes.number] for points in (front, back))
        column, row = front[:, :2].astype(np.intp).T
        part = np.append(parts[row.clip(0, len(parts) - 1), column.clip(0, len(parts[0]) - 1)], -1)
        alike = mesh.whole & one_part(part[nodes.number])
        seen = mesh.triangles(flat_blocks(level, alike, stride))
        hidden = mesh.triangles(hidden_blocks(level, behind, mesh.whole))
    below = np.int32(len(front))
    a, b = mesh.open_edges[:, 1], mesh.open_edges[:, 0]
    walls = np.stack([a, b, b + below, a, b + below, a + below], axis=1).reshape(-1, 3)
    faces = np.concatenate([seen, hidden[:, ::-1] + below, walls]).astype(np.int32, copy=False)
    whole = Relief(np.concatenate([front, back]), faces, front=len(front))
    return whole if parts is None else _without_unused(whole)


def _without_unused(relief: Relief) -> Relief:
    """Without the vertices that no face has."""
    used = np.zeros(len(relief.vertices), bool)
    used[relief.faces] = True
    renumbered = np.cumsum(used, dtype=np.int32) - 1
    front = int(np.count_nonzero(used[: relief.front]))
    return Relief(relief.vertices[used], renumbered[relief.faces], front=front)


def joined_reliefs(reliefs: Sequence[Relief]) -> Relief:
    """The reliefs of several bodies as one, bottom first; they stay closed meshes of their own."""
    counts = [relief.front or 0 for relief in reliefs]
    fronts = [relief.vertices[:count] for relief, count in zip(reliefs, counts, strict=True)]
    backs = [relief.vertices[count:] for relief, count in zip(reliefs, counts, strict=True)]
    number = np.arange(len(reliefs), dtype=np.int16)
    faces, start, below = [], 0, sum(counts)
    for relief, count, back in zip(reliefs, counts, backs, strict=True):
        behind = relief.faces >= count
        faces.append(relief.faces + np.where(behind, np.int32(below - count), np.int32(start)))
        start, below = start + count, below + len(back)
    return Relief(
        np.concatenate([*fronts, *backs]),
        np.concatenate(faces).astype(np.int32, copy=False),
        np.concatenate([np.repeat(number, [len(side) for side in s]) for s in (fronts, backs)]),
        sum(counts),
    )


def check_relief(relief: Relief) -> list[str]:
    """Faults of the mesh, one sentence each; empty for a valid mesh.

    Finds vertices that are not finite, faces with vertices that do not exist, degenerate faces,
    and edges that are not shared by exactly two faces of the same winding.
    """
    vertices, faces = relief.vertices, relief.faces
    if len(faces) == 0:
        return ["The mesh has no faces."]
    wrong = []
    if not np.isfinite(vertices).all():
        wrong.append("Some vertices are not finite.")
    if faces.min() < 0 or faces.max() >= len(vertices):
        return [*wrong, "Some faces name vertices that do not exist."]
    corner = vertices[faces].astype(np.float64)
    area = np.linalg.norm(
        np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1
    )
    if not (area > 0).all():
        wrong.append(f"{np.count_nonzero(~(area > 0))} faces are degenerate.")
    start = faces.astype(np.int64)
    end = np.roll(start, -1, axis=1)
    there = np.sort((start * len(vertices) + end).ravel())
    back = np.sort((end * len(vertices) + start).ravel())
    if (there[1:] == there[:-1]).any() or not np.array_equal(there, back):
        wrong.append("The mesh is not closed, or its faces are not wound alike.")
    return wrong


class _Grid:
    """Triangles and edges of the surface on ``nodes``.

    Attributes:
        whole: (R - 1, C - 1) bool, cells with four nodes and four links.
        open_edges: (E, 2) int32, directed edges where the surface ends.
    """

    def __init__(self, nodes: Nodes) -> None:
        rows, columns = nodes.number.shape[0] - 1, nodes.number.shape[1] - 1
        window = [(slice(r, r + rows), slice(c, c + columns)) for r, c in cells.CORNERS]
        side = [nodes.link_down[:, :-1], nodes.link_right[1:], nodes.link_down[:, 1:]]
        side.append(nodes.link_right[:-1])
        code = np.zeros((rows, columns), np.uint8)
        for k in range(4):
            code[nodes.number[window[k]] >= 0] |= np.uint8(1 << k)
            code[side[k]] |= np.uint8(16 << k)
        self._nodes = nodes
        self._quad = [nodes.number[w] for w in window]
        slots = list(self._quad)
        for k in range(4):
            ahead, behind = cells.HEADINGS[k]
            slots += [nodes.rim[ahead][window[k]], nodes.rim[behind][window[(k + 1) % 4]]]
        self.whole = code == cells.WHOLE
        self._pieces, open_edges = [], [np.zeros((0, 2), np.int32)]
        for value in np.unique(code):
            if value in (0, cells.WHOLE):
                continue
            at = code == value
            found = cells.pieces(int(value))
            self._pieces += [np.stack([slots[s][at] for s in t], axis=1) for t in found.triangles]
            open_edges += [np.stack([slots[s][at] for s in e], axis=1) for e in found.open_edges]
        self.open_edges = _once(np.concatenate(open_edges), len(nodes.points))

    def triangles(self, block: NDArray[np.uint8] | None = None) -> NDArray[np.int32]:
        """(F, 3); the cells of each ``block``, see ``coarse.py``, as one fan."""
        alone = self.whole if block is None else self.whole & (block == 0)
        quads = _split_quads(self._nodes.points, [corner[alone] for corner in self._quad])
        larger = [] if block is None else [fans(self._nodes.number, block)]
        return np.concatenate([quads, *larger, *self._pieces])


def _once(edges: NDArray[np.int32], count: int) -> NDArray[np.int32]:
    """Without edges that are there twice: a step one link long opens the same edge in both of its
    cells, and the two cancel."""
    low, high = edges.min(axis=1).astype(np.int64), edges.max(axis=1)
    _, first, times = np.unique(low * count + high, return_index=True, return_counts=True)
    found: NDArray[np.int32] = edges[first[times == 1]]
    return found


def _split_quads(points: NDArray[np.float32], quad: list[NDArray[np.int32]]) -> NDArray[np.int32]:
    """Two triangles per quad, along the flatter diagonal unless that flips one of them."""
    p = [points[corner] for corner in quad]

    def turned(a: int, b: int, c: int) -> NDArray[np.bool_]:
        u, v = p[b] - p[a], p[c] - p[a]
        return np.asarray(u[:, 0] * v[:, 1] >= u[:, 1] * v[:, 0])

    bad_02 = turned(0, 1, 2) | turned(0, 2, 3)
    bad_13 = turned(0, 1, 3) | turned(1, 2, 3)
    flatter = np.abs(p[1][:, 2] - p[3][:, 2]) < np.abs(p[0][:, 2] - p[2][:, 2])
    use_13 = np.where(bad_02 == bad_13, flatter, bad_02)
    a, b, c, d = quad
    along_02 = np.stack([a, b, c, a, c, d], axis=1)
    along_13 = np.stack([a, b, d, b, c, d], axis=1)
    return np.where(use_13[:, None], along_13, along_02).reshape(-1, 3)
