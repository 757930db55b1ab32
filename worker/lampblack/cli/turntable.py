"""``lampblack turntable``: a quick look at the relief from the sides."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from numpy.typing import NDArray
from PIL import Image

from ..atomic import atomic_file
from ..drawing import save_picture
from ..errors import LampblackError
from ..finals.one_frame import first_frame
from ..finals.resolve import resolve_shot
from ..finals.settings import RenderSettings
from ..finals.turntable import turn_table
from ..pipeline import Pipeline
from .console import progress_bar
from .options import (
    CharacterOption,
    InkOption,
    LineOption,
    MaskOption,
    SceneOption,
    SteadyOption,
    keep_inputs,
    layer_roles,
    open_cache,
)

LOOP_SECONDS = 2.6


def turntable(
    drawing: Annotated[Path, typer.Argument(metavar="INPUT", help="A PNG, folder, .pclx or .ora.")],
    output: Annotated[Path, typer.Option("-o", "--output", help="A .gif file, or a folder.")],
    frame: Annotated[
        int | None, typer.Option("--frame", min=0, help="Its number. Default: the first.")
    ] = None,
    scene: SceneOption = None,
    pictures: Annotated[int, typer.Option(min=4, max=360, help="Of the loop.")] = 32,
    size: Annotated[int, typer.Option(min=64, max=1024, help="Of each half, pixels.")] = 400,
    steady: SteadyOption = True,
    character: CharacterOption = None,
    line: LineOption = None,
    mask: MaskOption = None,
    ink: InkOption = None,
) -> None:
    """Look at a drawing's relief from the sides: it swings, as clay and as it is lit.

    Example: lampblack turntable hero.png -o hero.gif
    """
    animated = output.suffix.lower() == ".gif" and not output.is_dir()
    if output.suffix and not animated and not output.is_dir():
        raise LampblackError(f"{output} is of no kind that can be written here.", "Known: .gif.")
    keep_inputs(output, [drawing])
    settings = RenderSettings(
        inputs=(str(drawing),),
        output="",
        scene=None if scene is None else str(scene),
        frames=None if frame is None else str(frame),
        mask=None if mask is None else str(mask),
        ink=None if ink is None else str(ink),
        roles=layer_roles(character, line, None),
        steady=steady,
    )
    opened = resolve_shot(settings)
    with Pipeline(open_cache()) as pipeline, progress_bar() as bar:
        pipeline.child.start()
        staged = first_frame(opened, pipeline)
        turned = turn_table(pipeline, staged.drawing, staged.scene, pictures, size, staged.beside)
        loop = list(bar.track(turned, total=pictures, description="Turning"))
    if animated:
        _save_gif(output, loop)
        return
    try:
        output.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise LampblackError(
            f"The folder {output} cannot be made.", "Choose another.", str(error)
        ) from error
    for number, picture in enumerate(loop, start=1):
        opaque = np.full((*picture.shape[:2], 1), 255, np.uint8)
        name = f"{Path(staged.frame.name).stem}.turn.{number:04d}.png"
        save_picture(output / name, np.concatenate([picture, opaque], axis=2))


def _save_gif(path: Path, loop: list[NDArray[np.uint8]]) -> None:
    """With one palette for all, from the ends and the middle of the swing, lest colours jump."""
    shown = [loop[index * len(loop) // 4] for index in (0, 1, 3)]
    palette = Image.fromarray(np.concatenate(shown)).quantize(256, Image.Quantize.MEDIANCUT)
    frames = [
        Image.fromarray(picture).quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG)
        for picture in loop
    ]
    with atomic_file(path) as file:
        frames[0].save(
            file,
            "GIF",
            save_all=True,
            append_images=frames[1:],
            duration=round(1000 * LOOP_SECONDS / len(loop)),
            loop=0,
        )
