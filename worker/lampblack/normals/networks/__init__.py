"""The networks that turn a line drawing into normals."""

from __future__ import annotations

from collections.abc import Callable

import torch
from torch import nn

from .dilated_unet import DilatedUNet
from .figure_net import FigureNet
from .strided_unet import StridedUNet

__all__ = ["ARCHITECTURES", "DilatedUNet", "FigureNet", "StridedUNet", "build_network"]

ARCHITECTURES: dict[str, Callable[[], nn.Module]] = {
    "figure-net": FigureNet,
    "dilated-unet": DilatedUNet,
    "strided-unet": StridedUNet,
}


def build_network(architecture: str) -> nn.Module:
    """The untrained network of that name."""
    network = ARCHITECTURES[architecture]()
    return network.to(memory_format=torch.channels_last)  # type: ignore[call-overload,no-any-return]
