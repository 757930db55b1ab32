"""Baselines that use the silhouette alone.

Lumo (Johnston 2002) interpolates the normals of the outline; Poisson inflation (the family of
Ink-and-Ray and Monster Mash) solves for a height whose square obeys a Poisson equation.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy import ndimage, sparse
from scipy.sparse import linalg

from .resize import resize

_SOLVE_PX = 320


def lumo_normals(mask: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Lumo (Johnston 2002): normals of the outline lie in the picture plane and point outwards;
    inside, x and y are interpolated (Laplace) and z completes them to unit length.

    Args:
        mask: (H, W) bool.

    Returns:
        (H, W, 3) float32, x right, y up, z to the viewer; unit in the mask, 0 outside.
    """
    small = _shrink(mask)
    return _complete(_from_outline(small.astype(np.float32), small), small, mask)


def interpolated_outline(
    share: NDArray[np.float32], small: NDArray[np.bool_]
) -> NDArray[np.float32]:
    """Lumo's normals on a coarse grid: (h, w, 3) float32, 0 outside.

    Args:
        share: (h, w) share of each cell that the character covers.
        small: (h, w) bool, cells that count as character.
    """
    plane = _from_outline(np.pad(share, 1), np.pad(small, 1))[1:-1, 1:-1]
    plane /= np.maximum(np.linalg.norm(plane, axis=2, keepdims=True), 1.0)
    z = np.sqrt(np.maximum(1 - np.square(plane).sum(axis=2, keepdims=True), 0))
    normals: NDArray[np.float32] = np.concatenate([plane, z], axis=2).astype(np.float32)
    return normals * small[..., None]


def _from_outline(share: NDArray[np.float32], small: NDArray[np.bool_]) -> NDArray[np.float64]:
    """(h, w, 2) x and y of the outline's normals, harmonic inside."""
    soft = ndimage.gaussian_filter(share, 1.5)
    down, right = np.gradient(-soft)
    outward = np.stack([right, -down], axis=2)
    outward /= np.maximum(np.linalg.norm(outward, axis=2, keepdims=True), 1e-9)
    rim = small & ~ndimage.binary_erosion(small)
    inner = small & ~rim
    plane: NDArray[np.float64] = np.where(rim[..., None], outward, 0.0).astype(np.float64)
    plane[inner] = _solve_poisson(inner, np.zeros(inner.sum()), plane)
    return plane


def inflated_normals(mask: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Normals of the height ``sqrt(u)`` where ``laplace(u) = -4`` and u = 0 on the outline,
    which makes a disk a hemisphere. Shapes as in ``lumo_normals``."""
    small = _shrink(mask)
    boundary = np.zeros((*small.shape, 1))
    squared = np.zeros(small.shape)
    squared[small] = _solve_poisson(small, np.full(small.sum(), 4.0), boundary)[:, 0]
    # Of a surface z^2 = u the normal is (-u_x, -u_y, 2 z), without dividing by a vanishing z.
    down, right = np.gradient(squared)
    vectors = np.stack([-right, down, 2 * np.sqrt(np.maximum(squared, 0))], axis=2)
    vectors /= np.maximum(np.linalg.norm(vectors, axis=2, keepdims=True), 1e-9)
    return _complete(vectors[..., :2], small, mask)


def flat_normals(mask: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Every normal faces the viewer; shapes as in ``lumo_normals``."""
    normals = np.zeros((*mask.shape, 3), np.float32)
    normals[mask, 2] = 1
    return normals


def _shrink(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The mask at the resolution of the solve, with a border of outside pixels."""
    step = max(1.0, max(mask.shape) / _SOLVE_PX)
    size = [max(1, round(side / step)) for side in mask.shape]
    share = Image.fromarray(mask.astype(np.float32)).resize(
        (size[1], size[0]), Image.Resampling.BOX
    )
    return np.pad(np.asarray(share) > 0.4, 1)


def _solve_poisson(
    inside: NDArray[np.bool_], source: NDArray[np.float64], boundary: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Solve ``-laplace(u) = source`` at the (n,) inside pixels; elsewhere ``u = boundary``."""
    if not len(source):
        return np.zeros((0, boundary.shape[2]))
    index = np.full(inside.shape, -1)
    index[inside] = np.arange(inside.sum())
    right_side = np.repeat(source[:, None], boundary.shape[2], axis=1).astype(float)
    rows, columns = [], []
    for axis in (0, 1):
        for shift in (1, -1):
            neighbour = np.roll(index, shift, axis)[inside]
            outside = neighbour < 0
            right_side[outside] += np.roll(boundary, shift, axis)[inside][outside]
            rows.append(index[inside][~outside])
            columns.append(neighbour[~outside])
    row, column = np.concatenate(rows), np.concatenate(columns)
    count = len(source)
    links = sparse.csc_matrix((np.full(len(row), -1.0), (row, column)), shape=(count, count))
    solved: NDArray[np.float64] = linalg.splu(
        links + 4 * sparse.identity(count, format="csc")
    ).solve(right_side)
    return solved


def _complete(
    plane: NDArray[np.float64], small: NDArray[np.bool_], mask: NDArray[np.bool_]
) -> NDArray[np.float32]:
    """Resize x and y to the size of ``mask``, and add the z that makes them unit vectors."""
    nearest = ndimage.distance_transform_edt(~small, return_distances=False, return_indices=True)
    filled = plane[tuple(nearest)][1:-1, 1:-1]
    resized = resize(filled.astype(np.float32), mask.shape).transpose(2, 0, 1)
    length = np.maximum(np.hypot(*resized), 1.0)
    x, y = resized / length
    z = np.sqrt(np.maximum(1 - x * x - y * y, 0))
    normals: NDArray[np.float32] = (np.stack([x, y, z], axis=2) * mask[..., None]).astype(
        np.float32
    )
    return normals
