"""Meshes: smooth where they stand for round shapes; broken files are refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh

from lampblack.errors import LampblackError
from lampblack_research.dataset.models import find_models, load_model


def test_low_poly_models_are_smooth_but_keep_their_creases(tmp_path: Path) -> None:
    trimesh.creation.icosphere(subdivisions=2).export(tmp_path / "ball.ply")
    trimesh.creation.box().export(tmp_path / "box.ply")
    smooth = load_model(tmp_path / "ball.ply")
    corners = smooth.vertices[smooth.faces]
    corners /= np.linalg.norm(corners, axis=2, keepdims=True)
    assert np.einsum("fcd,fcd->fc", corners, smooth.corner_normals).min() > 0.999
    box = load_model(tmp_path / "box.ply")
    assert np.allclose(np.abs(box.corner_normals).max(axis=2), 1, atol=1e-5)


@pytest.mark.parametrize(
    ("name", "content"),
    [("a.ply", b"not a mesh"), ("b.npz", b"PK\x03\x04"), ("c.obj", b""), ("d.glb", b"glTF")],
)
def test_broken_meshes_are_refused(tmp_path: Path, name: str, content: bytes) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.raises(LampblackError):
        load_model(tmp_path / name)
    with pytest.raises(LampblackError):
        find_models(tmp_path / "nowhere")


GOOD = np.eye(4, 3), np.array([[0, 1, 2], [0, 1, 3]])
BAD = {
    "does not exist": (GOOD[0], np.array([[0, 1, 4]])),
    "does not exist, below": (GOOD[0], np.array([[0, 1, -1]])),
    "no triangles": (GOOD[0], np.array([[0, 1, 2, 3]])),
    "no triangles, real": (GOOD[0], GOOD[1].astype(float)),
    "of three coordinates": (GOOD[0][:, :2], GOOD[1]),
    "of three coordinates, flat": (GOOD[0].ravel(), GOOD[1]),
    "of three coordinates, text": (GOOD[0].astype(str), GOOD[1]),
    "not finite": (np.where(GOOD[0] > 0, np.nan, 0.0), GOOD[1]),
    "too far away": (GOOD[0] * 1e300, GOOD[1]),
    "no faces": (GOOD[0], np.zeros((0, 3), int)),
}


@pytest.mark.parametrize("reason", BAD)
def test_the_reason_is_told(tmp_path: Path, reason: str) -> None:
    path = tmp_path / "m.npz"
    np.savez(path, vertices=BAD[reason][0], faces=BAD[reason][1])
    with pytest.raises(LampblackError, match=reason.partition(",")[0]) as told:
        load_model(path)
    assert str(path) in told.value.what
