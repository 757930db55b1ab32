"""How fast and how close to the least energy each solver inflates a normal map."""

from __future__ import annotations

import time

import numpy as np
from numpy.typing import NDArray

from ..surface.adam import inflate_adam
from ..surface.direct import inflate_direct
from ..surface.energy import energy_compact, energy_paper
from ..surface.solver import usable_normals

WARM_RUNS = 3


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
        "masked_pixels": float(np.count_nonzero(mask)),
    }
