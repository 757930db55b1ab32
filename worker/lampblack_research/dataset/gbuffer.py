"""Exact ground truth by ray casting: normals and depth of a model seen by the artist."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .models import Model
from .rays import RayScene

MARGIN = 8


@dataclass(frozen=True)
class GBuffer:
    """An orthographic view of a model, H x W, row 0 at the top.

    Attributes:
        normals: (H, W, 3) float32 unit, x right, y up, z to the viewer; 0 outside.
        depth: (H, W) float32, towards the viewer in pixels; 0 outside.
        mask: (H, W) bool.
        face_normals: (H, W, 3) float32, the flat normals of the triangles; 0 outside.
    """

    normals: NDArray[np.float32]
    depth: NDArray[np.float32]
    mask: NDArray[np.bool_]
    face_normals: NDArray[np.float32]


def view_rotation(azimuth: float, elevation: float, roll: float = 0.0) -> NDArray[np.float32]:
    """(3, 3) rotation into the viewer's frame; angles in degrees, 0, 0 is the front."""
    a, e, r = np.radians([azimuth, elevation, roll])
    around_y = np.array([[np.cos(a), 0, -np.sin(a)], [0, 1, 0], [np.sin(a), 0, np.cos(a)]])
    around_x = np.array([[1, 0, 0], [0, np.cos(e), -np.sin(e)], [0, np.sin(e), np.cos(e)]])
    around_z = np.array([[np.cos(r), -np.sin(r), 0], [np.sin(r), np.cos(r), 0], [0, 0, 1]])
    rotation: NDArray[np.float32] = (around_z @ around_x @ around_y).astype(np.float32)
    return rotation


@dataclass(frozen=True)
class Placed:
    """A model in the pixels of its picture: ``vertices`` (V, 3) float32, x right, y up from the
    lower left corner, z to the viewer; ``size`` of the picture, (rows, columns)."""

    vertices: NDArray[np.float32]
    faces: NDArray[np.int32]
    corner_normals: NDArray[np.float32]
    size: tuple[int, int]


def place(
    model: Model, rotation: NDArray[np.float32], character_px: int, *, equal_area: bool = False
) -> Placed:
    """Turn ``model`` by ``rotation``, scale its long side to ``character_px`` pixels, add a margin.

    With ``equal_area`` the box of a long character grows to the area of a square of that side, by
    half at most, so that a standing character is seen as large as a round one.
    """
    vertices = model.vertices @ rotation.T
    faces, corner_normals = model.faces, model.corner_normals
    if model.double_sided:
        corners = vertices[faces]
        edge_a, edge_b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        facing = edge_a[:, 0] * edge_b[:, 1] - edge_a[:, 1] * edge_b[:, 0] > 0
        faces, corner_normals = faces[facing], corner_normals[facing]
    used = vertices[faces.reshape(-1)]
    low, high = used.min(axis=0), used.max(axis=0)
    sides = np.maximum((high - low)[:2], 1e-6)
    scale = character_px / float(sides.max())
    if equal_area:
        scale *= min(1.5, float(np.sqrt(sides.max() / sides.min())))
    width, height = (int(n) + 2 * MARGIN for n in np.ceil(sides * scale))
    vertices = (vertices - low) * scale + np.array([MARGIN, MARGIN, 0], np.float32)
    return Placed(vertices.astype(np.float32), faces, corner_normals @ rotation.T, (height, width))


def trace(
    model: Model, rotation: NDArray[np.float32], character_px: int, *, equal_area: bool = False
) -> GBuffer:
    """See ``model`` placed as ``place`` does."""
    return trace_placed(place(model, rotation, character_px, equal_area=equal_area))


def trace_placed(placed: Placed) -> GBuffer:
    """One ray through the middle of every pixel.

    Raises:
        LampblackError: the ray tracer is not installed.
    """
    vertices, faces, (height, width) = placed.vertices, placed.faces, placed.size
    top = float(vertices[:, 2].max()) + 1
    rows, columns = np.mgrid[0:height, 0:width]
    origins = np.stack(
        [columns + 0.5, height - (rows + 0.5), np.full(rows.shape, top)], axis=-1
    ).reshape(-1, 3)
    directions = np.tile(np.array([[0, 0, -1]], np.float32), (len(origins), 1))
    hit = RayScene(vertices[faces]).first(origins.astype(np.float32), directions)
    face = hit["primID"]
    inside = face >= 0
    face, u, v = face[inside], hit["u"][inside, None], hit["v"][inside, None]
    shading = placed.corner_normals[face]
    smooth = (1 - u - v) * shading[:, 0] + u * shading[:, 1] + v * shading[:, 2]
    corners = vertices[faces[face]]
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    flat /= np.maximum(np.linalg.norm(flat, axis=1, keepdims=True), 1e-12)
    towards = np.where(flat[:, 2:] < 0, -1, 1)  # the far side of a sheet shows its back
    smooth, flat = smooth * towards, flat * towards
    smooth[:, 2] = np.maximum(smooth[:, 2], 0)  # what is seen cannot face away
    smooth /= np.maximum(np.linalg.norm(smooth, axis=1, keepdims=True), 1e-12)

    def image(values: NDArray[np.float32]) -> NDArray[np.float32]:
        out = np.zeros((height * width, *values.shape[1:]), np.float32)
        out[inside] = values
        return out.reshape(height, width, *values.shape[1:])

    return GBuffer(
        normals=image(smooth.astype(np.float32)),
        depth=image((top - hit["tfar"][inside]).astype(np.float32)),
        mask=inside.reshape(height, width),
        face_normals=image(flat.astype(np.float32)),
    )
