"""The networks that turn a line drawing into normals."""

from __future__ import annotations

from collections.abc import Callable

import torch
from torch import nn

from .character_net import CharacterNet
from .dilated_unet import DilatedUNet
from .strided_unet import StridedUNet

__all__ = ["ARCHITECTURES", "CharacterNet", "DilatedUNet", "StridedUNet", "build_network"]

ARCHITECTURES: dict[str, Callable[[], nn.Module]] = {
    "figure-net": CharacterNet,  # as the cards of version 0.1 name it
    "dilated-unet": DilatedUNet,
    "strided-unet": StridedUNet,
}


def build_network(architecture: str) -> nn.Module:
    """The untrained network of that name."""
    network = ARCHITECTURES[architecture]()
    return network.to(memory_format=torch.channels_last)  # type: ignore[call-overload,no-any-return]
