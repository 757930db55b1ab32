"""``lampblack serve``: the live worker."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

from ..choices import DeviceChoice


def serve(
    connection: Annotated[
        Path,
        typer.Option(
            "--connection",
            metavar="FILE",
            help="File to write the address and key to, once ready; see SPEC.md.",
        ),
    ],
    parent_pid: Annotated[
        int | None,
        typer.Option(
            "--parent-pid", metavar="PID", min=1, help="Process to end with: the drawing program."
        ),
    ] = None,
    device: Annotated[
        DeviceChoice,
        typer.Option(
            "--device",
            help="What traces the light. auto is a graphics card on which a test picture came out "
            "right, else the processor.",
        ),
    ] = "auto",
) -> None:
    """Serve a drawing program with previews and renders.

    It shows a preview while a light is dragged, and renders frames into files.

    Example: lampblack serve --connection /run/user/1000/lampblack.json --parent-pid $$
    """
    from ..service.serve import serve_forever

    # The drawing program has priority when both need a processor.
    os.nice(5)
    serve_forever(connection, parent_pid, device)
    # The drawing program has ended. An interpreter would wait for what its threads compute.
    os._exit(0)
