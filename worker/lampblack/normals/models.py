"""Meshes of characters, made ready to be traced as smooth figures."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray

from ..errors import LampblackError

MAX_FACES = 2_000_000
CREASE_DEGREES = 75.0
MODEL_SUFFIXES = (".npz", ".glb", ".obj", ".ply", ".stl", ".off")


@dataclass(frozen=True)
class Model:
    """A triangle mesh, x right, y up, z to the viewer, bounding-box half diagonal 1.

    Attributes:
        name: ``source/name``.
        vertices: (V, 3) float32.
        faces: (F, 3) int32.
        corner_normals: (F, 3, 3) float32 unit, smooth but split at creases, so that a
            low-poly model is drawn and shaded as the round thing it stands for.
        double_sided: cloth modelled as two coincident sheets; its back faces must be culled.
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
            rows = [row for row in csv.DictReader(lines) if row["split"] == split]
        paths = [folder / row["source"] / f"{row['name']}.npz" for row in rows]
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
        LampblackError: the file is not a mesh, or is empty or too large.
    """
    try:
        if path.suffix == ".npz":
            with np.load(path, allow_pickle=False) as archive:
                vertices, faces = archive["vertices"], archive["faces"]
        else:
            mesh = trimesh.load_mesh(path, process=False)
            vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    except (OSError, ValueError, KeyError, TypeError, NotImplementedError) as error:
        raise LampblackError(f"{path} cannot be read as a mesh.", details=str(error)) from error
    if not 0 < len(faces) <= MAX_FACES or not np.isfinite(vertices).all():
        raise LampblackError(f"{path} has {len(faces)} faces; 1 to {MAX_FACES} can be used.")
    faces = faces.astype(np.int64)
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
        corner_normals=_corner_normals(faces, area_normals, len(vertices)),
        double_sided=len(distinct) < 0.98 * len(faces),
    )


def _corner_normals(
    faces: NDArray[np.int64], area_normals: NDArray[np.float32], vertex_count: int
) -> NDArray[np.float32]:
    """Average the faces around each vertex, but keep the face's own normal at a crease."""
    unit = area_normals / np.linalg.norm(area_normals, axis=1, keepdims=True)
    summed = np.zeros((vertex_count, 3), np.float32)
    for corner in range(3):
        np.add.at(summed, faces[:, corner], area_normals)
    smooth = summed[faces]
    smooth /= np.maximum(np.linalg.norm(smooth, axis=2, keepdims=True), 1e-12)
    agreement = np.einsum("fcd,fd->fc", smooth, unit)[..., None]
    # Blend rather than switch: a hard switch would draw a crease around single triangles.
    full, none = np.cos(np.radians(CREASE_DEGREES * np.array([0.7, 1.0])))
    weight = np.clip((agreement - none) / (full - none), 0, 1)
    blended = weight * smooth + (1 - weight) * unit[:, None, :]
    result: NDArray[np.float32] = blended / np.linalg.norm(blended, axis=2, keepdims=True)
    return result.astype(np.float32)
