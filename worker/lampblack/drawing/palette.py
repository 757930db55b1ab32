"""The flat colours of a drawing, keyed by their sRGB value."""

from __future__ import annotations

import warnings
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import LampblackWarning
from .cutout import Colours
from .morphology import Mask, from_nearest, highest, lowest

MAX_SWATCHES = 64

_APART = 10
"""Levels by which at least one channel of two flat colours must differ."""

_SMOOTH = 20
"""Range of levels around a pixel above which the pixel is a mixture of two areas."""

_BELONGS = 28
"""Levels by which a pixel may differ from its swatch."""


@dataclass(frozen=True)
class Swatch:
    """One flat colour: ``#rrggbb`` in sRGB, and its number of pixels in the fill."""

    colour: str
    pixels: int


@dataclass(frozen=True)
class Palette:
    """Swatches, most used first."""

    swatches: tuple[Swatch, ...]

    @property
    def colours(self) -> tuple[str, ...]:
        """``#rrggbb`` of each swatch, in the order of the labels."""
        return tuple(swatch.colour for swatch in self.swatches)


def find_palette(fill: Colours, mask: Mask) -> tuple[Palette, NDArray[np.int16]]:
    """The flat colours of ``fill``, and which of them each pixel has.

    A flat colour is one that neighbouring pixels share exactly. Mixed pixels along edges take
    the label of the nearest pixel that is not mixed. Painted areas have no flat colour. They
    get colours of a fixed lattice, so that their keys are the same from frame to frame.

    Args:
        fill: (H, W, 3) uint8 sRGB, continued under the ink.
        mask: (H, W) bool.

    Returns:
        The palette, and (H, W) int16 indices into it, -1 outside the mask.

    Warns:
        LampblackWarning: the art is painted or has more than ``MAX_SWATCHES`` colours, which
            were grouped.
    """
    packed = _pack(fill)
    smooth = mask & (_spread(fill, 1) <= _SMOOTH)
    if not smooth.any():
        smooth = mask
    # Wide areas first: in an airbrushed gradient a few neighbours share colours by chance.
    flats = _flat_colours(packed, mask & (_spread(fill, 2) == 0), _APART, _no_colours())
    flats = _flat_colours(packed, _shared(packed, smooth), _BELONGS, flats)
    cells = _cells(packed)
    occupied = np.flatnonzero(np.bincount(cells[smooth], minlength=1 << 15))
    centres = _cell_centres(occupied)
    keys, painted = _add_painted(
        flats, centres, np.bincount(cells[smooth], minlength=1 << 15)[occupied]
    )
    if painted:
        warnings.warn(
            f"The drawing is painted in very many colours; they were grouped into {len(keys)}.",
            LampblackWarning,
            stacklevel=2,
        )
    lookup = np.zeros(1 << 15, np.int16)
    lookup[occupied] = _nearest_key(centres, keys)
    labels = _with_exact(lookup[cells], packed, keys)
    if not smooth.all():
        labels = from_nearest(labels, smooth)
    return _most_used_first(keys, np.where(mask, labels, np.int16(-1)))


def _spread(fill: Colours, reach: int) -> NDArray[np.uint8]:
    """The largest range of any channel within ``reach`` of each pixel, in levels."""
    spread = np.zeros(fill.shape[:2], np.uint8)
    for channel in range(3):
        plane = fill[..., channel]
        np.maximum(spread, highest(plane, reach) - lowest(plane, reach), out=spread)
    return spread


def _shared(packed: NDArray[np.int32], smooth: Mask) -> Mask:
    """Smooth pixels with exactly the colour of their left and upper neighbours."""
    same = smooth.copy()
    same[:, 1:] &= packed[:, 1:] == packed[:, :-1]
    same[1:] &= packed[1:] == packed[:-1]
    return same


def _no_colours() -> NDArray[np.int16]:
    return np.zeros((0, 3), np.int16)


