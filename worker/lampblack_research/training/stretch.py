"""Random maps of the picture plane, applied to a view and its normals: turn, stretch, bend."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from torch import nn

Plane = NDArray[np.float32]
Vectors = NDArray[np.float64]

TURN, STRETCH, BEND = 0.17, 0.12, 0.1
"""Standard deviations: of the turn in radians, of the logarithms of the stretch, and of the
slope of each wave."""

WAVES = 3
WAVE_NUMBERS = (1.2, 4.5)
"""Radians per half of the character's longer side, shortest and longest."""

_STEEPEST = 0.25


@dataclass(frozen=True)
class Stretch:
    """A map of the picture plane, x right, y up, in halves of the character's longer side.

    Attributes:
        matrix: (2, 2) its linear part, from the character to the stretched character.
        waves: (K, 2) wave vectors, in the plane of the stretched character.
        heights: (K,) how far each wave moves a point, across its direction.
        phases: (K,) radians.
    """

    matrix: Vectors
    waves: Vectors
    heights: Vectors
    phases: Vectors

    def source(self, places: Plane) -> tuple[Plane, Plane]:
        """The points of the character that (H, W, 2) points of the stretched character come from,
        and their (H, W, 2, 2) derivatives."""
        back = np.linalg.inv(self.matrix)
        across = self._across()
        slopes = np.einsum("kd,ke->kde", across, self.waves).reshape(-1, 4)
        angle = places @ self.waves.T.astype(np.float32) + self.phases.astype(np.float32)
        came = places @ back.T.astype(np.float32) + np.sin(angle) @ across.astype(np.float32)
        derivatives = np.cos(angle) @ slopes.astype(np.float32) + back.ravel().astype(np.float32)
        return came, derivatives.reshape(*places.shape, 2)

    def farthest(self) -> float:
        """An upper bound of how far the waves move a point of the stretched character."""
        return float(1.5 * np.linalg.norm(self.matrix, 2) * np.abs(self.heights).sum())

    def _across(self) -> Vectors:
        length = np.maximum(np.linalg.norm(self.waves, axis=1), 1e-9)
        across: Vectors = (self.waves[:, ::-1] * [-1, 1]) * (self.heights / length)[:, None]
        return across


def linear_stretch(matrix: Vectors) -> Stretch:
    """A stretch without waves."""
    return Stretch(matrix, np.zeros((0, 2)), np.zeros(0), np.zeros(0))


def random_stretch(rng: np.random.Generator) -> Stretch:
    """A map whose linear part and whose waves each keep areas."""
    turn = rng.normal(0, TURN)
    shear, stretch = rng.normal(0, STRETCH, 2)
    strength = max(float(np.hypot(shear, stretch)), 1e-9)
    # exp of a traceless symmetric matrix: stretch along one axis, shrink across it.
    pull = np.array([[stretch, shear], [shear, -stretch]]) / strength
    spin = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    matrix: Vectors = spin @ (np.cosh(strength) * np.eye(2) + np.sinh(strength) * pull)
    number = rng.uniform(*WAVE_NUMBERS, WAVES)
    towards, phases = rng.uniform(0, 2 * np.pi, (2, WAVES))
    slopes = np.clip(rng.normal(0, BEND, WAVES), -_STEEPEST, _STEEPEST)
    waves = number[:, None] * np.stack([np.cos(towards), np.sin(towards)], axis=1)
    return Stretch(matrix, waves, slopes / number, phases)


def stretched(planes: Plane, stretch: Stretch) -> Plane:
    """Apply a map to a picture and to its normals.

    Moving a body in planes parallel to the picture moves its orthographic view the same way, and
    its normals change by the inverse transpose. So one view gives many characters, all exact.

    Args:
        planes: (H, W, C) float32; the first three are normals (x right, y up, z to the viewer)
            times coverage, the others are carried along.

    Returns:
        (H', W', C), large enough for the whole picture, 0 around it; normals of the length they
        had.
    """
    rows, columns = planes.shape[:2]
    half = max(rows, columns) / 2
    size = np.abs(stretch.matrix) @ [columns, rows] + 2 * half * stretch.farthest()
    width, height = np.ceil(size).astype(int)
    rows_down, columns_right = np.mgrid[0:height, 0:width] + 0.5
    places = np.stack([columns_right - width / 2, height / 2 - rows_down], axis=2) / half
    came, derivatives = stretch.source(places.astype(np.float32))
    # Pictures count y downwards, in halves of each side.
    grid = came * np.array([2 * half / columns, -2 * half / rows], np.float32)
    source = torch.from_numpy(planes).permute(2, 0, 1)[None]
    moved = nn.functional.grid_sample(
        source, torch.from_numpy(grid)[None], mode="bilinear", align_corners=False
    )
    result: Plane = moved[0].permute(1, 2, 0).contiguous().numpy()
    normals = result[..., :3]
    length = np.linalg.norm(normals, axis=2, keepdims=True)
    right, up = normals[..., :1].copy(), normals[..., 1:2]
    normals[..., :2] = right * derivatives[..., 0, :] + up * derivatives[..., 1, :]
    normals *= length / np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), 1e-6)
    return result
