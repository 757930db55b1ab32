"""Train a normal network on a data set.

Interrupt it at any moment: the same call goes on from the last checkpoint.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import torch
from torch import nn

from ...errors import OutputError
from ..card import NetworkCard
from ..networks import build_network
from .checkpoint import Checkpoint, Progress
from .figures import FigureCourse
from .tiles import TileCourse

FIGURES = ("figure-net",)
"""Architectures that see whole figures; the others see tiles."""

_LONGEST_STEP = 20.0
"""Seconds; a run that was suspended has not trained meanwhile."""


@dataclass(frozen=True)
class TrainingOptions:
    """``minutes`` is the whole budget, over all runs; over the last ``decay`` of it the learning
    rate falls to 0. ``capacity`` examples are kept in memory."""

    minutes: float = 60.0
    batch: int = 12
    learning_rate: float = 1e-3
    warm_up: int = 200
    decay: float = 0.4
    ema: float = 0.998
    checkpoint_minutes: float = 3.0
    capacity: int = 3000
    seed: int = 0


def train(
    data: Path,
    output: Path,
    card: NetworkCard,
    options: TrainingOptions,
    report: Callable[[Progress], None] = lambda progress: None,
) -> Path:
    """Train until the budget is spent; returns the averaged weights in ``output``.

    Raises:
        LampblackError: no data set, or a run folder that cannot be used.
    """
    try:
        output.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(
            f"The run folder {output} cannot be made.", "Choose another.", str(error)
        ) from error
    torch.manual_seed(options.seed)
    network = build_network(card.architecture).train()
    average = build_network(card.architecture)
    average.load_state_dict(network.state_dict())
    optimiser = torch.optim.AdamW(
        network.parameters(), lr=0.0, weight_decay=0.02, betas=(0.9, 0.98)
    )
    card = replace(card, training={"batch": options.batch, "seed": options.seed})
    checkpoint = Checkpoint(output, network, average, optimiser)
    progress = checkpoint.load()
    saved = time.monotonic()
    with _course(data, card, options, options.seed * 1_000_003 + progress.step) as course:
        try:
            while progress.seconds < 60 * options.minutes:
                started = time.monotonic()
                for group in optimiser.param_groups:
                    group["lr"] = _learning_rate(options, progress)
                loss = course.loss(network, options.batch)
                optimiser.zero_grad(set_to_none=True)
                loss.total.backward()  # type: ignore[no-untyped-call]
                nn.utils.clip_grad_norm_(network.parameters(), 1.0)
                optimiser.step()
                _follow(average, network, min(options.ema, progress.step / (progress.step + 10)))
                progress.step += 1
                progress.angle += (loss.angle - progress.angle) * max(0.01, 1 / progress.step)
                progress.seconds += min(time.monotonic() - started, _LONGEST_STEP)
                report(progress)
                if time.monotonic() - saved > 60 * options.checkpoint_minutes:
                    checkpoint.save(progress, card)
                    saved = time.monotonic()
        finally:
            checkpoint.save(progress, card)
    return checkpoint.weights


def _course(
    data: Path, card: NetworkCard, options: TrainingOptions, seed: int
) -> FigureCourse | TileCourse:
    if card.architecture in FIGURES:
        return FigureCourse(data, card.figure_px[1], seed, options.capacity)
    return TileCourse(data, seed, options.capacity)


def _learning_rate(options: TrainingOptions, progress: Progress) -> float:
    left = 1 - progress.seconds / (60 * options.minutes)
    warm = min(1.0, (progress.step + 1) / options.warm_up)
    falling = min(1.0, left / options.decay) if options.decay else 1.0
    return options.learning_rate * warm * falling


def _follow(average: nn.Module, network: nn.Module, keep: float) -> None:
    """Move the average towards the network, the statistics of its normalisations too."""
    with torch.no_grad():
        kept, new = average.state_dict(), network.state_dict()
        for name, tensor in kept.items():
            if tensor.is_floating_point():
                tensor.lerp_(new[name], 1 - keep)
            else:
                tensor.copy_(new[name])
