"""``lampblack job``: a job template for a render farm."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import Annotated

import msgspec
import typer

from ..atomic import atomic_file
from ..finals.settings import RenderSettings
from .console import say
from .options import with_settings
from .outputs import check_suffix


@with_settings(
    *("input", "scene", "quality", "sheet", "frames", "format", "apart", "character", "line"),
    *("background", "layer_body", "camera", "steady", "mask", "ink", "device"),
)
def job(
    settings: RenderSettings,
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="YAML", help="Job template to write.")
    ],
    to: Annotated[
        str | None,
        typer.Option(
            "--to",
            metavar="DIR|PATTERN",
            help="Folder for the lit frames, or pattern for their names. Default: lit/ beside the "
            "input.",
        ),
    ] = None,
    frames_per_task: Annotated[
        int,
        typer.Option(
            metavar="N",
            min=1,
            max=10_000,
            help="Fewest frames in a task; frames of one drawing stay in one task.",
        ),
    ] = 8,
) -> None:
    """Write an OpenJD job template that lights a shot.

    Its tasks are lampblack render commands, which may run anywhere and more than once. All trace on
    one kind of device: the processor, unless --device names another. Write the
    template beside the project: paths outside its folder must be given when the job is submitted.

    Example: lampblack job walk.pclx -o job.yaml --to /shots/walk.%04d.exr --quality final
    """
    from ..farm.tasks import cut_into_tasks
    from ..farm.template import job_template, paths_outside, write_yaml
    from ..finals.resolve import resolve_shot, scene_file

    check_suffix(output, ".yaml", ".yml")
    lit = to or str(Path(settings.inputs[0]).parent / "lit")
    scene = scene_file(settings)
    named = {"output": lit, "scene": None if scene is None else str(scene)}
    settings = msgspec.structs.replace(settings, **named).absolute()
    frames = resolve_shot(settings).frames
    tasks = cut_into_tasks(frames, frames_per_task)
    folder = output.absolute().parent
    text = write_yaml(job_template(settings, tasks, folder))
    with atomic_file(output) as file:
        file.write(text)
    say(f"{len(frames)} frames in {len(tasks)} tasks: {output}")
    words = ["openjd", "run", str(output), "--step", "Light"]
    for name, path in paths_outside(settings, folder).items():
        words += ["-p", f"{name}={path}"]
    say(f"Try it here: {shlex.join(words)}")
