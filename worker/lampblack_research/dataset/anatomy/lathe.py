"""Surfaces of revolution with folds: hats, brims, bowls, collars, skirts and capes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from .field import Vector
from .implicit_surface import Mesh

_ALONG, _ROUND_END, _AROUND = 24, 6, 120


def lathe(
    profile: Vector,
    thickness: float,
    *,
    folds: int = 0,
    depth: float = 0.0,
    phase: float = 0.0,
    arc: float = 360.0,
) -> Mesh:
    """A wall of ``thickness`` along ``profile`` (N, 2: radius, height), turned about y.

    ``folds`` waves run around it. At the end of the profile they are ``depth`` of the radius deep,
    at its start flat. An ``arc`` under 360 degrees has its middle behind, as a cape does.
    """
    share, closed = _wall(profile, thickness)
    whole = arc >= 360
    around = np.linspace(0, 1, _AROUND, endpoint=not whole)
    angle = np.radians(270 - arc / 2 + arc * around)
    thin = np.ones_like(around) if whole else np.sqrt(np.clip(1 - (2 * around - 1) ** 12, 0, 1))
    middle = closed.reshape(2, -1, 2).copy()
    middle[1] = middle[1, ::-1]
    middle = middle.mean(axis=0)
    middle = np.concatenate([middle, middle[::-1]])
    curve = middle[:, None] + (closed - middle)[:, None] * np.maximum(thin, 1e-3)[None, :, None]
    waves = 1 + depth * share[:, None] ** 1.5 * np.sin(folds * angle + phase)[None]
    radius = np.maximum(curve[..., 0], 1e-4) * waves
    points = np.stack([radius * np.cos(angle), curve[..., 1], radius * np.sin(angle)], axis=-1)
    down = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    if whole:
        across = np.roll(points, -1, axis=1) - np.roll(points, 1, axis=1)
    else:
        across = np.gradient(points, axis=1)
    normals = np.cross(across, down)
    length = np.linalg.norm(normals, axis=-1, keepdims=True)
    on_axis = length < 1e-9
    normals = np.where(on_axis, [0.0, 1, 0], normals / np.where(on_axis, 1, length))
    return Mesh(points.reshape(-1, 3), _grid(len(closed), _AROUND, whole), normals.reshape(-1, 3))


def _wall(profile: Vector, thickness: float) -> tuple[Vector, Vector]:
    """The wall's cross-section: a closed counter-clockwise curve (M, 2) with round ends, and the
    share of the profile's length at each of its points (M,)."""
    steps = np.linalg.norm(np.diff(profile, axis=0), axis=1)
    length = np.concatenate([[0], np.cumsum(steps)]) / steps.sum()
    share = np.linspace(0, 1, _ALONG)
    middle = PchipInterpolator(length, profile)(share)
    along = np.gradient(middle, axis=0)
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-12)
    side = np.stack([-along[:, 1], along[:, 0]], axis=1)
    half = np.linspace(0, np.pi / 2, _ROUND_END + 1)[1:, None]

    def end(at: Vector, outward: Vector, across: Vector) -> Vector:
        return np.asarray(at + thickness / 2 * (np.cos(half) * across + np.sin(half) * outward))

    left, right = middle + side * thickness / 2, middle - side * thickness / 2
    go = np.concatenate(
        [
            end(middle[0], -along[0], side[0])[::-1],
            left,
            end(middle[-1], along[-1], side[-1]),
        ]
    )
    back = np.concatenate(
        [
            end(middle[-1], along[-1], -side[-1])[::-1],
            right[::-1],
            end(middle[0], -along[0], -side[0]),
        ]
    )
    shares = np.concatenate([np.zeros(_ROUND_END), share, np.ones(_ROUND_END)])
    return np.concatenate([shares, shares[::-1]]), np.concatenate([go, back])


def _grid(rows: int, columns: int, whole: bool) -> NDArray[np.int64]:
    i, j = np.meshgrid(np.arange(rows), np.arange(columns - (not whole)), indexing="ij")
    a, b = i * columns + j, (i + 1) % rows * columns + j
    c = (i + 1) % rows * columns + (j + 1) % columns
    d = i * columns + (j + 1) % columns
    faces: NDArray[np.int64] = np.stack([a, c, b, a, d, c], axis=-1).reshape(-1, 3)
    return faces
