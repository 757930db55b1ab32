"""Smooth random changes of a model's proportions, with exact normals."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .models import Model


def deformed(model: Model, rng: np.random.Generator) -> Model:
    """``model`` stretched along its axes, swollen or thinned along its height, and bent.

    Normals follow by the inverse transpose of the map's Jacobian, so they stay exact.
    """
    points = model.vertices.astype(np.float64)
    stretch = np.exp(rng.normal(0, 0.12, 3))
    # Width and depth as smooth functions of height: large heads, thick legs, pear shapes.
    knots, widths = np.linspace(-1.2, 1.2, 6), np.exp(rng.normal(0, 0.16, 6))
    polynomial = np.polyfit(knots, widths, 4)
    slope = np.polyder(polynomial)
    bend, phase, rate = rng.normal(0, 0.06, 2), rng.uniform(0, 2 * np.pi, 2), rng.uniform(1, 3, 2)
    x, y, z = points.T
    width = np.polyval(polynomial, y)
    wide = np.clip(width, 0.5, 1.8)
    wider = np.where(wide == width, np.polyval(slope, y), 0)
    moved = np.stack(
        [
            x * wide + bend[0] * np.sin(rate[0] * y + phase[0]),
            y,
            z * wide + bend[1] * np.sin(rate[1] * y + phase[1]),
        ],
        axis=1,
    )
    jacobian = np.zeros((len(points), 3, 3))
    jacobian[:, 0, 0], jacobian[:, 1, 1], jacobian[:, 2, 2] = wide, 1, wide
    jacobian[:, 0, 1] = x * wider + bend[0] * rate[0] * np.cos(rate[0] * y + phase[0])
    jacobian[:, 2, 1] = z * wider + bend[1] * rate[1] * np.cos(rate[1] * y + phase[1])
    back = np.linalg.inv(jacobian * stretch[None, :, None]).transpose(0, 2, 1)
    corner_map = back[model.faces]
    normals = np.einsum("fcij,fcj->fci", corner_map, model.corner_normals)
    normals /= np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), 1e-12)
    vertices: NDArray[np.float32] = (moved * stretch).astype(np.float32)
    return replace(model, vertices=vertices, corner_normals=normals.astype(np.float32))
