"""``lampblack turntable``: the relief seen from the sides."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..atomic import make_folder
from ..finals.settings import RenderSettings
from .console import progress_bar
from .options import with_settings
from .outputs import check_suffix, keep_inputs


@with_settings(
    "input", "frame", "scene", "character", "line", "layer_body", "steady", "mask", "ink"
)
def turntable(
    settings: RenderSettings,
    output: Annotated[
        Path,
        typer.Option(
            "-o", "--output", metavar="GIF|DIR", help="A .gif file, or a folder for PNG files."
        ),
    ],
    pictures: Annotated[
        int, typer.Option(metavar="N", min=4, max=360, help="Number of pictures in the loop.")
    ] = 32,
    size: Annotated[
        int,
        typer.Option(
            metavar="PIXELS", min=64, max=1024, help="Longest side of each half of a picture."
        ),
    ] = 400,
) -> None:
    """Show a drawing's relief from the sides.

    It swings to the left and to the right, shown twice: as clay, and lit.

    Example: lampblack turntable hero.png -o hero.gif
    """
    import numpy as np

    from ..cache import surface_cache
    from ..drawing import save_picture
    from ..finals.gif import save_gif
    from ..finals.one_frame import first_frame
    from ..finals.resolve import resolve_shot
    from ..finals.turntable import turn_table
    from ..pipeline import Pipeline

    animated = bool(output.suffix) and not output.is_dir()
    if animated:
        check_suffix(output, ".gif")
    keep_inputs(output, settings.inputs)
    shot = resolve_shot(settings)
    with Pipeline(surface_cache(), device=settings.device) as pipeline, progress_bar() as bar:
        pipeline.renderer.start()
        shown = first_frame(shot, pipeline)
        prepared = shown.prepare(pipeline)
        turned = turn_table(pipeline, shown.drawing, prepared, shown.scene, pictures, size)
        loop = list(bar.track(turned, total=pictures, description="Turning"))
    if animated:
        save_gif(output, loop)
        return
    make_folder(output)
    for number, picture in enumerate(loop, start=1):
        opaque = np.full((*picture.shape[:2], 1), 255, np.uint8)
        name = f"{Path(shown.frame.name).stem}.turn.{number:04d}.png"
        save_picture(output / name, np.concatenate([picture, opaque], axis=2))
