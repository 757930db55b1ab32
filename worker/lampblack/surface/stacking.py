"""Stacking: bodies on layers of their own rest on one another.

Each body gets a *base*, a smooth surface under it. The base of the lowest is 0. That of each other
body lies as low as it can while the body's back rests on what is below, and it is as smooth as the
body is large: an arm is straight where it lies across a belly. Beyond that it falls back to the
paper. At a joint, where the artist left the outline open, the body starts at the
surface below. The front of a body lies above everything below it, so what is painted on top is on
top.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, sparse
from scipy.sparse.linalg import spsolve

from .relief import BACK_DEPTH, THICKNESS

CELLS = 1024
"""Cells along the longer side of the grid on which bodies are compared."""
NODES = 48
"""Nodes of a base along its longer side."""
GAP = 0.04
"""Space between a body and what it rests on; share of its width."""
DEEPEST = 0.06
"""The back of a deeper body sinks into what is below it: a figure is not as deep as all of its
parts together. Share of the drawing's longer side."""
STRAIGHT = 0.5
"""Bends of a base are longer than about this share of the body's longer side."""
FALL = 0.2
"""Beyond what it rests on, a body falls back to the paper over about this share of the drawing's
longer side."""
HELD = 1000.0
"""How much more the base heeds a joint than what it merely lies on."""
_FIRM = 1e4
_FREE = 1e-6
_ROUNDS = 20

Floats = NDArray[np.float32]
Sample = TypeVar("Sample", bound=np.generic)
Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Sheet:
    """A body's own surface.

    Attributes:
        height: (h, w) float32, pixels of the drawing towards the viewer, about 0 at its border.
        mask: (h, w) bool.
        joint: (h, w) float32 in 0..1, 1 where the body grows out of what is below it.
        left, top: corner in pixels of the drawing. scale: pixels of the drawing per element.
        width: of the body at its widest place, pixels of the drawing.
    """

    height: Floats
    mask: Mask
    joint: Floats
    left: float
    top: float
    scale: float
    width: float


@dataclass(frozen=True, eq=False)
class Base:
    """The base of a body: bilinear between ``nodes``.

    Attributes:
        nodes: (R, C) float64, pixels of the drawing towards the viewer.
        left, top: place of the first node. spacing: from node to node. All in drawing pixels.
    """

    nodes: NDArray[np.float64]
    left: float
    top: float
    spacing: float

    def at(self, x: NDArray[np.floating[Any]], y: NDArray[np.floating[Any]]) -> Floats:
        """The base at places of the drawing, in pixels."""
        where = [(y - self.top) / self.spacing, (x - self.left) / self.spacing]
        found: Floats = ndimage.map_coordinates(self.nodes, where, order=1, mode="nearest")
        return found.astype(np.float32)


FLAT = Base(np.zeros((1, 1)), 0.0, 0.0, 1.0)


def stack(sheets: Sequence[Sheet]) -> list[Base]:
    """The base of each body, bottom first."""
    grid = _Grid.around(sheets)
    below = _Below(np.full(grid.shape, -np.inf), np.zeros(grid.shape, bool))
    bases: list[Base] = []
    for sheet in sheets:
        seen = grid.reduced(sheet)
        base = _rest(sheet, seen, below, grid) if bases else FLAT
        bases.append(base)
        below.add(seen, base, grid)
    return bases


@dataclass(frozen=True, eq=False)
class _Seen:
    """A sheet on the cells of the common grid that it touches.

    Attributes:
        place: those cells.
        highest, lowest: (r, c) its highest and lowest point in each.
        joint: (r, c) as in the sheet.
        inside, whole: (r, c) whether it is in a cell, and whether it fills it.
    """

    place: tuple[slice, slice]
    highest: NDArray[np.float64]
    lowest: NDArray[np.float64]
    joint: NDArray[np.float64]
    inside: Mask
    whole: Mask


