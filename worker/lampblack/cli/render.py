"""``lampblack render``: drawings in, lit drawings out."""

from __future__ import annotations

import warnings
from collections import Counter
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from numpy.typing import NDArray

from ..cache import digest
from ..drawing import (
    Frame,
    find_frames,
    load_picture,
    parse_frames,
    save_picture,
    select_frames,
    take_apart,
)
from ..drawing.contact_sheet import contact_sheet
from ..errors import LampblackError, LampblackWarning, NothingDrawnError, OutputError
from ..normals.predict import DEFAULT_GRIDS
from ..pipeline import Pipeline, PipelineOptions
from ..scene import Canvas, Scene, default_scene
from .console import EXIT_FAILED, EXIT_UNLIT, console, print_error, progress_bar
from .options import (
    GridsOption,
    InkOption,
    MaskOption,
    QualityName,
    Solver,
    SolverOption,
    check_suffix,
    floor_at,
    keep_inputs,
    lights_at,
    open_cache,
    read_scene,
)


def render(
    inputs: Annotated[
        list[str], typer.Argument(metavar="INPUT", help="PNG, folder, or walk.%04d.png.")
    ],
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Output folder.")],
    scene: Annotated[Path | None, typer.Option("--scene", help="Scene file.")] = None,
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
    quality: Annotated[
        QualityName | None, typer.Option("--quality", help="Default: the scene's, or low.")
    ] = None,
    frames: Annotated[
        str | None, typer.Option("--frames", help="Frame numbers, such as 1-20x2,25.")
    ] = None,
    sheet: Annotated[
        Path | None,
        typer.Option("--contact-sheet", metavar="PNG", help="Drawings above, lit below."),
    ] = None,
    mask: MaskOption = None,
    ink: InkOption = None,
    grids: GridsOption = DEFAULT_GRIDS,
    solver: SolverOption = Solver.DIRECT,
) -> None:
    """Light drawings; each becomes a PNG of its own name and size in DIR.

    Exit code 1: a frame failed (the others are there). 3: a blank frame was passed through
    unlit.

    Example: lampblack render walk/ -o lit/ --light 250,150,400 --quality final
    """
    found = find_frames(inputs)
    if frames is not None:
        found = select_frames(found, parse_frames(frames))
    _prepare_output(output, found)
    if sheet is not None:
        check_suffix(sheet, ".png")
        keep_inputs(sheet, [frame.path for frame in found])
    read = None if scene is None else read_scene(scene)
    # What is mistyped is told before any work.
    lights_at(light or [], Canvas(1, 1))
    hinge = None if floor is None else floor_at(floor)

    def stage(width: int, height: int) -> Scene:
        """The scene for a drawing of this size: the file's or the default, with the options."""
        staged = read or default_scene(width, height)
        if light:
            staged = replace(staged, lights=lights_at(light, Canvas(width, height)))
        if hinge is not None:
            staged = replace(staged, floor=hinge)
        return staged if quality is None else replace(staged, quality=quality.value)

    with Pipeline(open_cache(), PipelineOptions(grids, solver.value)) as pipeline:
        job = _Job(pipeline, output, len(found) == 1, {})
        job.mask = None if mask is None else load_picture(mask)
        job.ink = None if ink is None else load_picture(ink)
        with progress_bar() as bar:
            task = bar.add_task("Lighting", total=len(found))
            for frame in found:
                try:
                    picture = load_picture(frame.path)
                    job.light(frame, picture, stage(picture.shape[1], picture.shape[0]))
                    job.done.append(frame)
                except LampblackError as error:
                    print_error(error, f"{frame.path.name}: ")
                    job.failed.append(frame)
                    if isinstance(error, OutputError):
                        break  # no later frame could be written either
                bar.advance(task)
    if sheet is not None:
        _write_sheet(sheet, job.done, output)
    _summarise(job, len(found))


@dataclass
class _Job:
    """What the frames of one call share; ``lit`` maps a drawing's digest to its result."""

    pipeline: Pipeline
    output: Path
    single: bool
    lit: dict[str, Path]
    mask: NDArray[np.uint8] | None = None
    ink: NDArray[np.uint8] | None = None
    canvas: Canvas | None = None
    unlit: int = 0
    done: list[Frame] = field(default_factory=list)
    failed: list[Frame] = field(default_factory=list)

    def light(self, frame: Frame, picture: NDArray[np.uint8], scene: Scene) -> None:
        """Light one frame and write it; a drawing met before is only copied."""
        target = self.output / frame.path.name
        height, width = picture.shape[:2]
        canvas = Canvas(width, height)
        if self.canvas is None:
            self.canvas = scene.canvas
        if canvas != self.canvas:
            warnings.warn(
                f"{frame.path.name} is {width} x {height} pixels, not {self.canvas.width} x "
                f"{self.canvas.height} like the scene or the first frame.",
                LampblackWarning,
                stacklevel=2,
            )
        scene = replace(scene, canvas=canvas)
        key = digest(picture, scene)
        earlier = self.lit.get(key)
        if earlier is not None:
            save_picture(target, load_picture(earlier))
            return
        try:
            drawing = take_apart(picture, mask=self.mask, ink=self.ink)
        except NothingDrawnError as error:
            if self.single:
                raise
            warnings.warn(
                f"{frame.path.name}: {error.what} Passed through unlit.",
                LampblackWarning,
                stacklevel=2,
            )
            save_picture(target, picture)
            self.unlit += 1
            return
        save_picture(target, self.pipeline.render(drawing, scene))
        self.lit[key] = target


def _prepare_output(output: Path, frames: list[Frame]) -> None:
    """Refuse, before any work, an output folder that would lose something."""
    twice = [name for name, n in Counter(f.path.name for f in frames).items() if n > 1]
    if twice:
        raise LampblackError(
            f"Two inputs are named {twice[0]}: one result would replace the other.",
            "Render them into different folders.",
        )
    try:
        output.mkdir(parents=True, exist_ok=True)
        folder = output.resolve()
    except OSError as error:
        raise LampblackError(
            f"The output folder {output} cannot be made.", "Choose another.", str(error)
        ) from error
    if any(frame.path.resolve().parent == folder for frame in frames):
        raise LampblackError(
            f"{output} holds the drawings themselves; they would be replaced.",
            "Choose another output folder.",
        )


def _write_sheet(path: Path, frames: list[Frame], output: Path) -> None:
    """Drawings above, lit below: at most 12 of them, evenly chosen. One stands beside its own."""
    if not frames:
        return
    if len(frames) == 1:
        pair = [load_picture(frames[0].path), load_picture(output / frames[0].path.name)]
        save_picture(path, contact_sheet([pair], cell=560))
        return
    chosen = [frames[i] for i in np.unique(np.linspace(0, len(frames) - 1, 12).round().astype(int))]
    drawn = [load_picture(frame.path) for frame in chosen]
    lit = [load_picture(output / frame.path.name) for frame in chosen]
    rows = range(0, len(chosen), 6)
    save_picture(path, contact_sheet([r[i : i + 6] for i in rows for r in (drawn, lit)]))


def _summarise(job: _Job, total: int) -> None:
    console.print(f"{len(job.done)} of {total} frames are in {job.output}.", markup=False)
    if job.failed:
        names = ", ".join(frame.path.name for frame in job.failed)
        console.print(f"Failed: {names}", markup=False, style="bold red")
        raise typer.Exit(EXIT_FAILED)
    if job.unlit:
        raise typer.Exit(EXIT_UNLIT)
