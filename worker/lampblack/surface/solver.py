"""Inflation: from a normal map to a height map, with either solver."""

from __future__ import annotations

import warnings
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import ndimage

from ..choices import SolverName
from ..errors import LampblackError, LampblackWarning
from .direct import inflate_direct

NZ_FLOOR = 0.05
"""Smallest nz. The steepest slope is 1 / NZ_FLOOR = 20 pixels per pixel: at a rim nz goes to 0,
and the normals no longer determine the height."""


class Solver(Protocol):
    """Heights (H, W) from usable normals; each connected part is known up to a constant."""

    def __call__(
        self, normals: NDArray[np.float32], mask: NDArray[np.bool_]
    ) -> NDArray[np.float32]: ...


def _adam(normals: NDArray[np.float32], mask: NDArray[np.bool_]) -> NDArray[np.float32]:
    try:
        from .adam import inflate_adam
    except ImportError as error:
        raise LampblackError(
            "The solver adam needs a part of Lampblack that is not installed.",
            "Install it: pip install 'lampblack[torch]'. Or leave out --solver.",
        ) from error
    return inflate_adam(normals, mask)


SOLVERS: dict[str, Solver] = {"direct": inflate_direct, "adam": _adam}


def solve(
    normals: ArrayLike, mask: ArrayLike, solver: SolverName = "direct"
) -> NDArray[np.float32]:
    """Inflate a normal map (paper, section 3.2).

    Args:
        normals: (H, W, 3), x right, y up, z to the viewer; passed to ``usable_normals`` first.
        mask: (H, W) bool, True inside the character.
        solver: "direct", the exact minimum on a compact stencil, or "adam", the paper's 500
            steps of gradient descent.

    Returns:
        (H, W) float32, pixels towards the viewer, 0 outside; the border of each connected
        part lies at height 0 on average.

    Raises:
        ValueError: the shapes do not fit, or there is no such solver.
    """
    if solver not in SOLVERS:
        raise ValueError(f"no solver {solver!r}; there are {', '.join(SOLVERS)}")
    inside = np.asarray(mask, dtype=bool)
    usable = usable_normals(normals, inside)
    return rest_on_border(SOLVERS[solver](usable, inside), inside)


def usable_normals(normals: ArrayLike, mask: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Unit normals with nz of at least ``NZ_FLOOR``, 0 outside the mask.

    Pixels without a direction (zero or not finite) take that of the nearest pixel with one, with
    a ``LampblackWarning``.

    Raises:
        ValueError: ``normals`` is not (H, W, 3) or ``mask`` not (H, W).
    """
    n = np.array(normals, dtype=np.float32)
    if n.ndim != 3 or n.shape[2] != 3 or mask.shape != n.shape[:2]:
        raise ValueError(f"normals {n.shape} and mask {mask.shape} are not (H, W, 3) and (H, W)")
    with np.errstate(over="ignore", invalid="ignore"):
        length = np.linalg.norm(n, axis=2)
        good = np.isfinite(length) & (length > 1e-3)
    lost = mask & ~good
    if lost.any():
        warnings.warn(
            f"{np.count_nonzero(lost)} pixels of the normal map have no direction; "
            "they take that of their neighbours.",
            LampblackWarning,
            stacklevel=3,
        )
        known = mask & good
        if known.any():
            nearest = ndimage.distance_transform_edt(
                ~known, return_distances=False, return_indices=True
            )
            n[lost] = n[tuple(nearest[:, lost])]
            length[lost] = np.linalg.norm(n[lost], axis=1)
        else:
            n[lost], length[lost] = (0, 0, 1), 1
    n[~mask], length[~mask] = 0, 1
    n /= length[..., None]
    n[..., 2] = np.where(mask, np.maximum(n[..., 2], NZ_FLOOR), 0)
    return n


def rest_on_border(height: NDArray[np.float32], mask: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Shift every connected part so that the mean height of its border is 0.

    An edge where the canvas cuts the character off is no border. Such pixels count only in a
    part that has no other border.
    """
    parts, count = ndimage.label(mask)
    labels = parts[mask]
    edge = ~ndimage.binary_erosion(mask, border_value=1)[mask]
    pixels = np.bincount(labels, minlength=count + 1)
    on_edge = np.bincount(labels, weights=edge, minlength=count + 1)
    counted = np.where(on_edge[labels] > 0, edge, True)
    total = np.bincount(labels, weights=height[mask] * counted, minlength=count + 1)
    mean = total / np.maximum(np.where(on_edge > 0, on_edge, pixels), 1)
    rested = np.zeros(mask.shape, np.float32)
    rested[mask] = height[mask] - mean[labels]
    return rested
