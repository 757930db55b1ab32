"""Figures made of ellipsoids: the round heads and bodies of cartoons, which meshes of games
lack."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from .models import Model

Vectors = NDArray[np.float64]

SOURCE = "creatures"
_SUBDIVISIONS = 4


class _Clay:
    """Ellipsoids added one by one."""

    def __init__(self, rng: np.random.Generator) -> None:
        ball = trimesh.creation.icosphere(subdivisions=_SUBDIVISIONS)
        self._ball, self._faces = ball.vertices.astype(float), ball.faces.astype(np.int32)
        self._rng = rng
        self._vertices: list[Vectors] = []
        self._normals: list[Vectors] = []
        self._flipped: list[bool] = []

    def radii(self, base: list[float], spread: float) -> Vectors:
        """``base`` made larger or smaller by chance, each axis for itself."""
        radii: Vectors = np.asarray(base) * np.exp(self._rng.normal(0, spread, 3))
        return radii

    def add(
        self, centre: Vectors, radii: Vectors, *, turned: bool = False, paired: bool = False
    ) -> None:
        """One ellipsoid, or with ``paired`` two, left and right."""
        turn = np.eye(3)
        if turned:
            turn = Rotation.from_rotvec(self._rng.normal(0, 0.5, 3)).as_matrix()
        vertices = (self._ball * radii) @ turn.T + centre
        normals = (self._ball / radii) @ turn.T
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        for side in (1, -1) if paired else (1,):
            self._vertices.append(vertices * [side, 1, 1])
            self._normals.append(normals * [side, 1, 1])
            self._flipped.append(side < 0)

    def model(self, name: str) -> Model:
        count = len(self._ball)
        faces = [
            (self._faces[:, ::-1] if flipped else self._faces) + index * count
            for index, flipped in enumerate(self._flipped)
        ]
        joined, normals = np.concatenate(faces), np.concatenate(self._normals)
        return Model(
            name=name,
            vertices=np.concatenate(self._vertices).astype(np.float32),
            faces=joined.astype(np.int32),
            corner_normals=normals[joined].astype(np.float32),
            double_sided=False,
        )


def creature(name: str, rng: np.random.Generator) -> Model:
    """A ball, or a body with some of: head, ears, snout, eyes, arms, legs, tail."""
    clay = _Clay(rng)

    def some(share: float) -> bool:
        return bool(rng.random() < share)

    if some(0.12):
        clay.add(np.zeros(3), clay.radii([1, 1, 1], 0.25))
        return clay.model(name)
    body = clay.radii([0.55, 0.7, 0.5], 0.25)
    clay.add(np.zeros(3), body)
    size = float(rng.uniform(0.35, 0.8))
    head = clay.radii([size, size, size], 0.15)
    neck = body[1] * 0.75 + head[1] * rng.uniform(0.5, 1)
    at = np.array([0, neck, rng.uniform(-0.1, 0.5) * body[2]])
    if some(0.9):
        clay.add(at, head)
    if some(0.7):
        ear = at + head * (rng.uniform(0.4, 0.9), rng.uniform(0.5, 1), 0)
        clay.add(
            ear, clay.radii([0.35 * size, 0.5 * size, 0.2 * size], 0.4), turned=True, paired=True
        )
    if some(0.5):
        snout = at + head * (0, -0.1, 0.9)
        clay.add(snout, clay.radii([0.35 * size, 0.25 * size, 0.3 * size], 0.3))
    if some(0.5):
        eye = at + head * (0.4, 0.25, 0.85)
        clay.add(eye, np.full(3, 0.14 * size) * np.exp(rng.normal(0, 0.3)), paired=True)
    if some(0.8):
        arm = body * (0.9, 0.3, rng.uniform(-0.4, 0.6))
        clay.add(arm, clay.radii([0.4, 0.17, 0.17], 0.3), turned=True, paired=True)
    if some(0.8):
        leg = body * (0.5, -0.9, rng.uniform(-0.2, 0.6))
        clay.add(leg, clay.radii([0.2, 0.4, 0.2], 0.3), turned=True, paired=True)
    if some(0.3):
        clay.add(body * (0, -0.4, -1), clay.radii([0.15, 0.15, 0.5], 0.3), turned=True)
    return clay.model(name)
