"""Networks run by ONNX Runtime, where torch is not installed.

The graph of an architecture is a small file without weights (``lampblack_research``'s
``training/export.py`` writes it). The weights are those of the safetensors file.
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..cache import digest
from ..errors import LampblackError
from ..files import read_bounded
from ..processors import usable_processors
from .card import NetworkCard, graph_path, read_weights
from .character import COARSE, LUMO
from .resize import resize

# It would report its use to its makers, and keep a number for this machine in the user's home.
os.environ["ORT_DISABLE_TELEMETRY"] = "1"
import onnxruntime as ort

MAX_GRAPH_BYTES = 4 << 20
ERRORS_ONLY = 3

Planes = NDArray[np.float32]


class OnnxNetwork:
    """A graph with weights; see ``Network``. Its answers are the same to the last bit whatever the
    number of threads.

    Args:
        graph: the ONNX model, whose initializers are named as the weights.
        weights: by name.
        threads: None is one for each processor that this process may use.
    """

    def __init__(
        self, graph: bytes, weights: dict[str, Planes], whole: bool, threads: int | None = None
    ) -> None:
        options = ort.SessionOptions()
        options.intra_op_num_threads = threads or _threads()
        options.inter_op_num_threads = 1
        options.log_severity_level = ERRORS_ONLY
        # A thread that waits for work by spinning takes a processor from the renderer.
        options.add_session_config_entry("session.intra_op.allow_spinning", "0")
        values = [ort.OrtValue.ortvalue_from_numpy(array) for array in weights.values()]
        options.add_external_initializers(list(weights), values)
        self._session = ort.InferenceSession(graph, options, providers=["CPUExecutionProvider"])
        self.identity = digest("onnx", graph, *weights.values())
        self.whole = whole

    @staticmethod
    def load(weights: Path, threads: int | None = None) -> tuple[OnnxNetwork, NetworkCard]:
        """The network of a safetensors file, its card and its graph.

        Raises:
            LampblackError: one of the three is missing or malformed, or they do not fit.
        """
        arrays, card = read_weights(weights)
        try:
            graph = read_bounded(graph_path(weights), MAX_GRAPH_BYTES)
            used = {
                name: array.astype(np.float32)
                for name, array in arrays.items()
                if name.encode() in graph
            }
            return OnnxNetwork(graph, used, card.architecture == "figure-net", threads), card
        except Exception as error:  # onnxruntime has no error of its own to name
            raise LampblackError(
                f"The network {weights} cannot be used.", "Reinstall Lampblack.", str(error)[:1000]
            ) from error

    def predict_character(self, fine: Planes, coarse: Planes) -> tuple[Planes, Planes]:
        """See ``Network``."""
        correction, auxiliary = self._session.run(None, {"fine": fine, "coarse": coarse})
        lumo = [resize(one.transpose(1, 2, 0), fine.shape[2:]) for one in coarse[:, LUMO]]
        vectors = np.stack(lumo).transpose(0, 3, 1, 2) + correction[:, :3]
        assert coarse.shape[2] * COARSE == fine.shape[2]
        return vectors, auxiliary

    def predict_tiles(self, tiles: Planes) -> Planes:
        """See ``Network``."""
        (vectors,) = self._session.run(None, {"tiles": tiles})
        predicted: Planes = vectors
        return predicted


def _threads() -> int:
    usable = usable_processors()
    said = os.environ.get("OMP_NUM_THREADS", "")
    return min(usable, int(said)) if said.isdecimal() and int(said) else usable
