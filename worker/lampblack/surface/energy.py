"""The inflation energy (paper, eq. 3-5), in the paper's kernels and on a compact stencil.

A surface ``z(u, v)`` has the normal ``(-dz/du, -dz/dv, 1)`` up to length, with u right and v
*up*. Rows of an image run down, so ``dz/dv = -dz/drow``: with ``normals`` y-up, the two
tangents of eq. 4 give the residuals

    nx + gamma nz dz/dcolumn        and        ny - gamma nz dz/drow,

and the energy is the sum of their squares. It is quadratic in z. Its minimum is proportional
to 1 / gamma. Each slope has the weight ``nz^2``, so a rim, where slopes are steep and
uncertain, counts little.

The two discretisations differ in how they compute a slope from the heights. Both use only
pixels of the mask: beyond its border there are no heights.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

KERNEL_X = np.array([[-1, 0, 1], [-4, 0, 4], [-1, 0, 1]], dtype=np.float32) / 12
"""d/dcolumn of eq. 6, as a cross-correlation."""
KERNEL_Y = np.array([[1, 4, 1], [0, 0, 0], [-1, -4, -1]], dtype=np.float32) / 12
"""d/dv of eq. 6, v up, as a cross-correlation over rows that run down."""


def whole_windows(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(H, W) bool: pixels whose 3x3 window lies in ``mask``, where eq. 6 is defined."""
    padded = np.pad(mask, 1)
    columns = padded[:, :-2] & padded[:, 1:-1] & padded[:, 2:]
    return np.asarray(columns[:-2] & columns[1:-1] & columns[2:])


def energy_paper(
    height: NDArray[np.float32],
    normals: NDArray[np.float32],
    mask: NDArray[np.bool_],
    gamma: float = 1.0,
) -> float:
    """Eq. 5 with the kernels of eq. 6, summed over the pixels whose window is whole.

    The kernels span two pixels, so a checkerboard of heights has no energy.

    Args:
        height: (H, W) pixels towards the viewer.
        normals: (H, W, 3) unit, x right, y up, z to the viewer.
        mask: (H, W), True inside the character.
        gamma: the inflation scale of eq. 4.
    """
    z = height.astype(np.float64)
    n = normals[1:-1, 1:-1].astype(np.float64)
    right_left = z[:, 2:] - z[:, :-2]
    above_below = z[:-2] - z[2:]
    slope_x = (right_left[:-2] + 4 * right_left[1:-1] + right_left[2:]) / 12
    slope_y = (above_below[:, :-2] + 4 * above_below[:, 1:-1] + above_below[:, 2:]) / 12
    residual_x = n[..., 0] + gamma * n[..., 2] * slope_x
    residual_y = n[..., 1] + gamma * n[..., 2] * slope_y
    inside = whole_windows(mask)[1:-1, 1:-1]
    return float(np.sum((residual_x**2 + residual_y**2)[inside]))


def energy_compact(
    height: NDArray[np.float32],
    normals: NDArray[np.float32],
    mask: NDArray[np.bool_],
    gamma: float = 1.0,
) -> float:
    """Eq. 5 on links: differences of neighbouring pixels against the mean of their normals.

    Every link with both ends in the mask counts once. Only a constant per connected part has no
    energy. Arguments as for ``energy_paper``.
    """
    z = height.astype(np.float64)
    n = normals.astype(np.float64)
    across = (n[:, 1:] + n[:, :-1]) / 2
    down = (n[1:] + n[:-1]) / 2
    residual_x = across[..., 0] + gamma * across[..., 2] * (z[:, 1:] - z[:, :-1])
    residual_y = down[..., 1] + gamma * down[..., 2] * (z[:-1] - z[1:])
    inside_x, inside_y = mask[:, 1:] & mask[:, :-1], mask[1:] & mask[:-1]
    return float(np.sum(residual_x[inside_x] ** 2) + np.sum(residual_y[inside_y] ** 2))
