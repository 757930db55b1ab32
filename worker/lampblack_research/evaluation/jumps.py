"""Where the depth of a figure jumps: links between pixels, and pairs of points beside them.

All lengths are shares of the figure's length, the longer side of its box, so that the same drawing
at another resolution gives the same figures.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

JUMP = 0.02
"""Difference of depth between neighbouring pixels that is a jump."""
STEP = 0.01
"""Difference of depth between neighbouring pixels that is a step: what is compared as smooth keeps
away from it."""
BESIDE = 0.5
"""A jump exceeds the slopes beside it by this share of its threshold: a steep slope is no jump."""
REACH = 0.0075
"""Distance from a jump to the points that are compared on either side."""

_BLUR_PX = 2.0
_MOST_PAIRS = 4000

Image = NDArray[np.float32]
Mask = NDArray[np.bool_]
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Pairs:
    """Pairs of points: ``row``, ``column`` of their middles, pixels, (N,); ``down``, ``right``,
    unit vectors from the second point to the first, (N,); ``reach``, pixels from the middle to
    either point."""

    row: Floats
    column: Floats
    down: Floats
    right: Floats
    reach: float

    def __len__(self) -> int:
        return len(self.row)

    def only(self, which: NDArray[np.bool_] | NDArray[np.intp]) -> Pairs:
        """Some of the pairs."""
        return Pairs(
            self.row[which], self.column[which], self.down[which], self.right[which], self.reach
        )

    def along(self, distance: float) -> tuple[Floats, Floats]:
        """Rows and columns of the points that many pixels from the middles, towards the first."""
        return self.row + distance * self.down, self.column + distance * self.right

    def difference(self, height: Image) -> Image:
        """(N,) ``height`` at the first points less that at the second; nan outside."""
        first, second = (nearest(height, *self.along(s * self.reach)) for s in (1, -1))
        return first - second

    def crosses_step(self, height: Image, limit: float) -> Mask:
        """(N,) whether ``height`` changes by more than ``limit`` within a pixel between the
        points. Places without a height count as no step."""
        found, last = np.zeros(len(self), bool), None
        for distance in _samples(self.reach):
            here = nearest(height, *self.along(distance))
            if last is not None:
                found |= np.abs(here - last) > limit
            last = here
        return found


def figure_length(inside: Mask) -> int:
    """Longer side of the box around (H, W) ``inside``, pixels."""
    rows, columns = np.flatnonzero(inside.any(axis=1)), np.flatnonzero(inside.any(axis=0))
    return int(max(rows[-1] - rows[0], columns[-1] - columns[0])) + 1


def nearest(image: NDArray[np.generic], row: Floats, column: Floats) -> Image:
    """(N,) float32 values of the nearest pixels; nan beyond the picture."""
    r, c = np.round(row).astype(int), np.round(column).astype(int)
    there = (r >= 0) & (c >= 0) & (r < image.shape[0]) & (c < image.shape[1])
    values = np.full(row.shape, np.nan, np.float32)
    values[there] = image[r[there], c[there]]
    return values


def jump_links(depth: Image, limit: float, beside: float | None = None) -> tuple[Mask, Mask]:
    """Links of ``depth``, nan outside, that are jumps: to the right (H, W - 1) and down (H - 1, W).

    Args:
        limit: least difference of neighbours, pixels.
        beside: least excess over the slopes of the links on either side, pixels; None for none.
    """
    return _along_rows(depth, limit, beside), _along_rows(depth.T, limit, beside).T


def beside_links(right: Mask, down: Mask, shape: tuple[int, ...]) -> Mask:
    """The pixels at the ends of links."""
    pixels = np.zeros(shape, bool)
    pixels[:, :-1] |= right
    pixels[:, 1:] |= right
    pixels[:-1] |= down
    pixels[1:] |= down
    return pixels


def links_as_pairs(depth: Image, jump: float, length: int) -> Pairs:
    """A pair around every jump link of ``depth``, across the edge, its first point nearer to the
    viewer; ``jump`` as a share of ``length``. Not all of them are sound: see ``jump_pairs``."""
    links = jump_links(depth, jump * length, BESIDE * jump * length)
    nearer = [np.sign(np.nan_to_num(np.diff(depth, axis=axis))) for axis in (1, 0)]
    across, over = np.zeros(depth.shape), np.zeros(depth.shape)
    signed = np.where(links[0], nearer[0], 0)
    across[:, :-1] += signed
    across[:, 1:] += signed
    signed = np.where(links[1], nearer[1], 0)
    over[:-1] += signed
    over[1:] += signed
    across, over = (ndimage.gaussian_filter(plane, _BLUR_PX) for plane in (across, over))
    (r, c), (s, d) = np.nonzero(links[0]), np.nonzero(links[1])
    row, column = np.concatenate([r, s + 0.5]), np.concatenate([c + 0.5, d])
    at = tuple(
        np.minimum(np.round(x).astype(int), size - 1)
        for x, size in zip((row, column), depth.shape, strict=True)
    )
    down, right = over[at], across[at]
    size = np.hypot(down, right)
    known = size > 1e-6
    unit = np.maximum(size, 1e-6)
    return Pairs(row, column, down / unit, right / unit, REACH * length).only(known)


def jump_pairs(depth: Image, length: int, jump: float = JUMP) -> tuple[Pairs, Image]:
    """Sound pairs across the jumps of ``depth``, nan outside, at most 4000; and their jumps.

    A pair is sound if all between its points lies in the figure, crosses no other step, and its
    points differ by more than ``jump`` of ``length``.
    """
    pairs = links_as_pairs(depth, jump, length)
    jumps = pairs.difference(depth)
    sound = np.isfinite(jumps) & (jumps > jump * length)
    for side in (1, -1):
        last = None
        for distance in [*np.arange(1.5, pairs.reach + 0.01, 1.0).tolist(), pairs.reach]:
            here = nearest(depth, *pairs.along(side * distance))
            sound &= np.isfinite(here)
            if last is not None:
                sound &= ~(np.abs(here - last) > STEP * length)
            last = here
    kept = np.flatnonzero(sound)
    if len(kept) > _MOST_PAIRS:
        kept = kept[np.linspace(0, len(kept) - 1, _MOST_PAIRS).astype(int)]
    return pairs.only(kept), jumps[kept]


def distance_from_steps(depth: Image, length: int) -> Floats:
    """(H, W) pixels to the nearest step of ``depth``; very far without one."""
    at_step = beside_links(*jump_links(depth, STEP * length), depth.shape)
    if not at_step.any():
        return np.full(depth.shape, 1e9)
    distance: Floats = ndimage.distance_transform_edt(~at_step)
    return distance


def smooth_pairs(
    depth: Image, length: int, *, number: int = 30_000, clear: float = 0.015, slope: float = 0.005
) -> Pairs:
    """Random pairs in the figure, all of them ``clear`` of steps (share of ``length``), where no
    slope exceeds ``slope`` of ``length`` a pixel. ``number`` are tried; the same at every run."""
    far = distance_from_steps(depth, length)
    rng = np.random.default_rng(0)
    rows, columns = np.nonzero(np.isfinite(depth))
    pick = rng.integers(len(rows), size=number)
    angle = rng.uniform(0, 2 * np.pi, number)
    row, column = rows[pick].astype(float), columns[pick].astype(float)
    pairs = Pairs(row, column, np.sin(angle), np.cos(angle), REACH * length)
    sound = ~pairs.crosses_step(depth, slope * length)
    for distance in _samples(pairs.reach):
        at = pairs.along(distance)
        sound &= np.isfinite(nearest(depth, *at)) & (nearest(far, *at) > clear * length)
    return pairs.only(sound)


def _samples(reach: float) -> Floats:
    return np.linspace(-reach, reach, int(2 * reach) + 2)


def _along_rows(depth: Image, limit: float, beside: float | None) -> Mask:
    rise = np.nan_to_num(np.diff(depth, axis=1))
    size = np.abs(rise)
    jumps: Mask = size > limit
    if beside is not None:
        same_way = rise[:, 1:] * rise[:, :-1] > 0
        slope = np.zeros_like(size)
        slope[:, 1:] = np.where(same_way, size[:, :-1], 0)
        slope[:, :-1] = np.maximum(slope[:, :-1], np.where(same_way, size[:, 1:], 0))
        jumps &= size - slope > beside
    return jumps
