"""Weights and their cards: what is saved can be loaded; foreign files are refused."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import torch

from lampblack.errors import LampblackError
from lampblack.normals.card import NetworkCard, load_network, save_network, shipped_weights
from lampblack.normals.networks import build_network


def test_weights_round_trip_and_foreign_files_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "net.safetensors"
    card = NetworkCard(measured={"val": 23.0})
    network = build_network(card.architecture)
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
    for value in (float("nan"), float("inf")):
        spoilt = build_network(card.architecture)
        next(spoilt.parameters()).data[0] = value
        save_network(path, spoilt, card)
        with pytest.raises(LampblackError, match="not all finite"):
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
