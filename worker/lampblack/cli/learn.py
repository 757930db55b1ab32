"""``lampblack train`` and ``lampblack evaluate``."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import msgspec
import typer
from rich.console import Console
from rich.table import Table

from ..normals.card import NetworkCard, load_network
from ..normals.evaluate import evaluate as measure
from ..normals.predict import DEFAULT_GRIDS, NormalPredictor
from ..normals.train import Progress, TrainingOptions
from ..normals.train import train as run_training
from .console import console, progress_bar
from .options import GridsOption

Models = Annotated[
    Path, typer.Option("--models", metavar="DIR", help="Meshes; split.csv names train and val.")
]


def train(
    models: Models,
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Run folder.")],
    minutes: Annotated[float, typer.Option(min=0.01, help="Budget over all runs.")] = 60,
    batch: Annotated[int, typer.Option(min=1, max=256, help="Tiles a step.")] = 16,
    seed: Annotated[int, typer.Option(min=0, help="Of views and weights.")] = 0,
) -> None:
    """Train a normal network; run it again to go on after an interruption.

    Example: lampblack train --models meshes/ -o runs/first --minutes 90
    """
    with progress_bar() as bar:
        task = bar.add_task("Training", total=round(60 * minutes))

        def report(progress: Progress) -> None:
            told = f"step {progress.step}, {progress.angle:.1f} degrees"
            bar.update(task, completed=round(progress.seconds), description=told)

        options = TrainingOptions(minutes=minutes, batch=batch, seed=seed)
        weights = run_training(models, output, NetworkCard(), options, report)
    console.print(f"Weights and card: {weights}", markup=False)


def evaluate(
    models: Models,
    split: Annotated[str, typer.Option(help="Part of split.csv; 'all' for every mesh.")] = "val",
    weights: Annotated[
        Path | None, typer.Option("--weights", help="A .safetensors file; default: shipped.")
    ] = None,
    views: Annotated[int, typer.Option(min=1, max=64, help="Sides of each model.")] = 8,
    figure_px: Annotated[
        int, typer.Option("--figure-px", min=64, max=2048, help="Long side of the figure.")
    ] = 512,
    grids: GridsOption = DEFAULT_GRIDS,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Angle between predicted and true normals: flat, Lumo, inflation and ours.

    Example: lampblack evaluate --models meshes/ --split val
    """
    predictor = NormalPredictor(*load_network(weights))
    with progress_bar() as bar:
        task = bar.add_task("Evaluating", total=100)
        table = measure(
            models,
            None if split == "all" else split,
            predictor,
            views=views,
            figure_px=figure_px,
            grids=grids,
            progress=lambda share: bar.update(task, completed=int(100 * share)),
        )
    if as_json:
        sys.stdout.write(msgspec.json.encode(table).decode() + "\n")
        return
    shown = Table("method", "mean", "median", "tilt")
    for method, row in table.items():
        columns = ("mean_degrees", "median_degrees", "tilt_degrees")
        shown.add_row(method, *(f"{row[c]:.2f}" if c in row else "" for c in columns))
    Console().print(shown)
