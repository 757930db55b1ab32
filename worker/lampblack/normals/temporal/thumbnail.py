"""A drawing and its predicted normals, made small: all that its neighbours need of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .window import Planes, Window, window_around

_REACH = 6.0
"""Coarse cells over which the silhouette is felt."""


@dataclass(frozen=True, eq=False)
class RegistrationThumbnail:
    """About 4 MB, whatever the size of the drawing.

    Attributes:
        name: of the content, such as a digest: miniatures of one name are the same.
        window: around the figure.
        features: (6, h, w) float32, coarse: what of the drawing can be recognised in the next.
        centre: (row, column) of the figure's centroid, coarse cells.
        vectors: (3, 2h, 2w) float32, fine: predicted normals, x right, y up, z to the viewer.
        inside: (2h, 2w) float32, fine: share of the cell that the figure covers.
    """

    name: str
    window: Window
    features: Planes
    centre: tuple[float, float]
    vectors: Planes
    inside: NDArray[np.float32]


def make_thumbnail(
    name: str,
    lines: NDArray[np.float32],
    mask: NDArray[np.bool_],
    albedo: NDArray[np.float32],
    normals: NDArray[np.float32],
) -> RegistrationThumbnail:
    """Make a drawing small.

    Args:
        name: of the content.
        lines: (H, W) float32 ink in 0..1. mask: (H, W) bool, not empty.
        albedo: (H, W, 3) float32 sRGB in 0..1.
        normals: (H, W, 3) float32, unit in the mask, 0 outside.
    """
    window = window_around(mask)
    inside = mask[..., None].astype(np.float32)
    seen = window.see(
        np.dstack([inside, lines[..., None] * inside, albedo * inside]), window.coarse
    )
    fine = window.see(np.dstack([inside, normals * inside]), window.fine)
    row, column = ndimage.center_of_mass(seen[0])
    return RegistrationThumbnail(
        name=name,
        window=window,
        features=_features(seen[0], seen[1], seen[2:]),
        centre=(float(row), float(column)),
        vectors=fine[1:] / np.maximum(fine[0], 1e-3),
        inside=fine[0],
    )


def _features(inside: Planes, lines: Planes, colour: Planes) -> Planes:
    """Nearness to the silhouette, ink, wide ink and colour; their ranges say how much each
    weighs. Flat colour has no texture: the silhouette's distance and the wide ink lend it some."""
    figure = inside > 0.5
    signed = ndimage.distance_transform_edt(figure) - ndimage.distance_transform_edt(~figure)
    planes = [
        0.5 * np.tanh((signed - np.sign(signed) * 0.5) / _REACH),
        ndimage.gaussian_filter(lines, 0.7),
        2 * ndimage.gaussian_filter(lines, 2.5),
        *(2 * ndimage.gaussian_filter(plane, 0.7) for plane in colour),
    ]
    stacked: Planes = np.stack(planes).astype(np.float32)
    return stacked
