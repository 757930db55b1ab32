"""``lampblack evaluate``."""

from __future__ import annotations

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

from lampblack.atomic import atomic_file
from lampblack.cli.console import progress_bar
from lampblack.errors import LampblackError
from lampblack.normals.predict_tiles import PAPER_GRIDS

from ..evaluation.drawings import TestDrawing
from ..evaluation.evaluate import PEERS, Method, network_method
from ..evaluation.evaluate import evaluate as measure
from ..evaluation.sheet import ComparisonSheet

COLUMNS = (
    *("mean", "median", "l1", "l2", "under_11", "under_22", "under_30"),
    *("tilt", "truth_tilt", "rim", "truth_rim", "curvature", "concave", "seconds"),
)


class LinesOption(Enum):
    """Who inks the test drawings."""

    FREESTYLE = "freestyle"
    GBUFFER = "gbuffer"


def evaluate(
    models: Annotated[
        Path, typer.Option("--models", metavar="DIR", help="Meshes; split.csv names train and val.")
    ],
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
