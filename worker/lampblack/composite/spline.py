"""Smooth enlarging: cubic B-splines, whose level lines have no corners."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..compiled import compiled

Floats = NDArray[np.float32]


def refined(field: Floats, factor: int) -> Floats:
    """(h, w) to (factor h, factor w); the outer edges of both coincide. Noise of single elements is
    smoothed."""
    if factor <= 1:
        return field
    return np.ascontiguousarray(_along(np.ascontiguousarray(_along(field, factor).T), factor).T)


def _along(field: Floats, factor: int) -> Floats:
    fine = np.empty((field.shape[0] * factor, field.shape[1]), np.float32)
    _spline(field, _weights(factor), fine)
    return fine


def _weights(factor: int) -> Floats:
    """(factor, 5) share of the five rows around each of the ``factor`` new rows in one."""
    away = np.abs((np.arange(factor)[:, None] + 0.5) / factor - 0.5 - np.arange(-2, 3))
    near = (4 - 6 * away**2 + 3 * away**3) / 6
    far = np.maximum(2 - away, 0) ** 3 / 6
    return np.asarray(np.where(away < 1, near, far), np.float32)


@compiled
def _spline(field: Any, weights: Any, fine: Any) -> None:
    rows, factor = field.shape[0], weights.shape[0]
    for row in range(rows):
        for part in range(factor):
            for column in range(field.shape[1]):
                total = np.float32(0)
                for tap in range(5):
                    at = min(max(row + tap - 2, 0), rows - 1)
                    total += weights[part, tap] * field[at, column]
                fine[row * factor + part, column] = total
