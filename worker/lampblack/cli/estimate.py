"""``lampblack estimate``: what a shot will cost, before it is rendered."""

from __future__ import annotations

import dataclasses
import sys
from datetime import timedelta
from typing import Annotated

import typer

from ..finals.settings import RenderSettings
from .console import progress_bar
from .options import OPTIONS, with_settings


@with_settings(*(name for name in OPTIONS if name not in ("input", "frame", "output", "again")))
def estimate(
    settings: RenderSettings,
    machines: Annotated[
        int, typer.Option(min=1, max=100_000, help="Machines like this one that share the frames.")
    ] = 1,
    as_json: Annotated[bool, typer.Option("--json", help="Print the figures as JSON.")] = False,
) -> None:
    """Estimate time and disk space of a render.

    A few drawings from the middle of the shot are lit for it; nothing is written.

    Example: lampblack estimate walk/ --quality final --machines 8
    """
    import msgspec

    from ..bench.memory import peak_gib
    from ..finals.estimate import estimate as measure

    with progress_bar() as bar:
        task = bar.add_task("Lighting some drawings", total=100)
        found = measure(settings, lambda share: bar.update(task, completed=int(100 * share)))
    seconds = found.seconds(machines)
    if as_json:
        figures = dataclasses.asdict(found) | {"seconds": seconds, "memory_gib": peak_gib()}
        sys.stdout.write(msgspec.json.encode(figures).decode() + "\n")
        return
    whole = f"{found.frames} frames of {found.drawings} drawings"
    sys.stdout.write(f"{whole}: about {timedelta(seconds=round(seconds))}")
    sys.stdout.write(f" on {machines} machines.\n" if machines > 1 else ".\n")
    sys.stdout.write(f"Each further drawing: {found.drawing:.1f} s.\n")
    sys.stdout.write(
        f"Memory: {peak_gib():.1f} GiB at most. Disk: {found.disk / 2**20:,.0f} MiB.\n"
    )
