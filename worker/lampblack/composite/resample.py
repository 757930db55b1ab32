"""Passes resampled to the size of the drawing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Box = tuple[float, float, float, float]
"""x, y, width, height in pixels of a drawing."""


@dataclass(frozen=True)
class Band:
    """Rows ``top`` to ``bottom`` of a picture of ``width`` x ``height``. Large pictures are
    composited band by band, which bounds the memory."""

    width: int
    height: int
    top: int
    bottom: int


def enlarge(image: NDArray[np.float32], band: Band) -> NDArray[np.float32]:
    """Bilinear, (h, w, 3) to (bottom - top, width, 3). The outer edges of the whole pictures
    coincide, so the centre of column ``i`` lies at ``(i + 0.5) * w / width - 0.5`` in the old
    columns."""
    rows = _along(image, band.height, np.arange(band.top, band.bottom), 0)
    return _along(rows, band.width, np.arange(band.width), 1)


def _along(
    image: NDArray[np.float32], count: int, wanted: NDArray[np.intp], axis: int
) -> NDArray[np.float32]:
    old = image.shape[axis]
    if old == count:
        return image if len(wanted) == old else image[wanted[0] : wanted[-1] + 1]
    at = np.clip((wanted + 0.5) * old / count - 0.5, 0, old - 1)
    before = at.astype(np.intp)
    after = np.minimum(before + 1, old - 1)
    shape = [1, 1, 1]
    shape[axis] = len(wanted)
    share = (at - before).astype(np.float32).reshape(shape)
    first: NDArray[np.float32] = image.take(before, axis)
    change: NDArray[np.float32] = share * (image.take(after, axis) - first)
    return first + change
