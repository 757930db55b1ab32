"""A trained network that runs, whatever runs it."""

from __future__ import annotations

import importlib.util
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from .card import NetworkCard, shipped_weights

Planes = NDArray[np.float32]


class Network(Protocol):
    """A network of whole characters, or of tiles.

    Attributes:
        identity: a digest of the weights, and of what runs them.
        whole: whether it predicts whole characters.
    """

    @property
    def identity(self) -> str: ...

    @property
    def whole(self) -> bool: ...

    def predict_character(self, fine: Planes, coarse: Planes) -> tuple[Planes, Planes]:
        """Args:
            fine: (B, 2, H, W), coarse: (B, 11, H/4, W/4); see ``character.py``.

        Returns:
            (B, 3, H, W) normals, not yet unit; (B, 4, H/4, W/4) depth, the logits of the near and
            far side of an occlusion, and that of ink being a mark.
        """

    def predict_tiles(self, tiles: Planes) -> Planes:
        """(B, 4, 256, 256), see ``tiles.py`` -> (B, 3, 256, 256) normals, not yet unit."""


def has_torch() -> bool:
    """Whether torch is installed. It is not imported."""
    return importlib.util.find_spec("torch") is not None


def shipped_network(architecture: str = "figure-net") -> tuple[Network, NetworkCard]:
    """The installed weights of that name: run by torch if it is there, else by ONNX Runtime.

    Raises:
        LampblackError: the weights cannot be used.
    """
    if has_torch():
        from .networks.torch_network import TorchNetwork

        return TorchNetwork.load(shipped_weights(architecture))
    return soon_loaded_network(architecture)


def soon_loaded_network(architecture: str = "figure-net") -> tuple[Network, NetworkCard]:
    """The same weights, run by ONNX Runtime in any case: it loads in a fifth of a second, torch in
    two.

    Raises:
        LampblackError: the weights cannot be used.
    """
    from .onnx_network import OnnxNetwork

    return OnnxNetwork.load(shipped_weights(architecture))
