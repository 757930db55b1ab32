"""Smooth bodies: the union of round cones and ellipsoids, blended where they meet."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .field import BLOCK, CONE, ELLIPSOID, Vector, fill, net, settle

CELLS = 112
"""Cells along the long side of a body."""

_COLUMNS, _WAVES = 18, 5


@dataclass(frozen=True)
class Mesh:
    """vertices (V, 3), faces (F, 3) counter-clockwise from outside, unit normals (V, 3)."""

    vertices: Vector
    faces: NDArray[np.int64]
    normals: Vector


class ImplicitSurface:
    """Parts are joined one by one; each has a radius over which it blends with those before it."""

    def __init__(self) -> None:
        self._parts: list[Vector] = []
        self._waves: list[Vector] = []
        self._bounds: list[Vector] = []

    def cone(self, a: Vector, radius_a: float, b: Vector, radius_b: float, blend: float) -> None:
        """The hull of two balls."""
        if float(np.linalg.norm(b - a)) <= abs(radius_a - radius_b) * 1.01 + 1e-6:
            centre, radius = (a, radius_a) if radius_a > radius_b else (b, radius_b)
            self.ellipsoid(centre, np.full(3, radius), blend)
            return
        self._add(CONE, 1, blend, np.concatenate([a, [radius_a], b, [radius_b]]))
        self._bounds += [a - radius_a, a + radius_a, b - radius_b, b + radius_b]

    def chain(self, points: Vector, radii: Vector, blend: float) -> None:
        """Round cones through ``points`` (N, 3) with ``radii`` (N,): a limb, a tail, a trunk.

        Only the first cone blends by ``blend``. The others blend by their joint's angle.
        """
        straight = np.diff(points, axis=0)
        straight /= np.maximum(np.linalg.norm(straight, axis=1, keepdims=True), 1e-12)
        bent = np.arccos(np.clip(np.einsum("nc,nc->n", straight[1:], straight[:-1]), -1, 1))
        joints = np.concatenate([[blend], radii[1:-1] * np.minimum(0.03 + bent, 0.5)])
        for n, joint in enumerate(joints):
            self.cone(points[n], float(radii[n]), points[n + 1], float(radii[n + 1]), float(joint))

    def ellipsoid(
        self, centre: Vector, radii: Vector, blend: float, turn: Vector | None = None
    ) -> None:
        """``turn`` (3, 3) takes its axes into the world."""
        self._ellipsoid(1, centre, radii, blend, turn)
        reach = float(np.max(radii))
        self._bounds += [centre - reach, centre + reach]

    def dent(self, centre: Vector, radii: Vector, blend: float, turn: Vector | None = None) -> None:
        """Subtract an ellipsoid; its rim is rounded by ``blend``."""
        self._ellipsoid(-1, centre, radii, blend, turn)

    def wave(self, frequency: Vector, phase: float, amplitude: float) -> None:
        """Displace the whole surface by ``amplitude`` sin(``frequency`` p + ``phase``)."""
        self._waves.append(np.array([*frequency, phase, amplitude]))

    def mesh(self, cells: int = CELLS) -> Mesh:
        """Extract the surface on a grid of ``cells`` along the long side."""
        parts = np.array(self._parts)
        waves = np.array(self._waves).reshape(-1, _WAVES)
        bounds = np.array(self._bounds)
        swell = float(np.abs(waves[:, 4]).sum())
        low, high = bounds.min(axis=0), bounds.max(axis=0)
        cell = float((high - low).max()) / cells
        margin = swell + 0.3 * float(parts[:, 2].max()) * (len(parts) > 1) + 2 * cell
        blocks = np.ceil((high - low + 2 * margin) / (cell * BLOCK)).astype(np.int64)
        low = (low + high) / 2 - blocks * cell * BLOCK / 2
        field, near, counts = fill(parts, waves, swell, low, cell, blocks)
        vertices, faces, block_of = net(field, low, cell)
        normals = settle(parts, waves, vertices, block_of, near, counts, cell)
        return Mesh(vertices, faces, normals)

    def _ellipsoid(
        self, sign: int, centre: Vector, radii: Vector, blend: float, turn: Vector | None
    ) -> None:
        axes = np.eye(3) if turn is None else turn.T
        self._add(ELLIPSOID, sign, blend, np.concatenate([centre, radii, axes.reshape(-1)]))

    def _add(self, kind: int, sign: int, blend: float, shape: Vector) -> None:
        part = np.zeros(_COLUMNS)
        part[:3] = kind, sign, max(blend, 1e-4)
        part[3 : 3 + len(shape)] = shape
        self._parts.append(part)
