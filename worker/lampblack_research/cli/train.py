"""``lampblack train``."""

from __future__ import annotations

from dataclasses import replace
from enum import Enum
from pathlib import Path
from typing import Annotated

import typer

from lampblack.cli.console import progress_bar, say
from lampblack.normals.card import NetworkCard

from ..training.checkpoint import Progress
from ..training.train import TrainingOptions
from ..training.train import train as run_training


class Network(Enum):
    """The networks that can be trained."""

    LAMPBLACK = "lampblack"
    PAPER = "paper"
    HUDON2018 = "hudon2018"


CARDS = {
    Network.LAMPBLACK: NetworkCard(),
    Network.PAPER: NetworkCard("dilated-unet", (256, 768)),
    Network.HUDON2018: NetworkCard("strided-unet", (256, 768)),
}


def train(
    data: Annotated[
        Path, typer.Argument(metavar="DATASET", help="What lampblack dataset build made.")
    ],
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Run folder.")],
    network: Annotated[
        Network, typer.Option("--network", help="Ours, the paper's or its predecessor.")
    ] = Network.LAMPBLACK,
    minutes: Annotated[
        float,
        typer.Option(
            min=0.01,
            help="Budget over all runs: processor time of the trainer over its threads, so that "
            "a busy or suspended machine does not shorten it.",
        ),
    ] = 60,
    threads: Annotated[
        int, typer.Option(min=1, max=256, help="Of the trainer; one more process loads data.")
    ] = 1,
    sides: Annotated[
        list[int] | None,
        typer.Option(
            "--side",
            min=64,
            max=1024,
            metavar="PIXELS",
            help="Of the square whose area the canvas of a whole figure has; give it several "
            "times, and figures are seen at all of these sizes.",
        ),
    ] = None,
    first_side: Annotated[
        int,
        typer.Option(
            min=64,
            max=1024,
            metavar="PIXELS",
            help="Of the canvases in the first two fifths of a run that begins from nothing: "
            "small ones cost little.",
        ),
    ] = TrainingOptions.first_side,
    begin_with: Annotated[
        list[Path] | None,
        typer.Option(
            "--from",
            metavar="SAFETENSORS",
            help="Weights that a new run begins with; of several, their mean.",
        ),
    ] = None,
    batch: Annotated[int, typer.Option(min=1, max=256, help="Figures or tiles a step.")] = 12,
    seed: Annotated[int, typer.Option(min=0, help="Of views and weights.")] = 0,
) -> None:
    """Train a normal network; run it again to go on after an interruption.

    In the run folder: network.safetensors, ready to use; curve.png; examples.png (drawing, truth,
    prediction); log.jsonl.

    Example: lampblack train dataset/ -o runs/first --minutes 90
    """
    options = TrainingOptions(
        minutes=minutes, threads=threads, batch=batch, seed=seed, first_side=first_side
    )
    if sides:
        options = replace(options, sides=tuple(sides))
    with progress_bar() as bar:
        task = bar.add_task("Training", total=round(60 * minutes))

        def report(progress: Progress) -> None:
            told = f"step {progress.step}, {progress.angle:.1f} degrees"
            bar.update(task, completed=round(progress.seconds), description=told)

        weights = run_training(data, output, CARDS[network], options, report, begin_with or ())
    say(f"Weights and card: {weights}")
