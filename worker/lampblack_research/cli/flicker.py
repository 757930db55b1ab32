"""``lampblack flicker``: how steady the normals of an animation are."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import asdict
from itertools import groupby, islice
from pathlib import Path
from typing import Annotated

import msgspec
import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from lampblack.cache import surface_cache
from lampblack.cli.console import progress_bar
from lampblack.cli.drawings import each_drawing
from lampblack.errors import LampblackError
from lampblack.finals.resolve import resolve_shot
from lampblack.finals.settings import RenderSettings
from lampblack.normals.predict import NormalPredictor
from lampblack.normals.temporal.neighbours import REACH
from lampblack.normals.temporal.temporal_filter import Neighbours, TemporalFilter
from lampblack.normals.temporal.thumbnail import RegistrationThumbnail
from lampblack.pipeline import Pipeline

from ..dataset.models import find_models
from ..evaluation.flicker import FlickerMeter
from ..evaluation.turntable import turntable

Rows = dict[str, dict[str, float]]


def flicker(
    inputs: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="INPUT", help="PNG, folder, walk.%04d.png, or one .pclx or .ora project."
        ),
    ] = None,
    models: Annotated[
        Path | None,
        typer.Option(
            "--models",
            metavar="DIR",
            help="Measure turntables of these meshes instead of drawings.",
        ),
    ] = None,
    split: Annotated[
        str, typer.Option(help="Meshes to use: a part of split.csv, or all for every mesh.")
    ] = "val",
    count: Annotated[
        int, typer.Option(min=1, max=1000, help="Number of meshes, evenly chosen.")
    ] = 3,
    as_json: Annotated[bool, typer.Option("--json", help="Print the table as JSON.")] = False,
) -> None:
    """Measure how much normals change from drawing to drawing.

    The table gives degrees, for normals as predicted and as smoothed. For drawings: the change
    after the motion of the whole character is removed (rigid) and the part of it that moving
    parts make (motion); the change after the motion of each place is removed (local); the
    departure from the drawings before and after (jitter). For turntables: the error against the
    truth, change and jitter along the points of the mesh, and rigid, which the truth has too.

    Example: lampblack flicker walk/
    """
    if bool(inputs) == (models is not None):
        raise LampblackError("Name drawings, or a folder of meshes with --models.")
    if models is not None:
        rows = _turntables(models, None if split == "all" else split, count)
    else:
        rows = _animation(inputs or [])
    if as_json:
        sys.stdout.write(msgspec.json.encode(rows).decode() + "\n")
        return
    table = Table("normals", *next(iter(rows.values())))
    for name, row in rows.items():
        table.add_row(name, *(f"{value:.2f}" for value in row.values()))
    Console().print(table)


def _animation(inputs: list[str]) -> Rows:
    temporal_filter = TemporalFilter()
    meters = {"predicted": FlickerMeter(temporal_filter), "steadied": FlickerMeter(temporal_filter)}
    for here, around in _in_context(_drawn(inputs)):
        meters["predicted"].add(here)
        meters["steadied"].add(temporal_filter.smoothed(here, around))
    return {name: asdict(meter.flicker) for name, meter in meters.items()}


def _drawn(inputs: list[str]) -> Iterator[RegistrationThumbnail]:
    """Each drawing once, in the order of the frames."""
    shot = resolve_shot(RenderSettings(inputs=tuple(inputs), output=""))
    shown = [list(frames) for _, frames in groupby(shot.frames, lambda frame: frame.drawing)]
    with Pipeline(surface_cache()) as pipeline:
        for _, drawing in each_drawing(shot, shown, "Predicting"):
            yield pipeline.thumbnail(drawing)


def _in_context(
    drawn: Iterator[RegistrationThumbnail],
) -> Iterator[tuple[RegistrationThumbnail, Neighbours]]:
    """Each drawing with its neighbours."""
    before: tuple[RegistrationThumbnail, ...] = ()
    ahead = list(islice(drawn, REACH + 1))
    while ahead:
        here, *after = ahead
        yield here, Neighbours(before, tuple(after))
        before = (here, *before)[:REACH]
        ahead = [*after, *islice(drawn, 1)]


def _turntables(folder: Path, split: str | None, count: int) -> Rows:
    """Measures of the chosen models' turntables, averaged."""
    found = find_models(folder, split)
    chosen = np.unique(np.linspace(0, len(found) - 1, min(count, len(found))).round().astype(int))
    predictor = NormalPredictor()
    with progress_bar() as bar:
        tables = [
            turntable(found[index], predictor)
            for index in bar.track(chosen.tolist(), description="Turning")
        ]
    return {
        name: {
            column: float(np.mean([asdict(table[name])[column] for table in tables]))
            for column in asdict(tables[0][name])
        }
        for name in tables[0]
    }
