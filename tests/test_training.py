"""Weights, cards and the trainer: what is saved can be had back; what is foreign is refused."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import torch
import trimesh

from lampblack.errors import LampblackError
from lampblack.normals.card import NetworkCard, load_network, save_network, shipped_weights
from lampblack.normals.evaluate import evaluate
from lampblack.normals.models import find_models, load_model
from lampblack.normals.network import build_network
from lampblack.normals.predict import NormalPredictor
from lampblack.normals.train import Progress, TrainingOptions, train
from lampblack.normals.views import random_views


@pytest.fixture
def models(tmp_path: Path) -> Path:
    folder = tmp_path / "models"
    folder.mkdir()
    trimesh.creation.icosphere(subdivisions=3).export(folder / "ball.ply")
    trimesh.creation.capsule(radius=0.4).export(folder / "pill.obj")
    return folder


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


def test_views_mirror_the_normals_with_the_drawing(models: Path) -> None:
    view = next(random_views(find_models(models), 0, (256, 300)))
    for seed in range(6):
        tile, truth = view.tile(np.random.default_rng(seed))
        inside = tile[3] > 0
        lengths = np.linalg.norm(truth, axis=0)
        assert np.allclose(lengths[inside], 1, atol=0.02)
        assert not lengths[~inside].any()
        # Outwards is outwards: on the whole the normal's x grows with the pixel's x.
        _rows, columns = np.nonzero(inside)
        assert np.corrcoef(columns, truth[0][inside])[0, 1] > 0.3


def test_training_goes_on_where_it_was_stopped(models: Path, tmp_path: Path) -> None:
    run = tmp_path / "run"
    steps: list[int] = []

    def interrupt_every_third(progress: Progress) -> None:
        steps.append(progress.step)
        if progress.step % 3 == 0:
            raise KeyboardInterrupt

    for _ in range(2):
        with pytest.raises(KeyboardInterrupt):
            train(models, run, NetworkCard(), TrainingOptions(batch=2), interrupt_every_third)
    assert steps == [1, 2, 3, 4, 5, 6]
    network, card = load_network(run / "network.safetensors")
    assert card.training is not None
    assert card.training["steps"] == 6
    table = evaluate(models, None, NormalPredictor(network, card), views=1, figure_px=96, grids=1)
    assert table["inflate"]["mean_degrees"] < table["flat"]["mean_degrees"]


def test_models_and_runs_that_cannot_be_used_are_told(models: Path, tmp_path: Path) -> None:
    barren = tmp_path / "barren"
    barren.mkdir()
    (barren / "a.obj").write_text("junk")
    with pytest.raises(LampblackError, match="models"):
        train(barren, tmp_path / "run", NetworkCard(), TrainingOptions())
    (barren / "split.csv").write_text("name\na\n")
    with pytest.raises(LampblackError):
        find_models(barren, "train")
    (tmp_path / "file").write_text("")
    with pytest.raises(LampblackError):
        train(models, tmp_path / "file" / "run", NetworkCard(), TrainingOptions())
    (tmp_path / "run" / "checkpoint.safetensors").write_bytes(b"junk")
    with pytest.raises(LampblackError, match="damaged"):
        train(models, tmp_path / "run", NetworkCard(), TrainingOptions())


def test_weights_round_trip_and_foreign_files_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "net.safetensors"
    card = NetworkCard(measured={"val": 23.0})
    network = build_network(card)
    save_network(path, network, card)
    again, read = load_network(path)
    assert read == card
    for old, new in zip(network.parameters(), again.parameters(), strict=True):
        assert torch.allclose(old, new, atol=1e-3)

    good = path.read_bytes()
    for broken in (b"", b"junk", good[: len(good) // 2]):
        path.write_bytes(broken)
        with pytest.raises(LampblackError):
            load_network(path)
    path.write_bytes(good)
    text = json.loads(path.with_suffix(".json").read_text())
    for change in ({"architecture": "../../etc"}, {"figure_px": [1, 10**9]}):
        path.with_suffix(".json").write_text(json.dumps(text | change))
        with pytest.raises(LampblackError):
            load_network(path)
    path.with_suffix(".json").unlink()
    with pytest.raises(LampblackError):
        load_network(path)


def test_shipped_weights_are_small_and_described() -> None:
    network, card = load_network()
    assert shipped_weights().stat().st_size < 20_000_000
    assert card.measured is not None
    assert all(torch.isfinite(p).all() for p in network.parameters())
