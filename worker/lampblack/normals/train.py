"""Train a normal network on meshes, drawn and traced on the fly.

    lampblack train --models meshes/ -o runs/first --minutes 60

Interrupt it at any moment: the same command goes on from the last checkpoint.
"""

from __future__ import annotations

import multiprocessing
import os
import queue
import time
from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.queues import Queue
from pathlib import Path

import msgspec
import numpy as np
import torch
from safetensors import SafetensorError
from safetensors.torch import load_file
from torch import Tensor

from ..errors import LampblackError, OutputError
from .card import NetworkCard, save_network, write_tensors
from .models import find_models
from .network import build_network, normal_loss
from .views import View, random_views

RESERVOIR_VIEWS = 1200
TILES_PER_VIEW = 8


@dataclass(frozen=True)
class TrainingOptions:
    """``minutes`` is the whole budget, over all runs; the learning rate falls to 0 at its end."""

    minutes: float = 60.0
    batch: int = 16
    learning_rate: float = 1.5e-3
    ema: float = 0.998
    checkpoint_minutes: float = 3.0
    seed: int = 0


@dataclass
class Progress:
    """Where a run stands: steps done, seconds trained, running mean angle in degrees."""

    step: int = 0
    seconds: float = 0.0
    angle: float = 90.0


def train(
    models: Path,
    output: Path,
    card: NetworkCard,
    options: TrainingOptions,
    report: Callable[[Progress], None] = lambda progress: None,
) -> Path:
    """Train until the budget is spent; returns the EMA weights, ``output/network.safetensors``.

    Raises:
        LampblackError: no models that can be drawn, or a run folder that cannot be used.
    """
    paths = find_models(models, "train")
    try:
        output.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(
            f"The run folder {output} cannot be made.", "Choose another.", str(error)
        ) from error
    torch.manual_seed(options.seed)
    network = build_network(card).train()
    average = build_network(card)
    average.load_state_dict(network.state_dict())
    optimiser = torch.optim.AdamW(network.parameters(), lr=0.0, weight_decay=1e-4)
    state = TrainingState(output, network, average, optimiser)
    progress = state.load()

    views: Queue[View] = multiprocessing.get_context("spawn").Queue(maxsize=16)
    painter = multiprocessing.get_context("spawn").Process(
        target=_paint_views,
        args=(views, paths, options.seed * 1_000_003 + progress.step, card.figure_px),
        daemon=True,
    )
    painter.start()
    rng = np.random.default_rng(options.seed + progress.step)
    reservoir: list[View] = []
    saved = time.monotonic()
    try:
        while progress.seconds < 60 * options.minutes:
            started = time.monotonic()
            _refill(reservoir, views, options.batch, painter.is_alive)
            tiles, truth = _batch(reservoir, options.batch, rng)
            done = progress.seconds / (60 * options.minutes)
            warm = min(1.0, (progress.step + 1) / 200)
            for group in optimiser.param_groups:
                group["lr"] = options.learning_rate * warm * 0.5 * (1 + np.cos(np.pi * done))
            with torch.autocast("cpu", torch.bfloat16):
                predicted = network(tiles)
            loss = normal_loss(predicted, truth, tiles[:, 3:4])
            optimiser.zero_grad(set_to_none=True)
            loss.backward()  # type: ignore[no-untyped-call]
            torch.nn.utils.clip_grad_norm_(network.parameters(), 1.0)
            optimiser.step()
            _update_average(
                average, network, min(options.ema, progress.step / (progress.step + 10))
            )
            angle = mean_angle(predicted.detach().float(), truth, tiles[:, 3:4])
            progress.angle += (angle - progress.angle) * max(0.01, 1 / (progress.step + 1))
            progress.step += 1
            # A run that was suspended has not trained meanwhile.
            progress.seconds += min(time.monotonic() - started, 10.0)
            report(progress)
            if time.monotonic() - saved > 60 * options.checkpoint_minutes:
                state.save(progress, card, options)
                saved = time.monotonic()
    finally:
        painter.kill()
        painter.join()
        state.save(progress, card, options)
    return state.weights


