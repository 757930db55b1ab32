"""Registration thumbnails: a drawing and its predicted normals at low resolution."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .window import Planes, Window, window_around

_REACH = 6.0
"""Coarse cells up to which the distance to the silhouette counts."""


@dataclass(frozen=True, eq=False)
class RegistrationThumbnail:
    """What the temporal filter needs of a drawing; about 4 MB for every size of drawing.

    Attributes:
        name: a digest of the content: thumbnails with the same name are equal.
        window: the box around the character.
        features: (6, h, w) float32, coarse grid: planes by which drawings are registered.
        centre: (row, column) of the character's centroid, coarse cells.
        vectors: (3, 2h, 2w) float32, fine grid: predicted normals, x right, y up, z to the
            viewer.
        inside: (2h, 2w) float32, fine grid: share of the cell that the character covers.
        order: (4, 2h, 2w) float32, fine grid: the drawing's votes on overlaps, x right, y up,
            predicted depth in pixels of the drawing, and how likely an occlusion is; None where
            they are not known.
    """

    name: str
    window: Window
    features: Planes
    centre: tuple[float, float]
    vectors: Planes
    inside: NDArray[np.float32]
    order: Planes | None = None


def make_thumbnail(
    name: str,
    lines: NDArray[np.float32],
    mask: NDArray[np.bool_],
    albedo: NDArray[np.float32],
    normals: NDArray[np.float32],
    order: NDArray[np.float32] | None = None,
) -> RegistrationThumbnail:
    """Make the thumbnail of a drawing.

    Args:
        name: a digest of the content.
        lines: (H, W) float32 ink in 0..1. mask: (H, W) bool, not empty.
        albedo: (H, W, 3) float32 sRGB in 0..1.
        normals: (H, W, 3) float32, unit in the mask, 0 outside.
        order: (H, W, 4) float32 votes, depth and edge, 0 outside the mask.
    """
    window = window_around(mask)
    inside = mask[..., None].astype(np.float32)
    seen = window.to_grid(
        np.dstack([inside, lines[..., None] * inside, albedo * inside]), window.coarse
    )
    planes = [inside, normals * inside] + ([] if order is None else [order * inside])
    fine = window.to_grid(np.dstack(planes), window.fine)
    means = fine[1:] / np.maximum(fine[0], 1e-3)
    row, column = ndimage.center_of_mass(seen[0])
    return RegistrationThumbnail(
        name=name,
        window=window,
        features=_features(seen[0], seen[1], seen[2:]),
        centre=(float(row), float(column)),
        vectors=means[:3],
        inside=fine[0],
        order=None if order is None else means[3:],
    )


def _features(inside: Planes, lines: Planes, colour: Planes) -> Planes:
    """Distance to the silhouette, ink, blurred ink and colour; the range of each plane is its
    weight. Flat colour has no texture: the distance and the blurred ink provide some."""
    mask = inside > 0.5
    signed = ndimage.distance_transform_edt(mask) - ndimage.distance_transform_edt(~mask)
    planes = [
        0.5 * np.tanh((signed - np.sign(signed) * 0.5) / _REACH),
        ndimage.gaussian_filter(lines, 0.7),
        2 * ndimage.gaussian_filter(lines, 2.5),
        *(2 * ndimage.gaussian_filter(plane, 0.7) for plane in colour),
    ]
    stacked: Planes = np.stack(planes).astype(np.float32)
    return stacked
