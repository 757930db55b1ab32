"""Shapes whose normals are known."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.typing import NDArray

from lampblack_research.dataset.models import Model

Image = NDArray[np.float32]


def ball(size: int, radius: float) -> tuple[NDArray[np.bool_], Image]:
    """Mask and exact normals of a sphere in the middle of the picture."""
    rows, columns = np.mgrid[0:size, 0:size] + 0.5 - size / 2
    x, y = columns / radius, -rows / radius
    mask = np.hypot(x, y) < 1
    z = np.sqrt(np.maximum(1 - x * x - y * y, 0))
    return mask, (np.stack([x, y, z], axis=2) * mask[..., None]).astype(np.float32)


def angles(a: Image, b: Image) -> Image:
    """Degrees between unit normals."""
    return np.degrees(np.arccos(np.clip(np.einsum("...c,...c->...", a, b), -1, 1)))


def sphere_model(subdivisions: int = 3) -> Model:
    mesh = trimesh.creation.icosphere(subdivisions=subdivisions)
    vertices = mesh.vertices.astype(np.float32)
    return Model("a/ball", vertices, mesh.faces.astype(np.int32), vertices[mesh.faces], False)
