"""Weights that can be exchanged: a safetensors file and the JSON card that describes it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import msgspec
import numpy as np
from msgspec import Meta
from numpy.typing import NDArray
from safetensors import SafetensorError
from safetensors.numpy import load

from ..atomic import atomic_file
from ..errors import LampblackError
from ..files import read_bounded

if TYPE_CHECKING:
    import torch
    from torch import nn

MAX_WEIGHT_BYTES, MAX_CARD_BYTES = 256 << 20, 1 << 20

Side = Annotated[int, Meta(ge=64, le=4096)]


@dataclass(frozen=True)
class NetworkCard:
    """What a weight file is and how to feed it.

    Attributes:
        architecture: a name in ``networks.ARCHITECTURES``.
        figure_px: for a network of tiles, the (smallest, largest) long side in pixels of the
            characters it was trained on; other drawings are resized into that range. For a
            network of whole characters, the sizes of its canvases, smallest first, each as
            the side of a square of equal area; the predictions on all of them are averaged.
        roundness: factor of the slope correction; see ``predict``.
        training: how the network was trained, for people.
        measured: results of its evaluation, for people.
    """

    architecture: str = "figure-net"
    figure_px: Annotated[tuple[Side, ...], Meta(min_length=2, max_length=8)] = (192, 320, 512)
    roundness: Annotated[float, Meta(gt=0.1, lt=10)] = 1.1
    training: dict[str, Any] | None = None
    measured: dict[str, Any] | None = None


def shipped_weights(architecture: str = "figure-net") -> Path:
    """Path of the weights that are installed with Lampblack."""
    return Path(__file__).parent / "weights" / f"{architecture}.safetensors"


def graph_path(weights: Path) -> Path:
    """The ONNX graph of an architecture, without weights, beside ``weights``."""
    return weights.with_suffix(".onnx")


def save_network(path: Path, network: nn.Module, card: NetworkCard) -> None:
    """Write ``path`` (fp16 safetensors) and, beside it, its ``.json`` card; each atomically."""
    weights = {name: t.detach().half().contiguous() for name, t in network.state_dict().items()}
    path.parent.mkdir(parents=True, exist_ok=True)
    write_tensors(path, weights)
    with atomic_file(path.with_suffix(".json")) as file:
        file.write(msgspec.json.format(msgspec.json.encode(card), indent=2) + b"\n")


def read_weights(path: Path) -> tuple[dict[str, NDArray[Any]], NetworkCard]:
    """The arrays of a weight file by name, all finite, and its card.

    Raises:
        LampblackError: a file is missing or malformed.
    """
    try:
        described = read_bounded(path.with_suffix(".json"), MAX_CARD_BYTES)
        card = msgspec.json.decode(described, type=NetworkCard)
        stored = load(read_bounded(path, MAX_WEIGHT_BYTES))
    except (OSError, SafetensorError, msgspec.DecodeError) as error:
        raise _unusable(path, error) from error
    if not all(bool(np.isfinite(array).all()) for array in stored.values()):
        raise LampblackError(f"The weights {path} are not all finite.", "Train them again.")
    return stored, card


def load_network(path: Path | None = None) -> tuple[nn.Module, NetworkCard]:
    """Read weights and card into a network of torch, by default the shipped ones; float32, in
    evaluation mode.

    Raises:
        LampblackError: a file is missing or malformed, or does not fit the network.
    """
    import torch

    from .networks import ARCHITECTURES, build_network

    path = path or shipped_weights()
    stored, card = read_weights(path)
    if card.architecture not in ARCHITECTURES:
        raise LampblackError(
            f"{path} is for a network named {card.architecture!r}.",
            f"This Lampblack knows: {', '.join(ARCHITECTURES)}.",
        )
    network = build_network(card.architecture)
    try:
        network.load_state_dict(
            {name: torch.from_numpy(array).float() for name, array in stored.items()}
        )
    except RuntimeError as error:
        raise _unusable(path, error) from error
    return network.eval(), card


def _unusable(path: Path, error: Exception) -> LampblackError:
    return LampblackError(f"The weights {path} cannot be used.", "Reinstall Lampblack.", str(error))


def write_tensors(path: Path, tensors: dict[str, torch.Tensor]) -> None:
    """Write a safetensors file, whole or not at all."""
    from safetensors.torch import save

    with atomic_file(path) as file:
        file.write(save(tensors))
