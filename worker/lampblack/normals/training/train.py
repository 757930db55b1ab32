"""Train a normal network on a data set.

Interrupt it at any moment: the same call goes on from the last checkpoint.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import torch
from torch import nn

from ...errors import LampblackError, OutputError
from ..card import NetworkCard, load_network
from ..networks import build_network
from .checkpoint import Checkpoint, Progress
from .example import save_examples
from .figures import FigureCourse
from .normalisation import retake_statistics
from .tiles import TileCourse

FIGURES = ("figure-net",)
"""Architectures that see whole figures; the others see tiles."""

EXAMPLES = 8
STATISTICS_ROUNDS = 20
LOG_STEPS = 50
_ANGLE_STEPS = 100
"""Steps over which the mean angle is told."""


@dataclass(frozen=True)
class TrainingOptions:
    """``minutes`` of processor time of each of ``threads`` are the whole budget, over all runs:
    a busy or suspended machine does not shorten it. Over the last ``decay`` of it the learning
    rate falls to 0. The weights written are an average with a memory of ``1 / (1 - ema)`` steps.
    ``sides`` are those of the canvases of whole figures. ``capacity`` examples are kept in
    memory."""

    minutes: float = 60.0
    threads: int = 1
    batch: int = 12
    sides: tuple[int, ...] = (160, 192, 256, 352)
    learning_rate: float = 1e-3
    warm_up: int = 200
    decay: float = 0.4
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
    begin_with: Sequence[Path] = (),
) -> Path:
    """Train until the budget is spent; returns the averaged weights in ``output``.

    Args:
        begin_with: weights of the same architecture, for a run that begins: it begins with
            their mean. That of runs which began alike is often better than any of them (model
            soups, Wortsman 2022).

    Raises:
        LampblackError: no data set, weights of another architecture, or a run folder that
            cannot be used.
    """
    torch.set_num_threads(options.threads)
    try:
        output.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(
            f"The run folder {output} cannot be made.", "Choose another.", str(error)
        ) from error
    torch.manual_seed(options.seed)
    network = _first_weights(card, begin_with).train()
    average = build_network(card.architecture)
    average.load_state_dict(network.state_dict())
    optimiser = torch.optim.AdamW(
        network.parameters(), lr=0.0, weight_decay=0.02, betas=(0.9, 0.98), fused=True
    )
    told: dict[str, object] = {
        "batch": options.batch,
        "seed": options.seed,
        "threads": options.threads,
    }
    if card.architecture in FIGURES:
        told["canvas_sides"] = options.sides
    checkpoint = Checkpoint(output, network, average, optimiser, replace(card, training=told))
    progress = checkpoint.load()
    with _course(data, card, options, options.seed * 1_000_003 + progress.step) as course:

        def keep() -> None:
            see = partial(course.loss, average, options.batch)
            retake_statistics(average, see, STATISTICS_ROUNDS)
            checkpoint.save(progress)
            save_examples(output / "examples.png", course.examples(average, EXAMPLES))

        earlier, began, saved = progress.seconds, time.process_time(), time.monotonic()
        try:
            while progress.seconds < 60 * options.minutes:
                for group in optimiser.param_groups:
                    group["lr"] = _learning_rate(options, progress)
                loss = course.loss(network, options.batch)
                optimiser.zero_grad(set_to_none=True)
                loss.total.backward()  # type: ignore[no-untyped-call]
                nn.utils.clip_grad_norm_(network.parameters(), 1.0)
                optimiser.step()
                _follow(average, network, min(options.ema, progress.step / (progress.step + 10)))
                progress.step += 1
                progress.angle += (loss.angle - progress.angle) * max(
                    1 / _ANGLE_STEPS, 1 / progress.step
                )
                progress.seconds = earlier + (time.process_time() - began) / options.threads
                if progress.step % LOG_STEPS == 0:
                    checkpoint.log(progress)
                report(progress)
                if time.monotonic() - saved > 60 * options.checkpoint_minutes:
                    keep()
                    saved = time.monotonic()
        finally:
            if progress.step:
                keep()
    return checkpoint.weights


def _first_weights(card: NetworkCard, begin_with: Sequence[Path]) -> nn.Module:
    first = build_network(card.architecture)
    for number, path in enumerate(begin_with, 1):
        network, given = load_network(path)
        if given.architecture != card.architecture:
            raise LampblackError(
                f"{path} holds weights of {given.architecture}, not of {card.architecture}.",
                "Name the --network that they are for.",
            )
        _follow(first, network, 1 - 1 / number)
    return first


def _course(
    data: Path, card: NetworkCard, options: TrainingOptions, seed: int
) -> FigureCourse | TileCourse:
    if card.architecture in FIGURES:
        return FigureCourse(data, options.sides, seed, options.capacity)
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
