"""``lampblack dataset build``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import msgspec
import typer

from lampblack.atomic import atomic_file
from lampblack.cli.console import progress_bar, say

from ..dataset.build import DatasetOptions, build_dataset
from ..dataset.card import dataset_card
from ..dataset.sheet import dataset_sheet
from ..dataset.viewpoints import PAPER_VIEWPOINTS


def build(
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="DIR", help="Folder of the data set.")
    ],
    models: Annotated[
        Path | None,
        typer.Option(
            "--models", metavar="DIR", help="Folder of meshes to draw. Without it, only creatures."
        ),
    ] = None,
    split: Annotated[
        str, typer.Option(help="Meshes to draw: a part of split.csv, or all for every mesh.")
    ] = "all",
    views: Annotated[
        int, typer.Option(min=1, max=1000, help="Viewpoints for each mesh.")
    ] = PAPER_VIEWPOINTS,
    resolution: Annotated[
        int, typer.Option(min=64, max=2048, help="Side, in pixels, of a square character.")
    ] = 512,
    hands: Annotated[int, typer.Option(min=1, max=10, help="Line styles for each view.")] = 3,
    freestyle: Annotated[
        float, typer.Option(min=0, max=1, help="Share of views with a Freestyle drawing.")
    ] = 0.2,
    creatures: Annotated[
        int, typer.Option(min=0, max=100_000, help="Procedural creatures to add.")
    ] = 0,
    workers: Annotated[int, typer.Option(min=1, max=64, help="Number of worker processes.")] = 2,
    seed: Annotated[
        int, typer.Option(min=0, help="Random seed of viewpoints and line styles.")
    ] = 0,
) -> None:
    """Draw models from many sides.

    Each drawing comes with its exact normals, depth and occlusions. After an interruption, run
    the same command to continue.

    Example: lampblack dataset build --models meshes/ -o dataset/ --split train
    """
    options = DatasetOptions(
        views=views,
        resolution=resolution,
        hands=hands,
        freestyle=freestyle,
        creatures=creatures,
        workers=workers,
        seed=seed,
    )
    with progress_bar() as bar:
        task = bar.add_task("Building", total=None)
        there = build_dataset(
            models,
            output,
            None if split == "all" else split,
            options,
            lambda done, total: bar.update(task, completed=done, total=total),
        )
    with atomic_file(output / "card.json") as file:
        card = dataset_card(output, options)
        file.write(msgspec.json.format(msgspec.json.encode(card), indent=2) + b"\n")
    with atomic_file(output / "sheet.png") as file:
        dataset_sheet(output).save(file, "PNG")
    say(f"{there} entries, card.json and sheet.png: {output}")
