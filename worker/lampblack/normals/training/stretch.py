"""One view, many shapes: turned, stretched and sheared in the picture plane."""

from __future__ import annotations

import numpy as np
import torch
from numpy.typing import NDArray
from torch import nn

Plane = NDArray[np.float32]

TURN, STRETCH = 0.17, 0.12
"""Standard deviations: of the turn in radians, of the logarithms of the stretch."""


def random_stretch(rng: np.random.Generator) -> NDArray[np.float64]:
    """A (2, 2) linear map of the picture plane, x right, y up, that keeps areas."""
    turn = rng.normal(0, TURN)
    shear, stretch = rng.normal(0, STRETCH, 2)
    strength = max(float(np.hypot(shear, stretch)), 1e-9)
    # exp of a traceless symmetric matrix: stretch along one axis, shrink across it.
    pull = np.array([[stretch, shear], [shear, -stretch]]) / strength
    spin = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    matrix: NDArray[np.float64] = spin @ (np.cosh(strength) * np.eye(2) + np.sinh(strength) * pull)
    return matrix


def stretched(planes: Plane, matrix: NDArray[np.float64]) -> Plane:
    """A picture under a linear map of its plane, with the normals of the stretched body.

    Without perspective a view of a body that is stretched in the picture plane is the stretched
    view, and its normals follow by the inverse transpose: one view makes many figures, all exact.

    Args:
        planes: (H, W, C) float32; the first three are normals (x right, y up, z to the viewer)
            times coverage, the others are carried along.
        matrix: (2, 2), x right, y up.

    Returns:
        (H', W', C), large enough for the whole picture, 0 around it; normals of the length they
        had.
    """
    rows, columns = planes.shape[:2]
    width, height = np.ceil(np.abs(matrix) @ [columns, rows]).astype(int)
    # Where each new pixel comes from, in half sizes about the middle; pictures count y downwards.
    back = np.linalg.inv(matrix * [[1, -1], [-1, 1]])
    back *= np.array([width, height]) / np.array([columns, rows])[:, None]
    theta = torch.from_numpy(np.hstack([back, np.zeros((2, 1))]).astype(np.float32))[None]
    grid = nn.functional.affine_grid(theta, [1, 1, int(height), int(width)], align_corners=False)
    source = torch.from_numpy(planes).permute(2, 0, 1)[None]
    moved = nn.functional.grid_sample(source, grid, mode="bilinear", align_corners=False)
    result: Plane = moved[0].permute(1, 2, 0).contiguous().numpy()
    normals = result[..., :3]
    length = np.linalg.norm(normals, axis=2, keepdims=True)
    normals[..., :2] = normals[..., :2] @ np.linalg.inv(matrix).astype(np.float32)
    normals *= length / np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), 1e-6)
    return result
