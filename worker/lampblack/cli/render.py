"""``lampblack render``: drawings or a project in, lit frames out."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from numpy.typing import NDArray

from ..drawing import load_picture, save_picture
from ..drawing.contact_sheet import contact_sheet
from ..errors import LampblackError
from ..finals.light import Outcome, light_frames
from ..finals.resolve import ResolvedJob, resolve_job
from ..finals.settings import RenderSettings
from ..normals.predict import DEFAULT_GRIDS
from ..pipeline import Pipeline
from ..shot import ShotFrame
from .console import EXIT_FAILED, EXIT_UNLIT, console, print_error, progress_bar
from .options import (
    BackgroundOption,
    CameraOption,
    CharacterOption,
    FormatOption,
    FramesOption,
    GridsOption,
    InkOption,
    InputsArgument,
    LineOption,
    MaskOption,
    QualityOption,
    SceneOption,
    Solver,
    SolverOption,
    SteadyOption,
    check_suffix,
    keep_inputs,
    layer_roles,
    open_cache,
)


def render(
    inputs: InputsArgument,
    output: Annotated[
        str,
        typer.Option("-o", "--output", metavar="DIR|PATTERN", help="Folder, or lit.%04d.exr."),
    ],
    scene: SceneOption = None,
    light: Annotated[
        list[str] | None,
        typer.Option(
            "--light",
            metavar="X,Y,Z",
            help="A white light, canvas pixels, instead of the scene's; up to 4 times.",
        ),
    ] = None,
    floor: Annotated[
        float | None, typer.Option("--floor", metavar="Y", help="Shadow catcher at this line.")
    ] = None,
    quality: QualityOption = None,
    frames: FramesOption = None,
    format: FormatOption = None,
    sheet: Annotated[
        Path | None,
        typer.Option("--contact-sheet", metavar="PNG", help="Drawings above, lit below."),
    ] = None,
    character: CharacterOption = None,
    line: LineOption = None,
    background: BackgroundOption = None,
    camera: CameraOption = None,
    steady: SteadyOption = True,
    mask: MaskOption = None,
    ink: InkOption = None,
    grids: GridsOption = DEFAULT_GRIDS,
    solver: SolverOption = Solver.DIRECT,
    again: Annotated[
        bool, typer.Option("--again", help="Make also frames that are there and up to date.")
    ] = False,
    allow_blank: Annotated[
        bool, typer.Option("--allow-blank", help="Exit 0 though blank frames stayed unlit.")
    ] = False,
    cluster: Annotated[
        str | None,
        typer.Option("--cluster", metavar="ADDRESS", help="Of a dask scheduler: tls://host:8786."),
    ] = None,
    tls_ca: Annotated[
        Path | None, typer.Option("--tls-ca", help="The cluster's authority, a PEM file.")
    ] = None,
    tls_cert: Annotated[
        Path | None, typer.Option("--tls-cert", help="Our certificate, a PEM file.")
    ] = None,
    tls_key: Annotated[
        Path | None, typer.Option("--tls-key", help="Its private key, a PEM file.")
    ] = None,
) -> None:
    """Light drawings, or the frames of a Pencil2D project.

    Frames that are there and up to date are left alone: run it again to go on after an
    interruption. Exit code 1: a frame failed (the others are there). 3: a blank frame was
    passed through unlit.

    Example: lampblack render walk/ -o lit/ --light 250,150,400 --quality final
    """
    settings = RenderSettings(
        inputs=tuple(inputs),
        output=output,
        scene=None if scene is None else str(scene),
        lights=tuple(light or ()),
        floor=floor,
        quality=None if quality is None else quality.value,
        frames=frames,
        format=None if format is None else format.value,
        mask=None if mask is None else str(mask),
        ink=None if ink is None else str(ink),
        grids=grids,
        solver=solver.value,
        roles=layer_roles(character, line, background),
        camera=camera,
        steady=steady,
        again=again,
    )
    opened = resolve_job(settings)
    if sheet is not None:
        _check_sheet(sheet, opened, inputs)
    with progress_bar() as bar:
        task = bar.add_task("Lighting", total=len(opened.frames))

        def told(frame: ShotFrame, error: LampblackError | None) -> None:
            bar.advance(task)
            if error is not None:
                print_error(error, f"{frame.name}: ")

        if cluster is not None:
            from ..farm.cluster import Certificates, light_on_cluster

            files = (None if file is None else str(file) for file in (tls_ca, tls_cert, tls_key))
            outcome = light_on_cluster(settings, opened, cluster, Certificates(*files), told)
        else:
            with Pipeline(open_cache(), opened.options) as pipeline:
                outcome = light_frames(opened, pipeline, listener=told)
    if sheet is not None:
        _write_sheet(sheet, opened, outcome)
    _summarise(opened, outcome)
    if outcome.failed:
        raise typer.Exit(EXIT_FAILED)
    if outcome.unlit and not allow_blank:
        raise typer.Exit(EXIT_UNLIT)


def _check_sheet(sheet: Path, opened: ResolvedJob, inputs: list[str]) -> None:
    check_suffix(sheet, ".png")
    sources = [Path(item) for item in inputs]
    pictures = [path for item in sources if item.is_dir() for path in item.glob("*.png")]
    keep_inputs(sheet, [*sources, *pictures])
    if opened.targets.kind != "png":
        raise LampblackError("A contact sheet shows PNG frames only.", "Leave out --contact-sheet.")


def _write_sheet(path: Path, opened: ResolvedJob, outcome: Outcome) -> None:
    """Drawings above, lit below: at most 12 of them, evenly chosen. One stands beside its own."""
    done = set(outcome.done)
    frames = [frame for frame in opened.frames if frame in done]
    if not frames:
        return

    def drawn(frame: ShotFrame) -> NDArray[np.uint8]:
        return opened.shot.finish(frame, opened.shot.cel(frame).pixels)

    def lit(frame: ShotFrame) -> NDArray[np.uint8]:
        return load_picture(opened.targets.path(frame))

    if len(frames) == 1:
        save_picture(path, contact_sheet([[drawn(frames[0]), lit(frames[0])]], cell=560))
        return
    chosen = [frames[i] for i in np.unique(np.linspace(0, len(frames) - 1, 12).round().astype(int))]
    rows = [chosen[i : i + 6] for i in range(0, len(chosen), 6)]
    save_picture(
        path, contact_sheet([[make(f) for f in row] for row in rows for make in (drawn, lit)])
    )


def _summarise(opened: ResolvedJob, outcome: Outcome) -> None:
    there = f", {len(outcome.kept)} of them from before" if outcome.kept else ""
    console.print(
        f"{len(outcome.done)} of {len(opened.frames)} frames are in "
        f"{opened.targets.folder.absolute()}{there}.",
        markup=False,
    )
    if outcome.failed:
        names = ", ".join(frame.name for frame, _ in outcome.failed)
        console.print(f"Failed: {names}", markup=False, style="bold red")
