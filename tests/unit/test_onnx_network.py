"""Without torch the same weights predict the same, by ONNX Runtime."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from lampblack.drawing import decompose_drawing, load_picture
from lampblack.errors import LampblackError
from lampblack.normals.card import shipped_weights
from lampblack.normals.networks.torch_network import TorchNetwork
from lampblack.normals.onnx_network import OnnxNetwork
from lampblack.normals.predict import NormalPredictor
from support.paths import ROOT


def angles(a: NDArray[np.float32], b: NDArray[np.float32]) -> NDArray[np.float64]:
    between = np.einsum("...c,...c->...", a.astype(np.float64), b.astype(np.float64))
    return np.asarray(np.degrees(np.arccos(np.clip(between, -1, 1))))


@pytest.mark.parametrize(("architecture", "grids"), [("figure-net", 0), ("dilated-unet", 2)])
def test_it_predicts_what_torch_predicts(
    architecture: str, grids: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("lampblack.normals.precision.has_bf16", lambda: False)
    drawing = decompose_drawing(load_picture(ROOT / "examples" / "character.png"))
    predicted = [
        NormalPredictor(*kind.load(shipped_weights(architecture))).predict(
            drawing.lines, drawing.mask, grids=grids, quick=True
        )
        for kind in (TorchNetwork, OnnxNetwork)
    ]
    torch, onnx = predicted
    difference = angles(torch.normals, onnx.normals)[drawing.mask]
    assert difference.mean() < 0.05
    assert difference.max() < 1
    if torch.depth is not None and onnx.depth is not None and torch.edge is not None:
        assert onnx.edge is not None
        assert np.abs(torch.depth - onnx.depth).max() < 0.1
        assert np.abs(torch.edge - onnx.edge).max() < 0.01


def test_its_bits_do_not_depend_on_the_number_of_threads() -> None:
    random = np.random.default_rng(0)
    fine = random.random((2, 2, 192, 160), np.float32)
    coarse = random.random((2, 11, 48, 40), np.float32)
    first, *others = (
        OnnxNetwork.load(shipped_weights(), threads)[0].predict_character(fine, coarse)
        for threads in (1, 2, 3)
    )
    for other in others:
        assert all(np.array_equal(a, b) for a, b in zip(first, other, strict=True))


def test_nothing_needs_torch_to_light_a_drawing() -> None:
    program = """
import sys
sys.modules["torch"] = None
import numpy as np
import lampblack, lampblack.pipeline, lampblack.service.serve, lampblack.farm.cluster
from lampblack.errors import LampblackError
from lampblack.normals.predict import NormalPredictor
from lampblack.surface import solve
rows, columns = np.mgrid[0:96, 0:96] - 47.5
mask = np.hypot(rows, columns) < 40
for grids in (0, 1):
    lines = np.zeros(mask.shape, np.float32)
    found = NormalPredictor().predict(lines, mask, grids=grids, quick=True)
    assert found.normals[48, 48, 2] > 0.9
try:
    solve(found.normals, mask, "adam")
except LampblackError as error:
    print(error)
"""
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", program], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert "pip install 'lampblack[torch]'" in done.stdout


def test_it_leaves_nothing_in_the_home_and_reports_to_nobody(tmp_path: Path) -> None:
    program = """
from lampblack.normals.card import shipped_weights
from lampblack.normals.onnx_network import OnnxNetwork
OnnxNetwork.load(shipped_weights())
"""
    home = {"HOME": str(tmp_path), "PATH": "/usr/bin:/bin"}
    subprocess.run([sys.executable, "-W", "ignore", "-c", program], check=True, env=home)
    assert not list(tmp_path.rglob("*"))


def test_a_network_that_is_missing_is_told() -> None:
    with pytest.raises(LampblackError, match="cannot be used"):
        OnnxNetwork.load(shipped_weights("strided-unet"))