@dataclass(frozen=True)
class _Grid:
    """Cells over all sheets; pixels of the drawing per cell."""

    left: float
    top: float
    cell: float
    shape: tuple[int, int]

    @staticmethod
    def around(sheets: Sequence[Sheet]) -> _Grid:
        left, top = min(s.left for s in sheets), min(s.top for s in sheets)
        right = max(s.left + s.mask.shape[1] * s.scale for s in sheets)
        bottom = max(s.top + s.mask.shape[0] * s.scale for s in sheets)
        cell = max(*(s.scale for s in sheets), (right - left) / CELLS, (bottom - top) / CELLS)
        rows, columns = (int(side // cell) + 1 for side in (bottom - top, right - left))
        return _Grid(left, top, cell, (rows, columns))

    @property
    def longest(self) -> float:
        """The longer side in pixels of the drawing."""
        return self.cell * max(self.shape)

    def reduced(self, sheet: Sheet) -> _Seen:
        """``sheet`` on this grid."""
        rows, first_row = self._cells(sheet.top - self.top, sheet.scale, sheet.mask.shape[0])
        columns, first_column = self._cells(
            sheet.left - self.left, sheet.scale, sheet.mask.shape[1]
        )

        def most(values: NDArray[Any]) -> NDArray[Any]:
            values = np.maximum.reduceat(values, first_row, axis=0)
            return np.asarray(np.maximum.reduceat(values, first_column, axis=1))

        inside = most(sheet.mask)
        return _Seen(
            place=(rows, columns),
            highest=most(np.where(sheet.mask, sheet.height, -np.inf)),
            lowest=-most(np.where(sheet.mask, -sheet.height, -np.inf)),
            joint=most(np.where(sheet.mask, sheet.joint, 0.0)),
            inside=inside,
            whole=inside & ~most(~sheet.mask),
        )

    def _cells(self, start: float, scale: float, count: int) -> tuple[slice, NDArray[np.intp]]:
        """The cells that ``count`` elements touch, and the first element in each."""
        cells = ((start + (np.arange(count) + 0.5) * scale) / self.cell).astype(np.intp)
        first = np.flatnonzero(np.diff(cells, prepend=cells[0] - 1))
        return slice(int(cells[0]), int(cells[-1]) + 1), first

    def base_at(self, base: Base, place: tuple[slice, slice]) -> NDArray[np.float64]:
        """The base in the middle of each cell."""
        y, x = ((np.arange(at.start, at.stop) + 0.5) * self.cell for at in place)
        return base.at(*np.meshgrid(x + self.left, y + self.top)).astype(np.float64)


@dataclass(frozen=True, eq=False)
class _Below:
    """The surface of the bodies so far: their highest point in each cell, and cells that one of
    them fills."""

    level: NDArray[np.float64]
    whole: Mask

    def add(self, seen: _Seen, base: Base, grid: _Grid) -> None:
        """Put a body on top."""
        front = grid.base_at(base, seen.place) + np.where(seen.inside, seen.highest, -np.inf)
        self.level[seen.place] = np.maximum(self.level[seen.place], front)
        self.whole[seen.place] |= seen.whole


def _rest(sheet: Sheet, seen: _Seen, below: _Below, grid: _Grid) -> Base:
    """The base of a body that rests on the bodies ``below``."""
    # Bodies that only meet share cells along their edge.
    over = seen.inside & below.whole[seen.place]
    if not over.any():
        return FLAT
    ground = np.where(over, below.level[seen.place], 0)
    highest, lowest = (np.where(over, plane, 0) for plane in (seen.highest, seen.lowest))
    visible = ground - lowest + THICKNESS
    back = np.minimum(BACK_DEPTH * highest, DEEPEST * grid.longest)
    resting = ground + np.maximum(back, -lowest) + THICKNESS + GAP * sheet.width
    least = np.where(over, resting + seen.joint * (visible - resting), -np.inf)

    step = max(4, -(-max(over.shape) // NODES))
    heed = np.where(over, 1 + HELD * seen.joint, 0)
    used = _around(_blocks(seen.inside, step, 0).any(axis=2), 0)
    bound = _around(_blocks(least, step, -np.inf).max(axis=2), -np.inf)
    weight = _around(_blocks(heed, step, 0).mean(axis=2), 0.0, np.add)
    towards = heed * np.where(over, least, 0)
    pull = _around(_blocks(towards, step, 0).mean(axis=2), 0.0, np.add)
    spacing = step * grid.cell
    length = STRAIGHT * max(over.shape) / step
    # Beyond what it lies on, the paper pulls too.
    paper = (length * spacing / (FALL * grid.longest)) ** 2
    weight += paper * np.clip(1 - weight, 0, 1)
    nodes = np.zeros(used.shape)
    nodes[used] = _settled(used, bound[used], weight[used], pull[used], length)
    nodes = _continued(_lifted(nodes, used, bound), used)
    rows, columns = seen.place
    left, top = grid.left + columns.start * grid.cell, grid.top + rows.start * grid.cell
    return Base(nodes, left, top, spacing)


def _blocks(cells: NDArray[Sample], step: int, empty: float) -> NDArray[Sample]:
    """(R, C, step * step) blocks of cells."""
    rows, columns = (-(-side // step) for side in cells.shape)
    more = [(0, n * step - side) for n, side in zip((rows, columns), cells.shape, strict=True)]
    framed = np.pad(cells, more, constant_values=empty)
    split = framed.reshape(rows, step, columns, step).swapaxes(1, 2)
    return np.asarray(split.reshape(rows, columns, step * step))


def _around(blocks: NDArray[Sample], empty: float, join: np.ufunc = np.maximum) -> NDArray[Sample]:
    """Of the four blocks that meet at each node."""
    framed = np.pad(blocks, 1, constant_values=empty)
    return np.asarray(
        join(join(framed[:-1, :-1], framed[1:, :-1]), join(framed[:-1, 1:], framed[1:, 1:]))
    )


def _settled(
    used: Mask,
    bound: NDArray[np.float64],
    weight: NDArray[np.float64],
    pull: NDArray[np.float64],
    length: float,
) -> NDArray[np.float64]:
    """The values of the used nodes: as near to the pull as bends of at least ``length`` nodes
    allow, and not under the bound."""
    laplacian = _laplacian(used)
    stiff = (length**4) * (laplacian @ laplacian) + length**2 * laplacian
    # A part of a body that touches nothing stays at 0.
    smooth = stiff + sparse.diags(weight + _FREE)
    target = np.where(np.isfinite(bound), bound, 0)
    values = np.asarray(spsolve(sparse.csc_matrix(smooth), pull))
    held = np.zeros(len(bound), bool)
    for _ in range(_ROUNDS):
        low = values < bound
        if (low == held).all():
            break
        held = low
        firm = sparse.diags(_FIRM * held)
        values = np.asarray(spsolve(sparse.csc_matrix(smooth + firm), pull + _FIRM * held * target))
    return values


def _laplacian(used: Mask) -> sparse.csr_matrix:
    """Of the graph of used nodes and their four neighbours."""
    number = np.full(used.shape, -1)
    number[used] = np.arange(np.count_nonzero(used))
    pairs = [
        (number[:-1].ravel(), number[1:].ravel()),
        (number[:, :-1].ravel(), number[:, 1:].ravel()),
    ]
    a, b = (np.concatenate([pair[side] for pair in pairs]) for side in (0, 1))
    both = (a >= 0) & (b >= 0)
    a, b = a[both], b[both]
    count = np.count_nonzero(used)
    ones = np.ones(len(a))
    joined = sparse.coo_matrix((ones, (a, b)), (count, count)).tocsr()
    joined = joined + joined.T
    return sparse.diags(np.asarray(joined.sum(axis=1)).ravel()) - joined


def _lifted(
    nodes: NDArray[np.float64], used: Mask, bound: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The nodes raised smoothly wherever they are still under the bound."""
    short = np.where(used & np.isfinite(bound), np.maximum(bound - nodes, 0), 0)
    # Every window of the mean lies in the window of the maximum, so the mean is at least it.
    return np.asarray(
        nodes + ndimage.uniform_filter(ndimage.maximum_filter(short, 3, mode="nearest"), 3)
    )


def _continued(nodes: NDArray[np.float64], used: Mask) -> NDArray[np.float64]:
    """Unused nodes like the nearest used ones: the mesh's rim lies a little outside."""
    nearest = ndimage.distance_transform_edt(~used, return_distances=False, return_indices=True)
    return np.asarray(nodes[tuple(nearest)])