class TrainingState:
    """Everything a run needs to go on, as safetensors and JSON in its folder."""

    def __init__(
        self,
        folder: Path,
        network: torch.nn.Module,
        average: torch.nn.Module,
        optimiser: torch.optim.Optimizer,
    ) -> None:
        self.weights = folder / "network.safetensors"
        self._tensors = folder / "checkpoint.safetensors"
        self._log = folder / "log.jsonl"
        self._network, self._average, self._optimiser = network, average, optimiser

    def save(self, progress: Progress, card: NetworkCard, options: TrainingOptions) -> None:
        """Write checkpoint, EMA weights and a line of the log."""
        moments = {
            f"optimiser.{index}.{name}": torch.as_tensor(value)
            for index, moment in self._optimiser.state_dict()["state"].items()
            for name, value in moment.items()
        }
        named = {f"network.{n}": t for n, t in self._network.state_dict().items()}
        named |= {f"average.{n}": t for n, t in self._average.state_dict().items()}
        where = torch.tensor([progress.step, progress.seconds, progress.angle], dtype=torch.float64)
        tensors = {n: t.contiguous().clone() for n, t in (named | moments).items()}
        write_tensors(self._tensors, tensors | {"progress": where})
        training = {"steps": progress.step, "minutes": round(progress.seconds / 60, 1)}
        training |= {"batch": options.batch, "seed": options.seed}
        save_network(
            self.weights,
            self._average,
            NetworkCard(card.architecture, card.figure_px, training, card.measured),
        )
        with self._log.open("ab") as log:
            log.write(msgspec.json.encode(progress) + b"\n")

    def load(self) -> Progress:
        """Go on from the last checkpoint, if there is one."""
        if not self._tensors.exists():
            return Progress()
        try:
            tensors = load_file(self._tensors)
        except (OSError, SafetensorError) as error:
            raise LampblackError(
                f"The checkpoint {self._tensors} is damaged.",
                "Remove it to begin anew.",
                str(error),
            ) from error
        for prefix, module in (("network.", self._network), ("average.", self._average)):
            module.load_state_dict(
                {n.removeprefix(prefix): t for n, t in tensors.items() if n.startswith(prefix)}
            )
        state: dict[int, dict[str, Tensor]] = {}
        for name, tensor in tensors.items():
            if name.startswith("optimiser."):
                _, index, field = name.split(".")
                state.setdefault(int(index), {})[field] = tensor
        groups = self._optimiser.state_dict()["param_groups"]
        self._optimiser.load_state_dict({"state": state, "param_groups": groups})
        step, seconds, angle = tensors["progress"].tolist()
        return Progress(int(step), seconds, angle)


def mean_angle(predicted: Tensor, truth: Tensor, mask: Tensor) -> float:
    """Mean angle in degrees between two (B, 3, H, W) normal maps inside (B, 1, H, W)."""
    unit = torch.nn.functional.normalize(predicted, dim=1)
    cosine = (unit * truth).sum(dim=1, keepdim=True).clamp(-1, 1)
    return float((torch.rad2deg(cosine.acos()) * mask).sum() / mask.sum().clamp(min=1))


def _update_average(average: torch.nn.Module, network: torch.nn.Module, keep: float) -> None:
    with torch.no_grad():
        for kept, new in zip(average.parameters(), network.parameters(), strict=True):
            kept.lerp_(new, 1 - keep)


def _refill(
    reservoir: list[View], views: Queue[View], batch: int, painting: Callable[[], bool]
) -> None:
    """Take in fresh views in step with the tiles they are to give; wait only while there are
    few, and only while they are being painted."""
    for _ in range(max(1, batch // TILES_PER_VIEW)):
        while True:
            try:
                view = views.get(timeout=1.0 if len(reservoir) < 32 else 0.001)
                break
            except queue.Empty:
                if len(reservoir) >= 32:
                    return
                if not painting():
                    raise LampblackError(
                        "No drawings come from the models.", "Check that the meshes can be read."
                    ) from None
        reservoir.append(view)
        if len(reservoir) > RESERVOIR_VIEWS:
            reservoir.pop(0)


def _batch(reservoir: list[View], size: int, rng: np.random.Generator) -> tuple[Tensor, Tensor]:
    cut = [reservoir[rng.integers(len(reservoir))].tile(rng) for _ in range(size)]
    tiles = torch.from_numpy(np.stack([tile for tile, _ in cut]))
    truth = torch.from_numpy(np.stack([normals for _, normals in cut]))
    return tiles.contiguous(memory_format=torch.channels_last), truth


def _paint_views(
    views: Queue[View], models: list[Path], seed: int, figure_px: tuple[int, int]
) -> None:
    """The painter process: it dies with its parent."""
    parent = os.getppid()
    painted = random_views(models, seed, figure_px)
    while True:
        try:
            view = next(painted)
        except LampblackError:
            return  # the trainer sees that no more comes, and says so
        while os.getppid() == parent:
            try:
                views.put(view, timeout=2)
                break
            except queue.Full:
                continue
        else:
            return
