"""Train a normal network on a data set.

It can be interrupted at any moment: the same call continues from the last checkpoint.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import cast

import torch
from torch import nn

from lampblack.atomic import make_folder
from lampblack.errors import LampblackError
from lampblack.normals.card import NetworkCard, load_network
from lampblack.normals.networks import CharacterNet, build_network

from .character_batches import CharacterBatches
from .checkpoint import Checkpoint, Progress
from .example import save_examples
from .normalisation import recompute_statistics
from .recipe import DECAY, Network, build_optimizers
from .tile_batches import TileBatches

EXAMPLES = 8
STATISTICS_ROUNDS = 20
LOG_STEPS = 50
_ANGLE_STEPS = 100
"""Number of steps over which the reported angle is averaged."""


@dataclass(frozen=True)
class TrainingOptions:
    """How to train.

    Attributes:
        minutes: budget of processor time of each of ``threads``, over all calls together. A busy
            or suspended machine does not shorten it.
        sides: canvases of whole characters have the areas of squares of these sides, pixels.
        first_side: side of the canvases for the first ``first_share`` of the budget of a run
            without initial weights. At 128 a step takes a third of the time.
        rate: factor on the learning rates of ``recipe``.
        warm_up: share of the budget over which the learning rates rise to their peak.
        ema: the weights written are an average with a memory of ``1 / (1 - ema)`` steps.
        capacity: number of examples kept in memory.
    """

    minutes: float = 60.0
    threads: int = 1
    batch: int = 12
    sides: tuple[int, ...] = (160, 192, 256, 352)
    first_side: int = 128
    first_share: float = 0.4
    rate: float = 1.0
    warm_up: float = 0.03
    ema: float = 0.998
    checkpoint_minutes: float = 3.0
    capacity: int = 2000
    seed: int = 0


def train(
    data: Path,
    output: Path,
    card: NetworkCard,
    options: TrainingOptions,
    report: Callable[[Progress], None] = lambda progress: None,
    init_from: Sequence[Path] = (),
) -> Path:
    """Train until the budget is spent; return the file of averaged weights in ``output``.

    Args:
        init_from: weights of the same architecture. A new run starts from their mean. The mean
            of runs with a common start is often better than each of them (model soups, Wortsman
            2022).

    Raises:
        LampblackError: no data set, weights of another architecture, or a run folder that
            cannot be used.
    """
    torch.set_num_threads(options.threads)
    make_folder(output)
    torch.manual_seed(options.seed)
    network = _initial_network(card, init_from).train()
    average = build_network(card.architecture)
    average.load_state_dict(network.state_dict())
    whole = isinstance(network, CharacterNet)
    optimizers = build_optimizers(cast(Network, network))
    settings: dict[str, object] = {
        "batch": options.batch,
        "seed": options.seed,
        "threads": options.threads,
    }
    stages = [(1.0, options.sides)]
    if whole and not init_from:
        stages.insert(0, (options.first_share, (options.first_side,)))
    if whole:
        settings["canvas_sides"] = [sides for _, sides in stages]
    checkpoint = Checkpoint(output, network, average, optimizers, replace(card, training=settings))
    run = _Run(network, average, optimizers, checkpoint, options, report, checkpoint.load())
    for share, sides in stages:
        until = 60 * options.minutes * share
        if run.progress.seconds < until:
            seed = options.seed * 1_000_003 + run.progress.step
            with (
                CharacterBatches(data, sides, seed, options.capacity)
                if whole
                else TileBatches(data, seed, options.capacity)
            ) as batches:
                run.train_until(batches, until)
    return checkpoint.weights


@dataclass
class _Run:
    network: nn.Module
    average: nn.Module
    optimizers: Sequence[torch.optim.Optimizer]
    checkpoint: Checkpoint
    options: TrainingOptions
    report: Callable[[Progress], None]
    progress: Progress

    def __post_init__(self) -> None:
        for optimizer in self.optimizers:
            for group in optimizer.param_groups:
                group["peak"] = group["lr"]

    def train_until(self, batches: CharacterBatches | TileBatches, until: float) -> None:
        """Train until so many seconds are spent, over all calls together."""
        progress = self.progress
        earlier, began, saved = progress.seconds, time.process_time(), time.monotonic()
        try:
            while progress.seconds < until:
                self._step(batches)
                progress.seconds = earlier + (time.process_time() - began) / self.options.threads
                if progress.step % LOG_STEPS == 0:
                    self.checkpoint.log(progress)
                self.report(progress)
                if time.monotonic() - saved > 60 * self.options.checkpoint_minutes:
                    self._save(batches)
                    saved = time.monotonic()
        finally:
            if progress.step:
                self._save(batches)

    def _step(self, batches: CharacterBatches | TileBatches) -> None:
        progress = self.progress
        loss = batches.loss(self.network, self.options.batch)
        self.network.zero_grad(set_to_none=True)
        loss.total.backward()  # type: ignore[no-untyped-call]
        nn.utils.clip_grad_norm_(self.network.parameters(), 1.0)
        for optimizer in self.optimizers:
            for group in optimizer.param_groups:
                group["lr"] = group["peak"] * self._rate()
            optimizer.step()
        keep = min(self.options.ema, progress.step / (progress.step + 10))
        update_ema(self.average, self.network, keep)
        progress.step += 1
        newest = max(1 / _ANGLE_STEPS, 1 / progress.step)
        progress.angle += (loss.angle - progress.angle) * newest

    def _rate(self) -> float:
        spent = self.progress.seconds / (60 * self.options.minutes)
        warm = (spent + 1e-3) / self.options.warm_up
        return self.options.rate * min(1.0, warm, (1 - spent) / DECAY)

    def _save(self, batches: CharacterBatches | TileBatches) -> None:
        forward = partial(batches.loss, self.average, self.options.batch)
        recompute_statistics(self.average, forward, STATISTICS_ROUNDS)
        self.checkpoint.save(self.progress)
        save_examples(
            self.checkpoint.weights.with_name("examples.png"),
            batches.examples(self.average, EXAMPLES),
        )


def _initial_network(card: NetworkCard, init_from: Sequence[Path]) -> nn.Module:
    mean = build_network(card.architecture)
    for number, path in enumerate(init_from, 1):
        network, given = load_network(path)
        if given.architecture != card.architecture:
            raise LampblackError(
                f"{path} holds weights of {given.architecture}, not of {card.architecture}.",
                "Name their architecture with --network.",
            )
        update_ema(mean, network, 1 - 1 / number)
    return mean


def update_ema(average: nn.Module, network: nn.Module, keep: float) -> None:
    """``keep`` of the average and ``1 - keep`` of the network, normalisation statistics too."""
    with torch.no_grad():
        averaged, new = average.state_dict(), network.state_dict()
        for name, tensor in averaged.items():
            if tensor.is_floating_point():
                tensor.lerp_(new[name], 1 - keep)
            else:
                tensor.copy_(new[name])
