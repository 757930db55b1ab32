"""Reads meshes of characters, and prepares them to be traced as smooth shapes."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from numpy.typing import NDArray

from lampblack.errors import LampblackError

LARGEST = 1e12
MAX_FACES = 2_000_000
CREASE_DEGREES = 75.0
MAX_FACES_AROUND = 64
MODEL_SUFFIXES = (".npz", ".glb", ".obj", ".ply", ".stl", ".off")


@dataclass(frozen=True)
class Model:
    """A triangle mesh, x right, y up, z to the viewer, bounding-box half diagonal 1.

    Attributes:
        name: ``source/name``.
        vertices: (V, 3) float32.
        faces: (F, 3) int32.
        corner_normals: (F, 3, 3) float32 unit, smooth but split at creases, so that a
            low-poly model is drawn and shaded as the round shape that it represents.
        double_sided: it has cloth of two coincident sheets; back faces must be culled.
    """

    name: str
    vertices: NDArray[np.float32]
    faces: NDArray[np.int32]
    corner_normals: NDArray[np.float32]
    double_sided: bool


def find_models(folder: Path, split: str | None = None) -> list[Path]:
    """Mesh files under ``folder``; with ``split`` only those its ``split.csv`` lists so.

    Raises:
        LampblackError: the folder holds no mesh.
    """
    if not folder.is_dir():
        raise LampblackError(f"{folder} is not a folder of models.", "Name one with --models.")
    table = folder / "split.csv"
    if split is not None and table.is_file():
        with table.open(newline="") as lines:
            rows = [row for row in csv.DictReader(lines) if row.get("split") == split]
        paths = [folder / str(row.get("source")) / f"{row.get('name')}.npz" for row in rows]
    else:
        paths = sorted(p for p in folder.rglob("*") if p.suffix.lower() in MODEL_SUFFIXES)
    if not paths:
        raise LampblackError(
            f"{folder} holds no models.", f"Known kinds: {', '.join(MODEL_SUFFIXES)}."
        )
    return paths


def load_model(path: Path) -> Model:
    """Read one mesh and weld, centre and smooth it.

    Raises:
        LampblackError: the file is not a mesh of triangles, or is empty or too large.
    """
    try:
        if path.suffix == ".npz":
            with path.open("rb") as file, np.load(file, allow_pickle=False) as archive:
                vertices, faces = archive["vertices"], archive["faces"]
        else:
            mesh = trimesh.load_mesh(path, process=False)
            vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    except Exception as error:  # readers of broken meshes raise all kinds of errors
        raise LampblackError(f"{path} cannot be read as a mesh.", details=str(error)) from error
    vertices, faces = _checked(path, vertices, faces)
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    vertices = (vertices - (low + high) / 2) / max(float(np.linalg.norm(high - low)) / 2, 1e-12)

    _, first, inverse = np.unique(
        np.round(vertices * 1e5).astype(np.int64), axis=0, return_index=True, return_inverse=True
    )
    vertices, faces = vertices[first].astype(np.float32), inverse.reshape(-1)[faces]
    corners = vertices[faces]
    area_normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    kept = np.linalg.norm(area_normals, axis=1) > 1e-10
    faces, area_normals = faces[kept], area_normals[kept]
    if not len(faces):
        raise LampblackError(f"{path} has no face with an area.")
    distinct = np.unique(np.sort(faces, axis=1), axis=0)
    return Model(
        name=f"{path.parent.name}/{path.stem}",
        vertices=vertices,
        faces=faces.astype(np.int32),
        corner_normals=_corner_normals(faces, area_normals),
        double_sided=len(distinct) < 0.98 * len(faces),
    )


def _checked(
    path: Path, vertices: NDArray[Any], faces: NDArray[Any]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """The arrays of a foreign file, with the shapes and values that a mesh has."""
    if vertices.ndim != 2 or vertices.shape[1] != 3 or vertices.dtype.kind not in "fiu":
        raise LampblackError(f"{path} has no vertices of three coordinates.")
    if faces.ndim != 2 or faces.shape[1] != 3 or faces.dtype.kind not in "iu":
        raise LampblackError(f"{path} has faces that are no triangles.", "Triangulate it.")
    if not len(faces):
        raise LampblackError(f"{path} has no faces: it is empty, or no model.")
    if len(faces) > MAX_FACES:
        raise LampblackError(f"{path} has {len(faces)} faces; {MAX_FACES} at most can be used.")
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise LampblackError(f"{path} has a face with a vertex that does not exist.")
    if not np.isfinite(vertices).all() or np.abs(vertices).max() > LARGEST:
        raise LampblackError(f"{path} has a vertex that is not finite, or too far away.")
    return vertices.astype(np.float64), faces.astype(np.int64)


def _corner_normals(
    faces: NDArray[np.int64], area_normals: NDArray[np.float32]
) -> NDArray[np.float32]:
    """At each corner, the mean of the faces around its vertex that lie within the crease."""
    unit = area_normals / np.linalg.norm(area_normals, axis=1, keepdims=True)
    corner_vertex = faces.reshape(-1)
    corner_face = np.repeat(np.arange(len(faces)), 3)
    order = np.argsort(corner_vertex, kind="stable")
    degree = np.bincount(corner_vertex)
    first = np.concatenate([[0], np.cumsum(degree)[:-1]])
    summed = np.zeros((len(corner_vertex), 3), np.float32)
    # The k-th face around every corner's vertex, all corners at once.
    for k in range(min(int(degree.max()), MAX_FACES_AROUND)):
        has = np.flatnonzero(degree[corner_vertex] > k)
        other = corner_face[order[first[corner_vertex[has]] + k]]
        alike = np.einsum("cd,cd->c", unit[corner_face[has]], unit[other])
        near = alike > np.cos(np.radians(CREASE_DEGREES))
        summed[has[near]] += area_normals[other[near]]
    length = np.linalg.norm(summed, axis=1, keepdims=True)
    normals = np.where(length > 1e-12, summed / np.maximum(length, 1e-12), unit[corner_face])
    result: NDArray[np.float32] = normals.astype(np.float32).reshape(-1, 3, 3)
    return result
