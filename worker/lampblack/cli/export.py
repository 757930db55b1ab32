"""``lampblack export``: a frame's scene for other programs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..finals.one_frame import first_frame
from ..finals.resolve import resolve_shot
from ..finals.scene_file import SUFFIXES, save_scene
from ..finals.settings import RenderSettings
from ..pipeline import Pipeline
from .options import (
    BackgroundOption,
    CameraOption,
    CharacterOption,
    InkOption,
    LineOption,
    MaskOption,
    QualityOption,
    SceneOption,
    SteadyOption,
    check_suffix,
    keep_inputs,
    layer_roles,
    open_cache,
)


def export(
    drawing: Annotated[Path, typer.Argument(metavar="INPUT", help="A PNG, folder, .pclx or .ora.")],
    output: Annotated[Path, typer.Option("-o", "--output", help="A .blend or .glb file.")],
    frame: Annotated[
        int | None, typer.Option("--frame", min=0, help="Its number. Default: the first.")
    ] = None,
    scene: SceneOption = None,
    quality: QualityOption = None,
    character: CharacterOption = None,
    line: LineOption = None,
    background: BackgroundOption = None,
    camera: CameraOption = None,
    steady: SteadyOption = True,
    mask: MaskOption = None,
    ink: InkOption = None,
) -> None:
    """Write a frame's relief, lights, floor and camera, to go on with in Blender.

    A .glb holds the relief in its drawing's colours. Quality says how fine the relief is.

    Example: lampblack export walk.pclx --frame 12 -o walk.0012.blend
    """
    check_suffix(output, *SUFFIXES)
    keep_inputs(output, [drawing])
    settings = RenderSettings(
        inputs=(str(drawing),),
        output="",
        scene=None if scene is None else str(scene),
        quality=None if quality is None else quality.value,
        frames=None if frame is None else str(frame),
        mask=None if mask is None else str(mask),
        ink=None if ink is None else str(ink),
        roles=layer_roles(character, line, background),
        camera=camera,
        steady=steady,
    )
    with Pipeline(open_cache()) as pipeline:
        staged = first_frame(resolve_shot(settings), pipeline)
        save_scene(pipeline, staged.drawing, staged.scene, output, staged.beside)
