"""Networks run by torch."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn

from ...cache import digest
from ..card import NetworkCard, load_network
from ..precision import fast_arithmetic
from .character_net import CharacterNet

Planes = NDArray[np.float32]


class TorchNetwork:
    """A network of torch in evaluation mode; see ``Network``."""

    def __init__(self, module: nn.Module) -> None:
        self._module = module.to(memory_format=torch.channels_last).eval()  # type: ignore[call-overload]
        self.identity: str = digest(*(tensor.numpy() for tensor in module.state_dict().values()))

    @staticmethod
    def load(weights: Path) -> tuple[TorchNetwork, NetworkCard]:
        """Raises LampblackError: the weights cannot be used."""
        module, card = load_network(weights)
        return TorchNetwork(module), card

    @property
    def whole(self) -> bool:
        """See ``Network``."""
        return isinstance(self._module, CharacterNet)

    def predict_character(self, fine: Planes, coarse: Planes) -> tuple[Planes, Planes]:
        """See ``Network``."""
        with torch.inference_mode(), fast_arithmetic():
            vectors, _, auxiliary = self._module(_tensor(fine), _tensor(coarse))
        return vectors.numpy(), auxiliary.numpy()

    def predict_tiles(self, tiles: Planes) -> Planes:
        """See ``Network``."""
        with torch.inference_mode(), fast_arithmetic():
            predicted: Planes = self._module(_tensor(tiles)).float().numpy()
        return predicted


def _tensor(planes: Planes) -> Tensor:
    return torch.from_numpy(planes).contiguous(memory_format=torch.channels_last)
