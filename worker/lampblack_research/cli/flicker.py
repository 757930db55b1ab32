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
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table

from lampblack.cache import surface_cache
from lampblack.cli.console import progress_bar
from lampblack.cli.drawings import each_drawing
from lampblack.drawing import Drawing
from lampblack.errors import LampblackError
from lampblack.finals.resolve import resolve_shot
from lampblack.finals.settings import RenderSettings
from lampblack.normals.predict import NormalPredictor
from lampblack.normals.temporal.carry import carry_points
from lampblack.normals.temporal.neighbours import REACH
from lampblack.normals.temporal.temporal_filter import LazyNeighbours, Neighbours, TemporalFilter
from lampblack.normals.temporal.thumbnail import RegistrationThumbnail
from lampblack.pipeline import Pipeline
from lampblack.surface_maker import surface_step

from ..dataset.models import find_models
from ..evaluation.depth_figures import mean_known
from ..evaluation.flicker import FlickerMeter, lazy_neighbours
from ..evaluation.flips import Carry, FlipMeter
from ..evaluation.turntable import turntable

Rows = dict[str, dict[str, float]]


def flicker(
    inputs: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="INPUT", help="PNG, folder, walk.%04d.png, or one .pclx, .ora or .psd."
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
    """Measure how much normals and cuts change from drawing to drawing.

    The table gives degrees, for normals as predicted and as smoothed. For drawings: the change
    after the motion of the whole character is removed (rigid) and the part of it that moving
    parts make (motion); the change after the motion of each place is removed (local); the
    departure from the drawings before and after (jitter). For turntables: the error against the
    truth, change and jitter along the points of the mesh, and rigid, which the truth has too.

    The last columns are about cuts, where one part of the surface lies in front of another: their
    number, and of 100 cuts, how many swap sides in the next drawing, and how many swap, vanish or
    appear (flips).

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
    normals = {name: FlickerMeter(temporal_filter) for name in ("predicted", "steadied")}
    cuts = {name: FlipMeter() for name in normals}
    with Pipeline(surface_cache()) as pipeline:
        last: RegistrationThumbnail | None = None
        for (here, drawing), around in _in_context(_drawn(pipeline, inputs)):
            normals["predicted"].add(here)
            normals["steadied"].add(temporal_filter.smoothed(here, around))
            ahead = None if last is None else _carry(temporal_filter, last, here)
            back = None if last is None else _carry(temporal_filter, here, last)
            for name, near in (("predicted", None), ("steadied", lazy_neighbours(around))):
                height = np.where(drawing.mask, _height(pipeline, drawing, near), np.nan)
                cuts[name].add(height.astype(np.float32), ahead, back)
            last = here
    return {
        name: asdict(meter.flicker) | cuts[name].flips._asdict() for name, meter in normals.items()
    }


Drawn = tuple[RegistrationThumbnail, Drawing]


def _drawn(pipeline: Pipeline, inputs: list[str]) -> Iterator[Drawn]:
    """Each drawing once, in the order of the frames."""
    shot = resolve_shot(RenderSettings(inputs=tuple(inputs), output=""))
    shown = [list(frames) for _, frames in groupby(shot.frames, lambda frame: frame.drawing)]
    for _, drawing in each_drawing(shot, shown, "Predicting"):
        yield pipeline.surfaces.thumbnail(drawing), drawing


def _in_context(drawn: Iterator[Drawn]) -> Iterator[tuple[Drawn, Neighbours]]:
    """Each drawing with its neighbours."""
    before: tuple[RegistrationThumbnail, ...] = ()
    ahead = list(islice(drawn, REACH + 1))
    while ahead:
        here, *after = ahead
        yield here, Neighbours(before, tuple(small for small, _ in after))
        before = (here[0], *before)[:REACH]
        ahead = [*after, *islice(drawn, 1)]


def _height(
    pipeline: Pipeline, drawing: Drawing, neighbours: LazyNeighbours | None
) -> NDArray[np.float32]:
    """(H, W) height at the size of the drawing."""
    height = pipeline.prepare(drawing, neighbours).height
    step = surface_step(drawing)
    whole = height.repeat(step, axis=0).repeat(step, axis=1)
    beyond = [(0, max(0, n - m)) for n, m in zip(drawing.mask.shape, whole.shape, strict=True)]
    return np.pad(whole, beyond, "edge")[: drawing.mask.shape[0], : drawing.mask.shape[1]]


def _carry(
    temporal_filter: TemporalFilter, here: RegistrationThumbnail, there: RegistrationThumbnail
) -> Carry:
    seen = temporal_filter.registration(here, there)
    return lambda points: carry_points(points, here, there, seen)


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
            column: mean_known([asdict(table[name])[column] for table in tables])
            for column in asdict(tables[0][name])
        }
        for name in tables[0]
    }
