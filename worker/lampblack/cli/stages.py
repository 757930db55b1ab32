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
from ..drawing import find_frames, load_picture, save_picture
from ..errors import DrawingError, LampblackWarning, NothingDrawnError
from ..normals.predict import DEFAULT_GRIDS
from ..pipeline import Pipeline, PipelineOptions
from ..scene import Material, default_scene, encode_scene
from ..surface import save_mesh
from .console import progress_bar
from .options import (
    GridsOption,
    InkOption,
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
    inputs: Annotated[
        list[str], typer.Argument(metavar="INPUT", help="PNG, folder, or walk.%04d.png.")
    ],
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    mask: MaskOption = None,
    ink: InkOption = None,
) -> None:
    """List the flat colours of drawings, most used first.

    Example: lampblack palette walk/
    """
    counts = _count_colours(inputs, mask, ink)
    if as_json:
        rows = [{"colour": colour, "pixels": pixels} for colour, pixels in counts]
        sys.stdout.write(msgspec.json.encode(rows).decode() + "\n")
        return
    table = Table("colour", "", "pixels")
    for colour, pixels in counts:
        table.add_row(colour, f"[on {colour}]    [/]", str(pixels))
    Console().print(table)


def scene(
    inputs: Annotated[
        list[str], typer.Argument(metavar="INPUT", help="PNG, folder, or walk.%04d.png.")
    ],
    output: Annotated[Path, typer.Option("-o", "--output", help="A .json file.")],
    mask: MaskOption = None,
    ink: InkOption = None,
) -> None:
    """Write a scene to start from: one light, and a material for each flat colour.

    Example: lampblack scene walk/ -o walk.json
    """
    check_suffix(output, ".json")
    first = load_picture(find_frames(inputs)[0].path)
    start = default_scene(first.shape[1], first.shape[0])
    materials = {colour: Material() for colour, _ in _count_colours(inputs, mask, ink)}
    with atomic_file(output) as file:
        file.write(encode_scene(replace(start, materials=materials)))


def _count_colours(inputs: list[str], mask: Path | None, ink: Path | None) -> list[tuple[str, int]]:
    counts: Counter[str] = Counter()
    found = find_frames(inputs)
    with progress_bar() as bar:
        for frame in bar.track(found, description="Reading"):
            try:
                drawing = read_drawing(frame.path, mask, ink)
            except NothingDrawnError as error:
                if len(found) == 1:
                    raise
                warnings.warn(f"{frame.path.name}: {error.what}", LampblackWarning, stacklevel=2)
                continue
            except DrawingError as error:
                raise DrawingError(
                    f"{frame.path.name}: {error.what}", error.remedy, error.details
                ) from error
            counts.update({swatch.colour: swatch.pixels for swatch in drawing.palette.swatches})
    return counts.most_common()
