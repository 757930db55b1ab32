"""Passes brought to the size of the drawing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def enlarge(image: NDArray[np.float32], size: tuple[int, int]) -> NDArray[np.float32]:
    """Bilinear, (h, w, 3) to (H, W, 3) for ``size`` = (W, H); outer pixel edges coincide, so
    the centre of column ``i`` lies at ``(i + 0.5) * w / W - 0.5`` among the old columns."""
    width, height = size
    return _along(_along(image, width, 1), height, 0)


def _along(image: NDArray[np.float32], count: int, axis: int) -> NDArray[np.float32]:
    old = image.shape[axis]
    if old == count:
        return image
    at = np.clip((np.arange(count) + 0.5) * old / count - 0.5, 0, old - 1)
    before = at.astype(np.intp)
    after = np.minimum(before + 1, old - 1)
    shape = [1, 1, 1]
    shape[axis] = count
    share = (at - before).astype(np.float32).reshape(shape)
    first = image.take(before, axis)
    return first + share * (image.take(after, axis) - first)
