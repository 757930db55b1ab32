"""``lampblack train`` and ``lampblack evaluate``."""

from __future__ import annotations

from dataclasses import replace
from enum import Enum
from pathlib import Path
from typing import Annotated, Literal

import msgspec
import numpy as np
import typer
from numpy.typing import NDArray
from PIL import Image
from rich.console import Console
from rich.table import Table

from ..atomic import atomic_file
from ..errors import LampblackError
from ..normals.card import NetworkCard
from ..normals.evaluation.drawings import TestDrawing
from ..normals.evaluation.evaluate import PEERS, Method, network_method
from ..normals.evaluation.evaluate import evaluate as measure
from ..normals.evaluation.sheet import ComparisonSheet
from ..normals.predict_tiles import PAPER_GRIDS
from ..normals.training.checkpoint import Progress
from ..normals.training.train import TrainingOptions
from ..normals.training.train import train as run_training
from .console import console, progress_bar

Models = Annotated[
    Path, typer.Option("--models", metavar="DIR", help="Meshes; split.csv names train and val.")
]


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


COLUMNS = (
    *("mean", "median", "l1", "l2", "under_11", "under_22", "under_30"),
    *("tilt", "truth_tilt", "rim", "truth_rim", "curvature", "concave", "seconds"),
)


class LinesOption(Enum):
    """Who inks the test drawings."""

    FREESTYLE = "freestyle"
    GBUFFER = "gbuffer"


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
    console.print(f"Weights and card: {weights}", markup=False)


def evaluate(
    models: Models,
    split: Annotated[str, typer.Option(help="Part of split.csv; 'all' for every mesh.")] = "val",
    methods: Annotated[
        str,
        typer.Option(
            "--methods",
            help="Of lampblack, paper, flat, laigter, laigter-tuned, inflate, "
            "lumo, lumo-mixed; or NAME=FILE.safetensors for weights of your own, say "
            "hudon2018=runs/first/network.safetensors. The others are compared with the first.",
        ),
    ] = "lampblack,paper,flat,laigter,laigter-tuned,inflate,lumo,lumo-mixed",
    views: Annotated[int, typer.Option(min=1, max=64, help="Sides of each model.")] = 8,
    resolution: Annotated[
        int, typer.Option("--resolution", min=64, max=2048, help="Long side of the figure.")
    ] = 768,
    lines: Annotated[
        LinesOption, typer.Option("--lines", help="Who inks the drawings.")
    ] = LinesOption.FREESTYLE,
    as_json: Annotated[
        Path | None, typer.Option("--json", metavar="FILE", help="Write the figures as JSON.")
    ] = None,
    sheet: Annotated[
        Path | None, typer.Option("--sheet", metavar="PNG", help="Write a contact sheet.")
    ] = None,
) -> None:
    """Angle between predicted and true normals, for networks and their peers.

    Example: lampblack evaluate --models meshes/ --split val --json val.json
    """
    chosen = dict(_method(named) for named in methods.split(","))
    comparison = ComparisonSheet()

    def keep(drawing: TestDrawing, normals: dict[str, NDArray[np.float32]]) -> None:
        comparison.add(drawing, normals)

    kind: Literal["freestyle", "gbuffer"] = lines.value
    with progress_bar() as bar:
        task = bar.add_task("Evaluating", total=100)
        table = measure(
            models,
            None if split == "all" else split,
            chosen,
            views=views,
            figure_px=resolution,
            lines=kind,
            progress=lambda share: bar.update(task, completed=int(100 * share)),
            shown=keep if sheet else None,
        )
    if sheet:
        with atomic_file(sheet) as file:
            Image.fromarray(comparison.picture()).save(file, "PNG")
    if as_json:
        with atomic_file(as_json) as file:
            file.write(msgspec.json.format(msgspec.json.encode(table), indent=2) + b"\n")
    shown = Table("method", *COLUMNS)
    for name, row in table.items():
        shown.add_row(name, *(f"{row[column]:.3g}" for column in COLUMNS))
    Console(width=160).print(shown)


def _method(named: str) -> tuple[str, Method]:
    name, _, file = named.strip().partition("=")
    if file:
        return name, network_method(Path(file))
    if name == "lampblack":
        return name, network_method(None)
    if name == "paper":
        return name, network_method(None, PAPER_GRIDS)
    if name not in PEERS:
        raise LampblackError(
            f"There is no method {name!r}.",
            f"Known: lampblack, paper, {', '.join(PEERS)}; and NAME=FILE for weights of your own.",
        )
    return name, PEERS[name]
