"""The input of the character network: a whole character placed on a canvas of fixed area."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .resize import resize
from .silhouette import interpolated_outline

COARSE = 4
"""Canvas pixels per cell of the coarse maps."""

FINE_CHANNELS = 2
COARSE_CHANNELS = 11
LUMO = slice(0, 3)
SIDEWAYS = (0, 4, 8)
"""Coarse channels that change sign when the character is mirrored."""

MARGIN = 8
_STEP = 32

Plane = NDArray[np.float32]


@dataclass(frozen=True)
class Canvas:
    """A canvas of ``shape`` with the character's box of ``size`` in its middle, both (rows,
    columns) in pixels and even, so that a mirrored character gives the mirror image."""

    shape: tuple[int, int]
    size: tuple[int, int]

    @property
    def inner(self) -> tuple[slice, slice]:
        """The box's rows and columns on the canvas."""
        rows, columns = ((n - m) // 2 for n, m in zip(self.shape, self.size, strict=True))
        return slice(rows, rows + self.size[0]), slice(columns, columns + self.size[1])


def bounding_box(mask: NDArray[np.bool_]) -> tuple[slice, slice]:
    """The rows and columns of the box around a mask that is not empty."""
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    return slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)


def canvases(side: int) -> list[tuple[int, int]]:
    """Shapes of about ``side`` squared pixels: square, 3:2 and 9:4, portrait and landscape."""
    shapes = []
    for aspect in (1.0, 1.54, 2.3):
        long = round(side * aspect**0.5 / _STEP) * _STEP
        short = round(side / aspect**0.5 / _STEP) * _STEP
        shapes += [(long, short), (short, long)] if long != short else [(long, short)]
    return shapes


def canvas_for(shape: tuple[int, ...], side: int, zoom: float = 1.0) -> Canvas:
    """The canvas that a box of ``shape`` fills best; ``zoom`` below 1 makes the box smaller."""

    def scale(canvas: tuple[int, int]) -> float:
        return min((n - 2 * MARGIN) / m for n, m in zip(canvas, shape, strict=True))

    best = max(canvases(side), key=lambda canvas: scale(canvas) ** 2 / (canvas[0] * canvas[1]))
    factor = scale(best) * zoom
    rows, columns = (max(2, 2 * round(m * factor / 2)) for m in shape)
    return Canvas(best, (rows, columns))


def place(image: Plane, canvas: Canvas) -> Plane:
    """(H, W, C) box -> (canvas rows, canvas columns, C), zero around it. Averages when it
    shrinks, interpolates when it enlarges."""
    placed = np.zeros((*canvas.shape, image.shape[2]), np.float32)
    placed[canvas.inner] = resize(image, canvas.size)
    return placed


def extend_outside(vectors: Plane, mask: NDArray[np.bool_]) -> Plane:
    """Fill pixels outside the mask with the nearest vector inside, so that resizing mixes in
    no zeros."""
    nearest = ndimage.distance_transform_edt(~mask, return_distances=False, return_indices=True)
    result: Plane = vectors[tuple(nearest)]
    return result


def shape_maps(mask: NDArray[np.bool_]) -> Plane:
    """(8, h, w) float32 coarse maps of the (H, W) canvas mask: Lumo's normal, the square root
    of the distance to the silhouette, its gradient, and the position in the character."""
    rows, columns = (n // COARSE for n in mask.shape)
    share = mask.reshape(rows, COARSE, columns, COARSE).mean(axis=(1, 3), dtype=np.float32)
    small = share > 0.5
    lumo = interpolated_outline(share, small)
    distance = ndimage.distance_transform_edt(np.pad(small, 1))[1:-1, 1:-1].astype(np.float32)
    down, right = np.gradient(ndimage.gaussian_filter(distance, 1.0))
    where = np.indices(small.shape, np.float32) + 0.5
    y, x = (2 * where[i] / n - 1 for i, n in enumerate(small.shape))
    longest = max(small.shape)
    maps = [*lumo.transpose(2, 0, 1), np.sqrt(distance) / 4, right, -down]
    maps += [x * columns / longest, -y * rows / longest]
    result: Plane = (np.stack(maps) * small).astype(np.float32)
    return result


def ink_cells(ink: Plane) -> NDArray[np.bool_]:
    """(h, w): the cells of the (H, W) canvas with ink in them."""
    rows, columns = (n // COARSE for n in ink.shape)
    most = ink.reshape(rows, COARSE, columns, COARSE).max(axis=(1, 3))
    drawn: NDArray[np.bool_] = most > 0.25
    return drawn


def ink_maps(ink: Plane) -> Plane:
    """(2, h, w) float32: proximity to the ink of the (H, W) canvas, narrow and wide."""
    drawn = ink_cells(ink)
    distance = ndimage.distance_transform_edt(~drawn) if drawn.any() else np.full(drawn.shape, 99.0)
    result: Plane = np.stack([np.exp(-distance / 2), np.sqrt(distance) / 4]).astype(np.float32)
    return result


def coarse_maps(shape: Plane, ink: Plane, hints: Plane | None = None) -> Plane:
    """(11, h, w): ``shape_maps`` with ``ink_maps`` between the gradient and the position; then the
    hints, (h, w), see ``bend_strokes.stroke_cells``."""
    said = np.zeros(shape.shape[1:], np.float32) if hints is None else hints
    return np.concatenate([shape[:6], ink_maps(ink), shape[6:], said[None]])
