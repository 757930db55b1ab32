"""Checkpoints of a training run: safetensors, and a JSON log, in its folder."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import msgspec
import torch
from safetensors import SafetensorError
from safetensors.torch import load_file
from torch import Tensor, nn

from lampblack.atomic import atomic_file
from lampblack.errors import LampblackError
from lampblack.normals.card import NetworkCard, save_network, write_tensors

from .curve import save_curve


@dataclass
class Progress:
    """Progress of a run: steps done, seconds trained, running mean angle in degrees."""

    step: int = 0
    seconds: float = 0.0
    angle: float = 90.0


class Checkpoint:
    """The files of a run.

    ``network.safetensors`` holds the averaged weights, with ``card`` beside it;
    ``checkpoint.safetensors`` holds all that is needed to continue; ``log.jsonl`` and
    ``curve.png`` show the mean angle over time.
    """

    def __init__(
        self,
        folder: Path,
        network: nn.Module,
        average: nn.Module,
        optimizers: Sequence[torch.optim.Optimizer],
        card: NetworkCard,
    ) -> None:
        self.weights = folder / "network.safetensors"
        self._tensors = folder / "checkpoint.safetensors"
        self._log, self._curve = folder / "log.jsonl", folder / "curve.png"
        self._card = card
        self._logged: list[Progress] = []
        self._network, self._average, self._optimisers = network, average, optimizers

    def log(self, progress: Progress) -> None:
        """Append to the log, which is written with the next checkpoint."""
        self._logged.append(replace(progress))

    def save(self, progress: Progress) -> None:
        """Write checkpoint, averaged weights, log and curve."""
        moments = {
            f"optimiser.{which}.{index}.{name}": torch.as_tensor(value)
            for which, optimizer in enumerate(self._optimisers)
            for index, moment in optimizer.state_dict()["state"].items()
            for name, value in moment.items()
        }
        named = {f"network.{n}": t for n, t in self._network.state_dict().items()}
        named |= {f"average.{n}": t for n, t in self._average.state_dict().items()}
        where = torch.tensor([progress.step, progress.seconds, progress.angle], dtype=torch.float64)
        tensors = {n: t.contiguous().clone() for n, t in (named | moments).items()}
        write_tensors(self._tensors, tensors | {"progress": where})
        training = (self._card.training or {}) | {
            "steps": progress.step,
            "minutes": round(progress.seconds / 60, 1),
        }
        save_network(self.weights, self._average, replace(self._card, training=training))
        with atomic_file(self._log) as log:
            log.writelines(msgspec.json.encode(past) + b"\n" for past in self._logged)
        if self._logged:
            minutes = [past.seconds / 60 for past in self._logged]
            angles = [past.angle for past in self._logged]
            save_curve(self._curve, minutes, angles, self._card.architecture)

    def load(self) -> Progress:
        """Restore the last checkpoint, if there is one.

        Raises:
            LampblackError: it is damaged, or is of another network.
        """
        if not self._tensors.exists():
            return Progress()
        states: list[dict[int, dict[str, Tensor]]] = [{} for _ in self._optimisers]
        try:
            tensors = load_file(self._tensors)
            for prefix, module in (("network.", self._network), ("average.", self._average)):
                module.load_state_dict(
                    {n.removeprefix(prefix): t for n, t in tensors.items() if n.startswith(prefix)}
                )
            step, seconds, angle = tensors["progress"].tolist()
            for name, tensor in tensors.items():
                if name.startswith("optimiser."):
                    _, which, index, field = name.split(".")
                    states[int(which)].setdefault(int(index), {})[field] = tensor
            if self._log.exists():
                lines = self._log.read_bytes().splitlines()
                self._logged = [msgspec.json.decode(line, type=Progress) for line in lines]
        except (
            *(OSError, SafetensorError, msgspec.DecodeError),
            *(RuntimeError, KeyError, ValueError, IndexError),
        ) as error:
            raise LampblackError(
                f"The checkpoint {self._tensors} is damaged, or of another network or version.",
                "Remove it to start again.",
                str(error),
            ) from error
        for optimizer, state in zip(self._optimisers, states, strict=True):
            groups = optimizer.state_dict()["param_groups"]
            optimizer.load_state_dict({"state": state, "param_groups": groups})
        return Progress(int(step), seconds, angle)
