"""The graphs that ONNX Runtime runs, without weights: one of each architecture that is shipped.

    python -m lampblack_research.training.export

Run it again when an architecture changes. New weights of the same architecture need no new graph:
``lampblack.normals.onnx_network`` takes them from the safetensors file.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import torch
from torch import Tensor, nn

from lampblack.atomic import atomic_file
from lampblack.normals.card import graph_path, load_network, shipped_weights
from lampblack.normals.networks import CharacterNet
from lampblack.normals.tiles import TILE

OPSET = 18
ARCHITECTURES = "figure-net", "dilated-unet"


class _Correction(nn.Module):
    def __init__(self, network: CharacterNet) -> None:
        super().__init__()
        self.network = network

    def forward(self, fine: Tensor, coarse: Tensor) -> tuple[Tensor, Tensor]:
        return self.network.correction(fine, coarse)


class _Tiles(nn.Module):
    def __init__(self, network: nn.Module) -> None:
        super().__init__()
        self.network = network

    def forward(self, tiles: Tensor) -> Tensor:
        return self.network(tiles)  # type: ignore[no-any-return]


def export_graph(network: nn.Module, weights: str) -> bytes:
    """The ONNX graph of ``network``; its initializers refer to ``weights``, a file name."""
    network = network.to(memory_format=torch.contiguous_format).eval()  # type: ignore[call-overload]
    batch = torch.export.Dim("batch", min=1, max=8)
    if isinstance(network, CharacterNet):
        rows, columns = (torch.export.Dim(name, min=2, max=256) for name in ("rows", "columns"))
        shapes: Any = (
            {0: batch, 2: 32 * rows, 3: 32 * columns},
            {0: batch, 2: 8 * rows, 3: 8 * columns},
        )
        given: Any = (torch.rand(2, 2, 320, 256), torch.rand(2, 11, 80, 64))
        wrapped: nn.Module = _Correction(network)
        names: Any = {
            "input_names": ["fine", "coarse"],
            "output_names": ["correction", "auxiliary"],
        }
    else:
        shapes, given, wrapped = ({0: batch},), (torch.rand(2, 4, TILE, TILE),), _Tiles(network)
        names = {"input_names": ["tiles"], "output_names": ["normals"]}
    program = torch.onnx.export(
        wrapped, given, dynamo=True, opset_version=OPSET, optimize=False, dynamic_shapes=shapes,
        verbose=False, **names,
    )  # fmt: skip
    assert program is not None
    return _without_weights(program.model_proto, weights)


def _without_weights(model: Any, weights: str) -> bytes:
    renamed: dict[str, str] = {}
    for tensor in model.graph.initializer:
        if not tensor.name.startswith("network."):
            continue
        renamed[tensor.name] = tensor.name.removeprefix("network.")
        tensor.name = renamed[tensor.name]
        tensor.ClearField("raw_data")
        tensor.data_location = tensor.EXTERNAL
        location = tensor.external_data.add()
        location.key, location.value = "location", weights
    for node in model.graph.node:
        for index, name in enumerate(node.input):
            node.input[index] = renamed.get(name, name)
        node.doc_string = ""
        del node.metadata_props[:]
    for value in (*model.graph.input, *model.graph.output):
        del value.metadata_props[:]
    del model.graph.value_info[:], model.graph.metadata_props[:], model.metadata_props[:]
    serialized: bytes = model.SerializeToString(deterministic=True)
    return serialized


def main() -> None:
    """Write the graphs beside the shipped weights."""
    for architecture in ARCHITECTURES:
        weights: Path = shipped_weights(architecture)
        network, _ = load_network(weights)
        graph = export_graph(network, weights.name)
        with atomic_file(graph_path(weights)) as file:
            file.write(graph)
        sys.stdout.write(f"{graph_path(weights)}: {len(graph)} bytes\n")


if __name__ == "__main__":
    main()
