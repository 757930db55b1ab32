"""``lampblack normals`` and ``mesh``: what a drawing's light falls on, one drawing or a shot."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from ..atomic import atomic_file
from ..drawing import Drawing, save_picture
from ..errors import DrawingError, LampblackWarning, NothingDrawnError
from ..finals.resolve import ResolvedShot, resolve_shot
from ..finals.settings import RenderSettings
from ..finals.surroundings import Surroundings
from ..finals.targets import Targets
from ..normals.predict import DEFAULT_GRIDS
from ..normals.temporal.steady import Beside
from ..pipeline import Pipeline, PipelineOptions
from ..shot import ShotFrame, by_drawing
from ..surface import save_mesh
from .console import EXIT_FAILED, print_error, progress_bar
from .options import (
    FramesOption,
    GridsOption,
    InkOption,
    InputsArgument,
    MaskOption,
    Solver,
    SolverOption,
    SteadyOption,
    check_suffix,
    keep_inputs,
    open_cache,
)

Each = tuple[list[ShotFrame], Drawing, Beside | None]


def normals(
    inputs: InputsArgument,
    output: Annotated[
        str,
        typer.Option("-o", "--output", help="A .png or .npy file, pattern (n.%04d.npy) or folder."),
    ],
    frames: FramesOption = None,
    grids: GridsOption = DEFAULT_GRIDS,
    steady: SteadyOption = True,
    mask: MaskOption = None,
    ink: InkOption = None,
) -> None:
    """Predict the normal maps of drawings.

    .npy holds (H, W, 3) float32, x right, y up, z to the viewer, unit in the mask, 0 outside;
    .png the same from -1..1 to 0..255, transparent outside.

    Example: lampblack normals hero.png -o hero.normals.png
    """
    opened, targets = _open(inputs, output, ("png", "npy"), frames, steady, mask, ink)
    with Pipeline(open_cache(), PipelineOptions(grids=grids)) as pipeline:
        for shown, drawing, beside in _each(opened, pipeline, "Predicting"):
            found = pipeline.normals(drawing, beside=beside)
            for frame in shown:
                if targets.kind == "npy":
                    with atomic_file(targets.path(frame)) as file:
                        np.save(file, found, allow_pickle=False)
                else:
                    colours = np.round((found * 0.5 + 0.5) * 255) * drawing.mask[..., None]
                    picture = np.dstack([colours, drawing.mask * 255]).astype(np.uint8)
                    save_picture(targets.path(frame), picture)


def mesh(
    inputs: InputsArgument,
    output: Annotated[
        str,
        typer.Option(
            "-o", "--output", help="A .glb, .obj or .ply file, pattern (m.%04d.glb) or folder."
        ),
    ],
    frames: FramesOption = None,
    solver: SolverOption = Solver.DIRECT,
    grids: GridsOption = DEFAULT_GRIDS,
    stride: Annotated[int, typer.Option(min=1, max=64, help="Pixels between two vertices.")] = 1,
    relief_scale: Annotated[
        float, typer.Option(min=0.01, max=10, help="Depth, 1 as predicted.")
    ] = 1.0,
    steady: SteadyOption = True,
    mask: MaskOption = None,
    ink: InkOption = None,
) -> None:
    """Inflate drawings into closed relief meshes, in pixels, y up, z to the viewer.

    Example: lampblack mesh hero.png -o hero.glb
    """
    opened, targets = _open(inputs, output, ("glb", "obj", "ply"), frames, steady, mask, ink)
    with Pipeline(open_cache(), PipelineOptions(grids, solver.value)) as pipeline:
        for shown, drawing, beside in _each(opened, pipeline, "Inflating"):
            relief = pipeline.relief(
                drawing, relief_scale=relief_scale, stride=stride, beside=beside
            )
            for frame in shown:
                save_mesh(relief, targets.path(frame))


def _open(
    inputs: list[str],
    output: str,
    kinds: tuple[str, ...],
    frames: str | None,
    steady: bool,
    mask: Path | None,
    ink: Path | None,
) -> tuple[ResolvedShot, Targets]:
    path = Path(output)
    if path.suffix and not path.is_dir():
        check_suffix(path, *(f".{kind}" for kind in kinds))
    own = [path for path in (mask, ink) if path is not None]
    keep_inputs(path, [*map(Path, inputs), *own])
    mask_path, ink_path = (None if path is None else str(path) for path in (mask, ink))
    opened = resolve_shot(
        RenderSettings(
            inputs=tuple(inputs),
            output=output,
            frames=frames,
            mask=mask_path,
            ink=ink_path,
            steady=steady,
        )
    )
    targets = Targets(output, kinds=kinds)
    targets.prepare(opened.frames, [*opened.sources, *own])
    return opened, targets


def _each(opened: ResolvedShot, pipeline: Pipeline, doing: str) -> Iterator[Each]:
    """Each drawing with the frames that show it and what is beside it; others are told."""
    failed = False
    surroundings = Surroundings(opened.shot, pipeline, opened.reach)
    with progress_bar() as bar:
        for shown in bar.track(by_drawing(opened.frames), description=doing):
            name = shown[0].name
            try:
                drawing = surroundings.drawing(shown[0])
            except DrawingError as error:
                if opened.single:
                    raise
                if isinstance(error, NothingDrawnError):
                    warnings.warn(f"{name}: {error.what}", LampblackWarning, stacklevel=2)
                    continue
                print_error(error, f"{name}: ")
                failed = True
                continue
            yield shown, drawing, surroundings.beside(shown[0])
    if failed:
        raise typer.Exit(EXIT_FAILED)
