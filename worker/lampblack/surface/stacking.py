"""Stacking: bodies on layers of their own rest on one another.

Each body gets a *base*, a smooth surface under it. The base of the lowest is 0. That of each other
body lies as low as it can while the body's back rests on what is below, and it is as smooth as the
body is large: an arm is straight where it lies across a belly. Where the base is free, it goes on
at the same level. At a joint, where the artist left the outline open, the body starts at the
surface below. The front of a body lies above everything below it, so what is painted on top is on
top.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, sparse
from scipy.sparse.linalg import spsolve

from .relief import BACK_DEPTH, THICKNESS

CELLS = 512
"""Cells along the longer side of the grid on which bodies are compared."""
COARSE = 8
"""Cells from one node of a base to the next."""
GAP = 0.04
"""Space between a body and what it rests on; share of its width."""
STRAIGHT = 0.5
"""Bends of a base are longer than about this share of the body's longer side."""
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

    def at(self, x: NDArray[np.floating], y: NDArray[np.floating]) -> Floats:  # type: ignore[type-arg]
        """The base at places of the drawing, in pixels."""
        where = [(y - self.top) / self.spacing, (x - self.left) / self.spacing]
        found: Floats = ndimage.map_coordinates(self.nodes, where, order=1, mode="nearest")
        return found.astype(np.float32)


FLAT = Base(np.zeros((1, 1)), 0.0, 0.0, 1.0)


def stack(sheets: Sequence[Sheet]) -> list[Base]:
    """The base of each body, bottom first."""
    grid = _Grid.around(sheets)
    bases = [FLAT]
    below = np.full(grid.shape, -np.inf)
    _raise(below, grid.reduced(sheets[0]), FLAT, grid)
    for sheet in sheets[1:]:
        seen = grid.reduced(sheet)
        base = _rest(sheet, seen, below, grid)
        bases.append(base)
        _raise(below, seen, base, grid)
    return bases


@dataclass(frozen=True, eq=False)
class _Seen:
    """A sheet on the common grid: the highest and lowest point of each cell."""

    highest: NDArray[np.float64]
    lowest: NDArray[np.float64]
    joint: NDArray[np.float64]
    inside: Mask


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
        rows, columns = (
            (int(side // (cell * COARSE)) + 1) * COARSE for side in (bottom - top, right - left)
        )
        return _Grid(left, top, cell, (rows, columns))

    def reduced(self, sheet: Sheet) -> _Seen:
        """``sheet`` on this grid."""
        rows = self._cells(sheet.top - self.top, sheet.scale, sheet.mask.shape[0])
        columns = self._cells(sheet.left - self.left, sheet.scale, sheet.mask.shape[1])

        def most(values: NDArray[np.floating], empty: float) -> NDArray[np.float64]:  # type: ignore[type-arg]
            kept = np.where(sheet.mask, values, empty)
            (r, first_row), (c, first_column) = (
                np.unique(at, return_index=True) for at in (rows, columns)
            )
            kept = np.maximum.reduceat(kept, first_row, axis=0)
            kept = np.maximum.reduceat(kept, first_column, axis=1)
            whole = np.full(self.shape, empty, np.float64)
            whole[np.ix_(r, c)] = kept
            return whole

        highest = most(sheet.height, -np.inf)
        lowest = -most(-sheet.height, -np.inf)
        return _Seen(highest, lowest, most(sheet.joint, 0.0), np.isfinite(highest))

    def _cells(self, start: float, scale: float, count: int) -> NDArray[np.intp]:
        return ((start + (np.arange(count) + 0.5) * scale) / self.cell).astype(np.intp)

    def at_cells(self, base: Base) -> NDArray[np.float64]:
        """The base in the middle of each cell."""
        rows, columns = ((np.arange(size) + 0.5) * self.cell for size in self.shape)
        x, y = np.meshgrid(columns + self.left, rows + self.top)
        return base.at(x, y).astype(np.float64)


def _raise(below: NDArray[np.float64], seen: _Seen, base: Base, grid: _Grid) -> None:
    """Put a body onto the surface ``below``."""
    front = grid.at_cells(base) + np.where(seen.inside, seen.highest, 0)
    below[seen.inside] = np.maximum(below, front)[seen.inside]


def _rest(sheet: Sheet, seen: _Seen, below: NDArray[np.float64], grid: _Grid) -> Base:
    """The base of a body that rests on the surface ``below``."""
    over = seen.inside & np.isfinite(below)
    if not over.any():
        return FLAT
    ground = np.where(over, below, 0)
    highest, lowest = (np.where(over, plane, 0) for plane in (seen.highest, seen.lowest))
    visible = ground - lowest + THICKNESS
    resting = ground + np.maximum(BACK_DEPTH * highest, -lowest) + THICKNESS + GAP * sheet.width
    least = np.where(over, resting + seen.joint * (visible - resting), -np.inf)

    rows, columns = grid.shape[0] // COARSE, grid.shape[1] // COARSE
    blocks = least.reshape(rows, COARSE, columns, COARSE)
    inside = seen.inside.reshape(rows, COARSE, columns, COARSE).any(axis=(1, 3))
    heed = np.where(over, 1 + HELD * seen.joint, 0)
    share = heed.reshape(rows, COARSE, columns, COARSE).mean(axis=(1, 3))
    total = heed * np.where(over, least, 0)
    total = total.reshape(rows, COARSE, columns, COARSE).mean(axis=(1, 3))
    used, bound = _around(inside, 0), _around(blocks.max(axis=(1, 3)), -np.inf)
    weight, pull = (_around(plane, 0.0, np.add) for plane in (share, total))
    longest = max(sheet.mask.shape) * sheet.scale / (COARSE * grid.cell)
    nodes = np.zeros(used.shape)
    nodes[used] = _settled(used, bound[used], weight[used], pull[used], STRAIGHT * longest)
    nodes = _continued(_lifted(nodes, used, bound), used)
    return Base(nodes, grid.left, grid.top, COARSE * grid.cell)


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
