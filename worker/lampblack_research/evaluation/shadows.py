"""Shadows that the parts of a figure cast on each other: the truth's against a relief's."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan

import numpy as np
from numpy.typing import NDArray

from ..dataset.rays import RayScene

LIGHTS = ((0.0, 20.0), (45.0, 50.0), (90.0, 30.0), (135.0, 60.0), (180.0, 40.0))
"""Directional lights, degrees: angle in the picture, 0 from the right, 90 from above; and elevation
above the picture plane."""
FACING = 0.1
"""Least cosine between normal and light of a surface that faces the light."""
LIFT = 0.005
"""Height above the surface, along its normal, at which rays start, as a share of the figure's
length. What is nearer casts no shadow that counts."""
PIXEL_STEP = 2
"""Every second pixel of every second row is measured."""
LEAST_PIXELS = 50
"""A drawing with fewer pixels in shadow, over all lights, has no recall or precision."""


@dataclass(frozen=True)
class ShadowFigures:
    """Shares, over the pixels of one drawing and five lights (``LIGHTS``).

    A pixel counts for a light if the true surface faces it, so that the shadow that a surface has
    by its own slope does not count. It is in shadow if the ray from the surface towards the light
    meets the figure again.

    Attributes:
        shadow_recall: of the pixels in shadow in truth, the share that the relief shadows too.
        shadow_precision: of the pixels that the relief shadows, the share in shadow in truth.
    """

    shadow_recall: float
    shadow_precision: float


class ShadowTruth:
    """The true shadows of one drawing.

    Args:
        vertices: (V, 3) float32 of the true mesh, pixels: x right, y up from the lower left
            corner of the picture, z to the viewer. faces: (F, 3), all that cast shadows.
        normals: (H, W, 3) float32 as seen, unit in the mask. mask: (H, W) bool.
        length: the figure's, pixels.
    """

    def __init__(
        self,
        vertices: NDArray[np.float32],
        faces: NDArray[np.int32],
        normals: NDArray[np.float32],
        mask: NDArray[np.bool_],
        length: int,
    ) -> None:
        rows, columns = np.nonzero(mask)
        kept = (rows % PIXEL_STEP == 0) & (columns % PIXEL_STEP == 0)
        rows, columns = rows[kept], columns[kept]
        self._points = np.stack([columns + 0.5, mask.shape[0] - (rows + 0.5)], axis=1)
        self._rows, self._lift = mask.shape[0], LIFT * length
        self._lights = [light_direction(*angles) for angles in LIGHTS]
        self._shadowed, faced = self._trace(vertices, faces)
        seen = normals[rows, columns] @ np.stack(self._lights).T > FACING
        self._counted = seen.T & faced

    def measure(self, vertices: NDArray[np.float32], faces: NDArray[np.int32]) -> ShadowFigures:
        """Measure the shadows of a relief, in canvas pixels: x right, y down, z to the viewer."""
        upright = vertices * np.array([1, -1, 1], np.float32)
        upright[:, 1] += self._rows
        ours = self._trace(upright, faces)[0] & self._counted
        true = self._shadowed & self._counted
        both = int((ours & true).sum())
        return ShadowFigures(*(_share(both, int(all_.sum())) for all_ in (true, ours)))

    def _trace(
        self, vertices: NDArray[np.float32], faces: NDArray[np.int32]
    ) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """(lights, N) at every point: is the surface in shadow, and does its face face the light.
        Points beyond the mesh do neither."""
        scene = RayScene(vertices[faces])
        top = np.full(len(self._points), vertices[:, 2].max() + 1)
        above = np.column_stack([self._points, top]).astype(np.float32)
        hit = scene.first(above, np.tile(np.array([[0, 0, -1]], np.float32), (len(above), 1)))
        met = hit["primID"] >= 0
        normal = hit["Ng"] / np.maximum(np.linalg.norm(hit["Ng"], axis=1, keepdims=True), 1e-12)
        normal *= np.where(normal[:, 2:] < 0, -1, 1)
        start = above + self._lift * normal
        start[:, 2] -= np.where(met, hit["tfar"], 0)
        start = start.astype(np.float32)
        shadowed = [
            met & scene.blocked(start, np.tile(light, (len(start), 1))) for light in self._lights
        ]
        return np.stack(shadowed), met & (np.stack(self._lights) @ normal.T > FACING)


def light_direction(azimuth: float, elevation: float) -> NDArray[np.float32]:
    """(3,) unit vector towards a light, x right, y up, z to the viewer; see ``LIGHTS``."""
    a, e = np.radians([azimuth, elevation])
    return np.array([np.cos(a) * np.cos(e), np.sin(a) * np.cos(e), np.sin(e)], np.float32)


def _share(part: int, whole: int) -> float:
    return part / whole if whole >= LEAST_PIXELS else nan
