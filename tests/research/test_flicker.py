"""Flicker of drawings and of turntables."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import trimesh

from lampblack.drawing import save_picture
from lampblack.normals.card import NetworkCard
from lampblack.normals.networks import build_network
from lampblack.normals.networks.torch_network import TorchNetwork
from lampblack.normals.predict import NormalPredictor
from lampblack_research.evaluation.turntable import turntable
from support.command_line import Run
from support.drawings import draw_ball


def test_command_measures_drawings_and_skips_holds_and_blanks(run: Run, tmp_path: Path) -> None:
    ball = draw_ball(120)
    for number, picture in enumerate([ball, ball, np.zeros_like(ball), np.roll(ball, 3, axis=1)]):
        save_picture(tmp_path / f"ball.{number:04d}.png", picture)
    outcome = run("flicker", tmp_path, "--json")
    assert outcome.code == 0
    rows = json.loads(outcome.out)
    assert rows["predicted"]["rigid"] < 1.5
    assert rows["steadied"]["rigid"] < 1.5
    assert rows["predicted"]["jitter"] is None
    assert rows["steadied"]["swaps"] in (0, None)
    assert run("flicker").code == 1


def test_on_a_turntable_the_truth_has_no_error(tmp_path: Path) -> None:
    trimesh.creation.capsule(radius=0.4).export(tmp_path / "pill.ply")
    small = NormalPredictor(
        TorchNetwork(build_network("figure-net")), NetworkCard("figure-net", (64, 96))
    )
    rows = turntable(tmp_path / "pill.ply", small, views=3, character_px=96)
    assert set(rows) == {"truth", "predicted", "steadied"}
    assert rows["truth"].error < 0.1
    assert rows["truth"].jitter < 1.5
    assert rows["predicted"].error > 1


def test_cuts_of_the_truth_are_followed_along_the_model(tmp_path: Path) -> None:
    ball = trimesh.creation.icosphere(subdivisions=3, radius=0.5)
    front = trimesh.creation.icosphere(subdivisions=3, radius=0.2)
    front.apply_translation((0.1, 0, 1))
    trimesh.util.concatenate([ball, front]).export(tmp_path / "balls.ply")
    small = NormalPredictor(
        TorchNetwork(build_network("figure-net")), NetworkCard("figure-net", (64, 96))
    )
    truth = turntable(tmp_path / "balls.ply", small, views=3, character_px=160)["truth"]
    assert truth.cuts == 1
    assert truth.flips == 0