def _flat_colours(
    packed: NDArray[np.int32], where: Mask, apart: int, kept: NDArray[np.int16]
) -> NDArray[np.int16]:
    """``kept`` and the colours found ``where``, most used first, each distinct from the others."""
    values, counts = np.unique(packed[where], return_counts=True)
    enough = counts >= max(8, 2e-4 * np.count_nonzero(where))
    order = np.argsort(-counts[enough], kind="stable")
    for colour in _unpack(values[enough][order]):
        if len(kept) == MAX_SWATCHES:
            break
        if not len(kept) or np.abs(kept - colour).max(axis=1).min() >= apart:
            kept = np.vstack([kept, colour])
    return kept


def _add_painted(
    flats: NDArray[np.int16], centres: NDArray[np.int16], counts: NDArray[np.int64]
) -> tuple[NDArray[np.int16], bool]:
    """Add lattice colours for cells that no flat colour represents. Returns also whether these
    are enough pixels for a warning."""
    far = np.ones(len(centres), bool)
    if len(flats):
        far = np.abs(centres[:, None] - flats[None]).max(axis=2).min(axis=1) > _BELONGS
    if not far.any():
        return flats, False
    step = 32
    while True:
        lattice, which = np.unique(centres[far] // step, axis=0, return_inverse=True)
        weight = np.bincount(which.ravel(), counts[far])
        lattice = lattice[weight >= max(4, 5e-4 * counts.sum())]
        if len(lattice) + len(flats) <= MAX_SWATCHES or step == 128:
            break
        step *= 2
    room = MAX_SWATCHES - len(lattice)
    keys = np.vstack([flats[:room], (lattice * step + step // 2).astype(np.int16)])
    if not len(keys):
        keys = centres[[np.argmax(counts)]]
    return keys, bool(counts[far].sum() > 0.05 * counts.sum())


def _cells(packed: NDArray[np.int32]) -> NDArray[np.int32]:
    """The lattice cell of each colour: five bits per channel."""
    return ((packed >> 9) & 0x7C00) | ((packed >> 6) & 0x3E0) | ((packed >> 3) & 0x1F)


def _cell_centres(cells: NDArray[np.int64]) -> NDArray[np.int16]:
    centres = [(cells >> shift & 31) * 8 + 4 for shift in (10, 5, 0)]
    return np.asarray(np.stack(centres, axis=-1), np.int16)


def _pack(colours: NDArray[np.uint8] | NDArray[np.int16]) -> NDArray[np.int32]:
    packed = np.zeros(colours.shape[:-1], np.int32)
    for channel in range(3):
        packed <<= 8
        packed |= colours[..., channel]
    return packed


def _unpack(packed: NDArray[np.int32]) -> NDArray[np.int16]:
    channels = [packed >> shift & 255 for shift in (16, 8, 0)]
    return np.asarray(np.stack(channels, axis=-1), np.int16)


def _nearest_key(colours: NDArray[np.int16], keys: NDArray[np.int16]) -> NDArray[np.int16]:
    nearest = np.zeros(len(colours), np.int16)
    best = np.full(len(colours), np.iinfo(np.int32).max)
    for index, key in enumerate(keys.astype(np.int32)):
        distance = ((colours - key) ** 2).sum(axis=1)
        closer = distance < best
        best[closer] = distance[closer]
        nearest[closer] = index
    return nearest


def _with_exact(
    labels: NDArray[np.int16], packed: NDArray[np.int32], keys: NDArray[np.int16]
) -> NDArray[np.int16]:
    """Two keys may share a cell: a pixel of exactly a key's colour gets that key."""
    codes = _pack(keys)
    order = np.argsort(codes)
    place = np.minimum(np.searchsorted(codes[order], packed), len(codes) - 1)
    exact = codes[order][place] == packed
    return np.where(exact, order[place].astype(np.int16), labels)


def _most_used_first(
    keys: NDArray[np.int16], labels: NDArray[np.int16]
) -> tuple[Palette, NDArray[np.int16]]:
    counts = np.bincount(labels[labels >= 0], minlength=len(keys))
    order = np.argsort(-counts, kind="stable")
    order = order[counts[order] > 0]
    rank = np.full(len(keys) + 1, -1, np.int16)
    rank[order] = np.arange(len(order))
    swatches = tuple(
        Swatch("#{:02x}{:02x}{:02x}".format(*keys[index]), int(counts[index])) for index in order
    )
    return Palette(swatches), rank[labels]
