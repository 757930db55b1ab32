"""Speed and final energy of both inflation solvers."""

from __future__ import annotations

import time

import numpy as np
from numpy.typing import NDArray

from ..surface.adam import inflate_adam
from ..surface.direct import inflate_direct
from ..surface.energy import energy_compact, energy_paper
from ..surface.solver import usable_normals

WARM_RUNS = 3


ELLIPSOIDS = (
    (0.0, -0.02, 0.27, 0.33, 0.25, 0.0),
    (0.0, 0.29, 0.20, 0.19, 0.20, 0.1),
    (-0.26, 0.02, 0.21, 0.11, 0.10, 0.05),
    (0.26, -0.06, 0.21, 0.11, 0.10, 0.1),
    (-0.15, -0.34, 0.13, 0.15, 0.14, 0.08),
    (0.16, -0.34, 0.13, 0.15, 0.14, 0.08),
)
"""Body, head, arms and legs: centre x and y (up), half axes x, y and z, lift; as shares of
the canvas."""


def synthetic_character(size: int = 1000) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """Exact normals (size, size, 3) and mask of a standing character made of ellipsoids.

    Its limbs overlap, so the normals have creases and rims inside the mask. At the default size
    over 400 000 pixels are inside.
    """
    row, column = np.indices((size, size))
    x, y = (column + 0.5) / size - 0.5, 0.5 - (row + 0.5) / size
    top = np.full((size, size), -np.inf)
    normals = np.zeros((size, size, 3))
    for centre_x, centre_y, a, b, c, lift in ELLIPSOIDS:
        u, v = (x - centre_x) / a, (y - centre_y) / b
        w = np.sqrt(np.maximum(1 - u**2 - v**2, 0))
        over = (w > 0) & (c * w + lift > top)
        top[over] = (c * w + lift)[over]
        n = np.stack([u / a, v / b, w / c], axis=2)[over]
        normals[over] = n / np.linalg.norm(n, axis=1, keepdims=True)
    return normals.astype(np.float32), np.isfinite(top)


def bench_inflate(normals: NDArray[np.float32], mask: NDArray[np.bool_]) -> dict[str, float]:
    """Inflate with both solvers, one after the other, and compare.

    Args:
        normals: (H, W, 3), x right, y up, z to the viewer.
        mask: (H, W) bool, True inside the figure.

    Returns:
        ``seconds_direct``: wall seconds, best of three warm runs;
        ``seconds_adam``: wall seconds of the paper's 500 steps, one run;
        ``speedup_direct_over_adam``: their ratio;
        ``energy_direct``, ``energy_adam``: in the paper's kernels (eq. 5 and 6), no unit;
        ``energy_direct_compact``, ``energy_adam_compact``: on the compact stencil;
        ``masked_pixels``: size of the figure.
    """
    usable = usable_normals(normals, mask)
    inflate_direct(usable, mask)
    seconds = []
    for _ in range(WARM_RUNS):
        start = time.perf_counter()
        direct = inflate_direct(usable, mask)
        seconds.append(time.perf_counter() - start)
    start = time.perf_counter()
    adam = inflate_adam(usable, mask)
    seconds_adam = time.perf_counter() - start
    return {
        "seconds_direct": min(seconds),
        "seconds_adam": seconds_adam,
        "speedup_direct_over_adam": seconds_adam / min(seconds),
        "energy_direct": energy_paper(direct, usable, mask),
        "energy_adam": energy_paper(adam, usable, mask),
        "energy_direct_compact": energy_compact(direct, usable, mask),
        "energy_adam_compact": energy_compact(adam, usable, mask),
        "masked_pixels": int(np.count_nonzero(mask)),
    }
