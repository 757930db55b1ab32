"""``lampblack job``: a job template for a render farm."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import Annotated

import typer

from ..atomic import atomic_file
from ..drawing.sequence import parse_frames, select_frames
from ..finals.resolve import resolve_shot
from ..finals.settings import RenderSettings
from .console import console
from .options import (
    BackgroundOption,
    CameraOption,
    CharacterOption,
    FormatOption,
    FramesOption,
    InkOption,
    LineOption,
    MaskOption,
    QualityOption,
    SceneOption,
    SteadyOption,
    check_suffix,
    layer_roles,
)


def job(
    source: Annotated[Path, typer.Argument(metavar="INPUT", help="A .pclx, folder or pattern.")],
    output: Annotated[Path, typer.Option("-o", "--output", help="A .yaml file.")],
    to: Annotated[
        Path | None,
        typer.Option("--to", metavar="DIR|PATTERN", help="Of the frames. Default: lit/."),
    ] = None,
    scene: SceneOption = None,
    quality: QualityOption = None,
    frames: FramesOption = None,
    format: FormatOption = None,
    frames_per_task: Annotated[
        int, typer.Option(min=1, max=10_000, help="Or more: held drawings stay together.")
    ] = 8,
    character: CharacterOption = None,
    line: LineOption = None,
    background: BackgroundOption = None,
    camera: CameraOption = None,
    steady: SteadyOption = True,
    mask: MaskOption = None,
    ink: InkOption = None,
) -> None:
    """Write an OpenJD job template whose tasks light the frames of a shot.

    Its tasks are lampblack render commands: run them anywhere, again at will. Write it beside
    the project: paths outside its own folder must be given when the job is submitted.

    Example: lampblack job walk.pclx -o job.yaml --to /shots/walk.%04d.exr --quality final
    """
    from ..farm.tasks import cut_into_tasks
    from ..farm.template import job_template, paths_outside, write_yaml

    check_suffix(output, ".yaml", ".yml")
    settings = RenderSettings(
        inputs=(str(source),),
        output=str(to or source.parent / "lit"),
        scene=None if scene is None else str(scene),
        quality=None if quality is None else quality.value,
        format=None if format is None else format.value,
        mask=None if mask is None else str(mask),
        ink=None if ink is None else str(ink),
        roles=layer_roles(character, line, background),
        camera=camera,
        steady=steady,
    ).absolute()
    wanted = resolve_shot(settings).frames
    if frames is not None:
        wanted = select_frames(wanted, parse_frames(frames))
    tasks = cut_into_tasks(wanted, frames_per_task)
    folder = output.absolute().parent
    text = write_yaml(job_template(settings, tasks, folder))
    with atomic_file(output) as file:
        file.write(text)
    console.print(f"{len(wanted)} frames in {len(tasks)} tasks: {output}", markup=False)
    given = [f"-p {name}={path}" for name, path in paths_outside(settings, folder).items()]
    words = shlex.join(["openjd", "run", str(output), "--step", "Light"])
    console.print(f"Try it here: {' '.join([words, *given])}", markup=False)
