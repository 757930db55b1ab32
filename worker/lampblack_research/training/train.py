"""Train a normal network on a data set.

Interrupt it at any moment: the same call goes on from the last checkpoint.
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

from lampblack.errors import LampblackError, OutputError
from lampblack.normals.card import NetworkCard, load_network
from lampblack.normals.networks import CharacterNet, build_network

from .checkpoint import Checkpoint, Progress
from .example import save_examples
from .figures import FigureCourse
from .normalisation import retake_statistics
from .recipe import DECAY, Network, optimisers
from .tiles import TileCourse

EXAMPLES = 8
STATISTICS_ROUNDS = 20
LOG_STEPS = 50
_ANGLE_STEPS = 100
"""Steps over which the mean angle is told."""


@dataclass(frozen=True)
class TrainingOptions:
    """``minutes`` of processor time of each of ``threads`` are the whole budget, over all runs:
    a busy or suspended machine does not shorten it. ``rate`` multiplies the learning rates of
    ``recipe``, which are reached after ``warm_up`` of the budget. The weights written
    are an average with a memory of ``1 / (1 - ema)`` steps. ``sides`` are those of the canvases
    of whole figures; a run that begins from nothing sees them on canvases of ``first_side``, at
    a third of the price, for ``first_share`` of its budget. ``capacity`` examples are kept in
    memory."""

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
    whole = isinstance(network, CharacterNet)
    steppers = optimisers(cast(Network, network))
    told: dict[str, object] = {
        "batch": options.batch,
        "seed": options.seed,
        "threads": options.threads,
    }
    stages = [(1.0, options.sides)]
    if whole and not begin_with:
        stages.insert(0, (options.first_share, (options.first_side,)))
    if whole:
        told["canvas_sides"] = [sides for _, sides in stages]
    checkpoint = Checkpoint(output, network, average, steppers, replace(card, training=told))
    run = _Run(network, average, steppers, checkpoint, options, report, checkpoint.load())
    for share, sides in stages:
        until = 60 * options.minutes * share
        if run.progress.seconds < until:
            seed = options.seed * 1_000_003 + run.progress.step
            with (
                FigureCourse(data, sides, seed, options.capacity)
                if whole
                else TileCourse(data, seed, options.capacity)
            ) as course:
                run.go(course, until)
    return checkpoint.weights


@dataclass
class _Run:
    network: nn.Module
    average: nn.Module
    steppers: Sequence[torch.optim.Optimizer]
    checkpoint: Checkpoint
    options: TrainingOptions
    report: Callable[[Progress], None]
    progress: Progress

    def __post_init__(self) -> None:
        for stepper in self.steppers:
            for group in stepper.param_groups:
                group["highest"] = group["lr"]

    def go(self, course: FigureCourse | TileCourse, until: float) -> None:
        """Follow the course until so many seconds are spent, all in all."""
        progress = self.progress
        earlier, began, saved = progress.seconds, time.process_time(), time.monotonic()
        try:
            while progress.seconds < until:
                self._step(course)
                progress.seconds = earlier + (time.process_time() - began) / self.options.threads
                if progress.step % LOG_STEPS == 0:
                    self.checkpoint.log(progress)
                self.report(progress)
                if time.monotonic() - saved > 60 * self.options.checkpoint_minutes:
                    self._keep(course)
                    saved = time.monotonic()
        finally:
            if progress.step:
                self._keep(course)

    def _step(self, course: FigureCourse | TileCourse) -> None:
        progress = self.progress
        loss = course.loss(self.network, self.options.batch)
        self.network.zero_grad(set_to_none=True)
        loss.total.backward()  # type: ignore[no-untyped-call]
        nn.utils.clip_grad_norm_(self.network.parameters(), 1.0)
        for stepper in self.steppers:
            for group in stepper.param_groups:
                group["lr"] = group["highest"] * self._rate()
            stepper.step()
        keep = min(self.options.ema, progress.step / (progress.step + 10))
        _follow(self.average, self.network, keep)
        progress.step += 1
        newest = max(1 / _ANGLE_STEPS, 1 / progress.step)
        progress.angle += (loss.angle - progress.angle) * newest

    def _rate(self) -> float:
        spent = self.progress.seconds / (60 * self.options.minutes)
        warm = (spent + 1e-3) / self.options.warm_up
        return self.options.rate * min(1.0, warm, (1 - spent) / DECAY)

    def _keep(self, course: FigureCourse | TileCourse) -> None:
        see = partial(course.loss, self.average, self.options.batch)
        retake_statistics(self.average, see, STATISTICS_ROUNDS)
        self.checkpoint.save(self.progress)
        save_examples(
            self.checkpoint.weights.with_name("examples.png"),
            course.examples(self.average, EXAMPLES),
        )


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


def _follow(average: nn.Module, network: nn.Module, keep: float) -> None:
    """Move the average towards the network, the statistics of its normalisations too."""
    with torch.no_grad():
        kept, new = average.state_dict(), network.state_dict()
        for name, tensor in kept.items():
            if tensor.is_floating_point():
                tensor.lerp_(new[name], 1 - keep)
            else:
                tensor.copy_(new[name])
