"""Muon: steps with equal singular values; checkpoints restore its state."""

from __future__ import annotations

from pathlib import Path

import pytest
import torch
from torch import nn

from lampblack.errors import LampblackError
from lampblack.normals.card import NetworkCard
from lampblack.normals.networks import build_network
from lampblack_research.training.checkpoint import Checkpoint, Progress
from lampblack_research.training.muon import Muon, orthogonal
from lampblack_research.training.recipe import build_optimizers


@pytest.mark.parametrize("shape", [(3, 16, 16), (2, 24, 200), (1, 224, 2016)])
def test_singular_values_are_brought_near_one_and_directions_kept(
    shape: tuple[int, int, int],
) -> None:
    torch.manual_seed(0)
    count, rows, columns = shape
    u, _ = torch.linalg.qr(torch.randn(count, rows, rows))
    v, _ = torch.linalg.qr(torch.randn(count, columns, rows))
    values = torch.logspace(-1.5, 0, rows)
    found = orthogonal(1e-3 * (u * values) @ v.mT)
    assert found.dtype == torch.float32
    turned = u.mT @ found @ v
    reached = turned.diagonal(dim1=1, dim2=2)
    # What is a hundredth of the whole and more.
    assert reached[:, values > 0.01 * values.norm()].min() > 0.55
    assert reached.max() < 1.3
    assert (turned - torch.diag_embed(reached)).abs().max() < 0.05
    assert not orthogonal(torch.zeros(shape)).any()


@pytest.mark.parametrize("shape", [(32, 4, 3, 3), (16, 64, 1, 1), (16, 16)])
def test_steps_are_of_adams_size_and_go_down(shape: tuple[int, ...]) -> None:
    torch.manual_seed(0)
    weight = nn.Parameter(torch.randn(shape))
    before = weight.detach().clone()
    optimizer = Muon([weight], lr=0.01, weight_decay=0.0)
    (weight.square().sum() / 2).backward()  # type: ignore[no-untyped-call]
    optimizer.step()
    moved = weight.detach() - before
    assert moved.square().mean().sqrt() == pytest.approx(0.2 * 0.01, rel=0.35)
    assert (moved * before).sum() < 0


@pytest.mark.parametrize("architecture", ["figure-net", "dilated-unet", "strided-unet"])
def test_every_weight_has_one_optimizer(architecture: str) -> None:
    network = build_network(architecture)
    stepped = [
        id(weight)
        for optimizer in build_optimizers(network)
        for group in optimizer.param_groups
        for weight in group["params"]
    ]
    assert sorted(stepped) == sorted(id(weight) for weight in network.parameters())


class Small(nn.Sequential):
    """Weights of both kinds."""

    def __init__(self) -> None:
        super().__init__(nn.Conv2d(2, 16, 3), nn.BatchNorm2d(16), nn.Conv2d(16, 3, 1))

    def optimizers(self) -> list[torch.optim.Optimizer]:
        others = [*self[0].parameters(), *self[1].parameters(), *self[2].parameters()][1:]
        return [Muon([self[0].weight], 0.01, 0.02), torch.optim.AdamW(others, 0.01)]


def stepped(network: nn.Module, optimizers: list[torch.optim.Optimizer]) -> None:
    network.zero_grad()
    network(torch.linspace(-1, 1, 2 * 2 * 6 * 6).reshape(2, 2, 6, 6)).square().sum().backward()
    for optimizer in optimizers:
        optimizer.step()


def test_a_restored_run_takes_the_same_steps(tmp_path: Path) -> None:
    torch.manual_seed(0)
    network, average = Small(), Small()
    optimizers = network.optimizers()
    for _ in range(3):
        stepped(network, optimizers)
    Checkpoint(tmp_path, network, average, optimizers, NetworkCard()).save(Progress(3, 1.0, 50.0))
    later = Small()
    others = later.optimizers()
    again = Checkpoint(tmp_path, later, Small(), others, NetworkCard())
    assert again.load().step == 3
    for _ in range(2):
        stepped(network, optimizers)
        stepped(later, others)
    for name, tensor in network.state_dict().items():
        assert torch.equal(tensor, later.state_dict()[name]), name
    alone = [torch.optim.AdamW(later.parameters())]
    with pytest.raises(LampblackError, match="version"):
        Checkpoint(tmp_path, later, Small(), alone, NetworkCard()).load()
