"""``lampblack serve``: the live worker."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

from ..choices import DeviceChoice
from ..errors import LampblackError
from .console import EXIT_FAILED


def serve(
    connection: Annotated[
        Path | None,
        typer.Option(
            "--connection",
            metavar="FILE",
            help="File to write the address to, once ready; see SPEC.md.",
        ),
    ] = None,
    listen: Annotated[
        str | None,
        typer.Option(
            "--listen",
            metavar="HOST:PORT",
            help="Serve other machines on this address, encrypted; with --key and --admit.",
        ),
    ] = None,
    key: Annotated[
        Path | None,
        typer.Option("--key", metavar="FILE", help="Secret key of this machine (.key_secret)."),
    ] = None,
    admit: Annotated[
        Path | None,
        typer.Option(
            "--admit", metavar="FOLDER", help="Public keys (.key) of all who may connect."
        ),
    ] = None,
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
    network = (listen, key, admit)
    if not ((all(network) and connection is None) or (connection is not None and not any(network))):
        raise LampblackError(
            "It is not clear whom to serve.",
            "Give --connection for a program on this machine; or --listen, --key and --admit for "
            "other machines.",
        )

    # The drawing program has priority when both need a processor.
    if hasattr(os, "nice"):
        os.nice(5)
    from ..render.client import RenderChild

    status = 0
    try:
        # The renderer loads while this process loads everything else.
        with RenderChild(device=device) as renderer:
            from ..service.serve import Listening, serve_forever

            where: Path | Listening | None = connection
            if listen is not None and key is not None and admit is not None:
                where = Listening(listen, key, admit)
            assert where is not None
            serve_forever(where, renderer, parent_pid, device)
    except SystemExit as told:  # by a signal
        status = told.code if isinstance(told.code, int) else EXIT_FAILED
    # An interpreter would wait for what its threads compute, or be ended by what they still load.
    os._exit(status)
