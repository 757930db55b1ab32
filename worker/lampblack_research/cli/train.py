"""``lampblack train``."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated, Literal

import typer

from lampblack.cli.console import progress_bar, say
from lampblack.normals.card import NetworkCard

from ..training.checkpoint import Progress
from ..training.train import TrainingOptions
from ..training.train import train as run_training

Network = Literal["lampblack", "paper", "hudon2018"]

CARDS: dict[Network, NetworkCard] = {
    "lampblack": NetworkCard(),
    "paper": NetworkCard("dilated-unet", (256, 768)),
    "hudon2018": NetworkCard("strided-unet", (256, 768)),
}


def train(
    data: Annotated[
        Path, typer.Argument(metavar="DATASET", help="Folder that lampblack dataset build made.")
    ],
    output: Annotated[
        Path,
        typer.Option(
            "-o", "--output", metavar="DIR", help="Folder for the weights and the log of the run."
        ),
    ],
    network: Annotated[
        Network,
        typer.Option(
            "--network", help="Network to train: ours, the paper's, or that of Hudon et al. 2018."
        ),
    ] = "lampblack",
    minutes: Annotated[
        float,
        typer.Option(
            min=0.01,
            help="Training time over all runs: processor time of the trainer divided by its "
            "threads, so that a busy machine does not shorten it.",
        ),
    ] = 60,
    threads: Annotated[
        int,
        typer.Option(min=1, max=256, help="Threads of the trainer; one more process loads data."),
    ] = 1,
    sides: Annotated[
        list[int] | None,
        typer.Option(
            "--side",
            min=64,
            max=1024,
            metavar="PIXELS",
            help="Size of a whole character's canvas: the side of a square of the same area. "
            "May be repeated, to train on several sizes.",
        ),
    ] = None,
    first_side: Annotated[
        int,
        typer.Option(
            min=64,
            max=1024,
            metavar="PIXELS",
            help="Size of the canvas in the first two fifths of a run that starts without weights; "
            "a small one takes less time.",
        ),
    ] = TrainingOptions.first_side,
    init_from: Annotated[
        list[Path] | None,
        typer.Option(
            "--from",
            metavar="SAFETENSORS",
            help="Weights to start a new run from. May be repeated, to start from their mean.",
        ),
    ] = None,
    batch: Annotated[
        int, typer.Option(min=1, max=256, help="Characters or tiles in a training step.")
    ] = 12,
    rate: Annotated[
        float,
        typer.Option(
            min=0.001, max=10, help="Factor on the learning rates; below 1 to refine weights."
        ),
    ] = 1.0,
    seed: Annotated[int, typer.Option(min=0, help="Random seed of views and weights.")] = 0,
) -> None:
    """Train a normal network.

    After an interruption, run the same command to continue. The output folder holds
    network.safetensors, ready to use; curve.png; examples.png (drawing, truth, prediction); and
    log.jsonl.

    Example: lampblack train dataset/ -o runs/first --minutes 90
    """
    options = TrainingOptions(
        minutes=minutes, threads=threads, batch=batch, rate=rate, seed=seed, first_side=first_side
    )
    if sides:
        options = replace(options, sides=tuple(sides))
    with progress_bar() as bar:
        task = bar.add_task("Training", total=round(60 * minutes))

        def report(progress: Progress) -> None:
            text = f"step {progress.step}, {progress.angle:.1f} degrees"
            bar.update(task, completed=round(progress.seconds), description=text)

        weights = run_training(data, output, CARDS[network], options, report, init_from or ())
    say(f"Weights and card: {weights}")
