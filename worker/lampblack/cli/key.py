"""``lampblack key``: keys for a worker on another machine."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def key(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Whose key: a person or a machine.")],
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="FOLDER", help="Where to write the keys.")
    ] = Path(),
) -> None:
    """Make a pair of keys, for a worker that serves other machines.

    The worker listens with `lampblack serve --listen`. NAME.key is public: give it to the other
    side. NAME.key_secret stays on this machine.

    Example: lampblack key ana -o keys
    """
    from ..service.keys import make_keys

    public, secret = make_keys(output, name)
    typer.echo(f"{public}: give it to the other side.")
    typer.echo(f"{secret}: keep it secret.")
