"""``lampblack serve``: the live worker."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer


def serve(
    connection: Annotated[
        Path, typer.Option("--connection", metavar="FILE", help="Written when ready; see SPEC.md.")
    ],
    parent_pid: Annotated[
        int | None, typer.Option("--parent-pid", min=1, help="Leave when this process is gone.")
    ] = None,
) -> None:
    """Serve a drawing program: previews that follow the artist's hand, and render jobs.

    Example: lampblack serve --connection /run/user/1000/lampblack.json --parent-pid $$
    """
    from ..service.serve import serve_forever

    # The drawing program's own thread goes first where both want a processor.
    os.nice(5)
    serve_forever(connection, parent_pid)
