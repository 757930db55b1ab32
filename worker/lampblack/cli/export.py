"""``lampblack export``: a frame's scene for other programs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..finals.settings import RenderSettings
from .options import with_settings
from .outputs import check_suffix, keep_inputs


@with_settings(
    *("input", "frame", "scene", "quality", "character", "line", "background", "camera"),
    *("layer_body", "steady", "mask", "ink"),
)
def export(
    settings: RenderSettings,
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="FILE", help="The .blend or .glb to write.")
    ],
) -> None:
    """Write one frame as a 3D scene for other programs.

    A .glb holds the relief in the drawing's colours; a .blend also the lights, floor and camera.
    --quality sets how fine the relief is.

    Example: lampblack export walk.pclx --frame 12 -o walk.0012.blend
    """
    from ..cache import surface_cache
    from ..finals.one_frame import first_frame
    from ..finals.resolve import resolve_shot
    from ..finals.scene_file import SUFFIXES, save_scene
    from ..pipeline import Pipeline

    check_suffix(output, *SUFFIXES)
    keep_inputs(output, settings.inputs)
    with Pipeline(surface_cache()) as pipeline:
        shown = first_frame(resolve_shot(settings), pipeline)
        save_scene(shown.drawing, shown.prepare(pipeline), shown.scene, output)
