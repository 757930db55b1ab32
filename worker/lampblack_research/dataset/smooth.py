"""Rounds low-poly models by Phong tessellation (Boubekeur and Alexa 2008)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .models import Model

COARSE_FACES = 8000
ROUNDS = 2
_BULGE = 0.75


def smoothed(model: Model) -> Model:
    """``model`` with every triangle split in four, twice, and bent towards its tangent planes.

    Corners move along normals that are not split at creases, so that no crack opens; shading
    keeps its creases. Models of more than 8000 triangles are returned as they are.
    """
    if len(model.faces) > COARSE_FACES:
        return model
    for _ in range(ROUNDS):
        model = _split(model)
    return model


def _split(model: Model) -> Model:
    faces = model.faces.astype(np.int64)
    around = _vertex_normals(model.vertices, faces)
    pairs = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    edges, which = np.unique(pairs, axis=0, return_inverse=True)
    a, b = model.vertices[edges[:, 0]], model.vertices[edges[:, 1]]
    middle = (a + b) / 2
    pulled = middle.copy()
    for end, normal in ((a, around[edges[:, 0]]), (b, around[edges[:, 1]])):
        pulled -= normal * np.einsum("ec,ec->e", middle - end, normal)[:, None] / 2
    middle += _BULGE * (pulled - middle)
    between = which.reshape(-1, 3) + len(model.vertices)
    i, j, k = faces.T
    ij, jk, ki = between.T
    parts = [(i, ij, ki), (ij, j, jk), (ki, jk, k), (ij, jk, ki)]
    ni, nj, nk = model.corner_normals.transpose(1, 0, 2)
    nij, njk, nki = (_unit(p + q) for p, q in ((ni, nj), (nj, nk), (nk, ni)))
    shading = [(ni, nij, nki), (nij, nj, njk), (nki, njk, nk), (nij, njk, nki)]
    return replace(
        model,
        vertices=np.concatenate([model.vertices, middle]).astype(np.float32),
        faces=np.concatenate([np.stack(p, axis=1) for p in parts]).astype(np.int32),
        corner_normals=np.concatenate([np.stack(s, axis=1) for s in shading]).astype(np.float32),
    )


def _vertex_normals(vertices: NDArray[np.float32], faces: NDArray[np.int64]) -> NDArray[np.float32]:
    corners = vertices[faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    summed = np.zeros_like(vertices)
    for corner in range(3):
        np.add.at(summed, faces[:, corner], across)
    return _unit(summed)


def _unit(vectors: NDArray[np.float32]) -> NDArray[np.float32]:
    unit: NDArray[np.float32] = np.divide(
        vectors, np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-12)
    )
    return unit
