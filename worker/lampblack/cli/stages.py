"""One stage at a time: ``normals``, ``mesh``, ``palette`` and ``scene``."""

from __future__ import annotations

import sys
import warnings
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import msgspec
import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from ..atomic import atomic_file
from ..drawing import save_picture, take_apart
from ..errors import DrawingError, LampblackWarning, NothingDrawnError
from ..finals.order import OpenShot, Order, open_shot
from ..finals.shot import by_drawing
from ..normals.predict import DEFAULT_GRIDS
from ..pipeline import Pipeline, PipelineOptions
from ..scene import Canvas, Material, default_scene, encode_scene
from ..surface import save_mesh
from .console import progress_bar
from .options import (
    GridsOption,
    InkOption,
    InputsArgument,
    MaskOption,
    Solver,
    SolverOption,
    check_suffix,
    keep_inputs,
    open_cache,
    read_drawing,
)

Drawn = Annotated[Path, typer.Argument(metavar="DRAWING", help="A PNG.")]


def normals(
    drawing: Drawn,
    output: Annotated[Path, typer.Option("-o", "--output", help="A .png or .npy file.")],
    grids: GridsOption = DEFAULT_GRIDS,
    mask: MaskOption = None,
    ink: InkOption = None,
) -> None:
    """Predict the normal map of a drawing.

    .npy holds (H, W, 3) float32, x right, y up, z to the viewer, unit in the mask, 0 outside;
    .png the same from -1..1 to 0..255, transparent outside.

    Example: lampblack normals hero.png -o hero.normals.png
    """
    check_suffix(output, ".png", ".npy")
    keep_inputs(output, [drawing, *filter(None, (mask, ink))])
    taken = read_drawing(drawing, mask, ink)
    with Pipeline(open_cache(), PipelineOptions(grids=grids)) as pipeline, progress_bar() as bar:
        task = bar.add_task("Predicting", total=100)
        found = pipeline.normals(taken, lambda share: bar.update(task, completed=int(100 * share)))
    if output.suffix.lower() == ".npy":
        with atomic_file(output) as file:
            np.save(file, found, allow_pickle=False)
        return
    colours = np.round((found * 0.5 + 0.5) * 255) * taken.mask[..., None]
    save_picture(output, np.dstack([colours, taken.mask * 255]).astype(np.uint8))


def mesh(
    drawing: Drawn,
    output: Annotated[Path, typer.Option("-o", "--output", help="A .glb, .obj or .ply file.")],
    solver: SolverOption = Solver.DIRECT,
    grids: GridsOption = DEFAULT_GRIDS,
    stride: Annotated[int, typer.Option(min=1, max=64, help="Pixels between two vertices.")] = 1,
    relief_scale: Annotated[
        float, typer.Option(min=0.01, max=10, help="Depth, 1 as predicted.")
    ] = 1.0,
    mask: MaskOption = None,
    ink: InkOption = None,
) -> None:
    """Inflate a drawing into a closed relief mesh, in pixels, y up, z to the viewer.

    Example: lampblack mesh hero.png -o hero.glb
    """
    check_suffix(output, ".glb", ".obj", ".ply")
    taken = read_drawing(drawing, mask, ink)
    options = PipelineOptions(grids, solver.value)
    with Pipeline(open_cache(), options) as pipeline, progress_bar() as bar:
        task = bar.add_task("Inflating", total=100)
        pipeline.height(taken, lambda share: bar.update(task, completed=int(99 * share)))
        relief = pipeline.relief(taken, relief_scale=relief_scale, stride=stride)
    save_mesh(relief, output)


def palette(
    inputs: InputsArgument,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    mask: MaskOption = None,
    ink: InkOption = None,
) -> None:
    """List the flat colours of drawings, most used first.

    Example: lampblack palette walk/
    """
    counts = _count_colours(_open(inputs, mask, ink))
    if as_json:
        rows = [{"colour": colour, "pixels": pixels} for colour, pixels in counts]
        sys.stdout.write(msgspec.json.encode(rows).decode() + "\n")
        return
    table = Table("colour", "", "pixels")
    for colour, pixels in counts:
        table.add_row(colour, f"[on {colour}]    [/]", str(pixels))
    Console().print(table)


def scene(
    inputs: InputsArgument,
    output: Annotated[Path, typer.Option("-o", "--output", help="A .json file.")],
    mask: MaskOption = None,
    ink: InkOption = None,
) -> None:
    """Write a scene to start from: one light, and a material for each flat colour.

    Example: lampblack scene walk/ -o walk.json
    """
    check_suffix(output, ".json")
    shot = _open(inputs, mask, ink)
    canvas = shot.shot.canvas
    if canvas is None:
        height, width = shot.shot.cel(shot.frames[0]).pixels.shape[:2]
        canvas = Canvas(width, height)
    start = default_scene(canvas.width, canvas.height)
    materials = {colour: Material() for colour, _ in _count_colours(shot)}
    with atomic_file(output) as file:
        file.write(encode_scene(replace(start, materials=materials)))


def _open(inputs: list[str], mask: Path | None, ink: Path | None) -> OpenShot:
    mask_path, ink_path = (None if path is None else str(path) for path in (mask, ink))
    return open_shot(Order(inputs=tuple(inputs), output="", mask=mask_path, ink=ink_path))


def _count_colours(shot: OpenShot) -> list[tuple[str, int]]:
    """Flat colours and their pixels over all frames, most used first."""
    counts: Counter[str] = Counter()
    with progress_bar() as bar:
        for group in bar.track(by_drawing(shot.frames), description="Reading"):
            name = group[0].name
            try:
                cel = shot.shot.cel(group[0])
                drawing = take_apart(cel.pixels, mask=cel.mask, ink=cel.ink)
            except NothingDrawnError as error:
                if shot.single:
                    raise
                warnings.warn(f"{name}: {error.what}", LampblackWarning, stacklevel=2)
                continue
            except DrawingError as error:
                raise DrawingError(f"{name}: {error.what}", error.remedy, error.details) from error
            for swatch in drawing.palette.swatches:
                counts[swatch.colour] += swatch.pixels * len(group)
    return counts.most_common()
