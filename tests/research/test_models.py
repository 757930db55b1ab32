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
