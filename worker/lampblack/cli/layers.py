"""``lampblack layers``: what a drawing shows, for a program that cannot read it."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from ..finals.settings import RenderSettings
from .options import with_settings


@with_settings("input")
def layers(
    settings: RenderSettings,
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="DIR", help="Folder for the pictures.")
    ],
    first: Annotated[
        int, typer.Option("--first", metavar="N", min=0, help="Number of the frame to begin with.")
    ] = 0,
) -> None:
    """Write the layers of each frame as PNG files.

    Each line that is printed is JSON: first the canvas and the layers, then every frame with its
    files. A picture that several frames show is written once. Pictures that are in the folder from
    an earlier call are kept, or removed if they are shown no longer.

    Example: lampblack layers walk.pclx -o layers/
    """
    import msgspec

    from ..atomic import make_folder
    from ..errors import LampblackError
    from ..finals.layer_files import as_record, open_layers, write_layers

    def tell(record: object) -> None:
        sys.stdout.write(msgspec.json.encode(record).decode() + "\n")
        sys.stdout.flush()

    try:
        make_folder(output)
        for record in write_layers(open_layers(settings.inputs[0]), output, first):
            tell(record)
    except LampblackError as error:
        tell({"error": as_record(error)})
        raise
