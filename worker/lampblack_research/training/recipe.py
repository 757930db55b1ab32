"""The optimizers of every network, and their learning rates."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Protocol

import torch
from torch import nn

from .muon import Muon

DECAY = 0.7
"""The learning rates fall to 0 over this last share of a run."""

_WEIGHT_DECAY = 0.02
_ADAM_RATE, _MUON_RATE = 1e-3, 3e-3


class Network(Protocol):
    """A network that names its last layers."""

    @property
    def heads(self) -> tuple[nn.Conv2d, ...]: ...

    def modules(self) -> Iterator[nn.Module]: ...

    def parameters(self) -> Iterator[nn.Parameter]: ...


def build_optimizers(network: Network) -> list[torch.optim.Optimizer]:
    """Muon for the kernels of convolutions; AdamW for the heads and for all other parameters:
    biases, normalisations, attention. Learning rates are at their peak."""
    heads = {id(head) for head in network.heads}
    kernels = [
        layer.weight
        for layer in network.modules()
        if isinstance(layer, nn.Conv2d) and id(layer) not in heads
    ]
    known = {id(kernel) for kernel in kernels}
    others = [weight for weight in network.parameters() if id(weight) not in known]
    adam = torch.optim.AdamW(
        others, _ADAM_RATE, weight_decay=_WEIGHT_DECAY, betas=(0.9, 0.98), fused=True
    )
    return [Muon(kernels, _MUON_RATE, _WEIGHT_DECAY), adam]
