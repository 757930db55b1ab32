"""Viewpoints as artists choose them: all around, mostly the front, few from below."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .gbuffer import view_rotation

PAPER_VIEWPOINTS = 42
_GOLDEN = 0.6180339887498949


def viewpoint(index: int, rng: np.random.Generator) -> NDArray[np.float32]:
    """(3, 3) rotation of the ``index``-th viewpoint, varied a little by ``rng``.

    The first few are spread evenly, however many, so that an unfinished data set is balanced.
    """
    around = 2 * ((index * _GOLDEN) % 1) - 1
    azimuth = 180 * np.sign(around) * abs(around) ** 1.3 + rng.normal(0, 5)
    height = (index * _GOLDEN * _GOLDEN + 0.37) % 1
    elevation = -14 + 54 * height**1.3 + rng.normal(0, 4)
    return view_rotation(float(azimuth), float(elevation), float(rng.normal(0, 5)))
