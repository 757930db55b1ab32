"""``lampblack palette`` and ``scene``: flat colours, and a scene file to start from."""

from __future__ import annotations

import sys
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..finals.settings import RenderSettings
from .drawings import each_drawing
from .options import with_settings
from .outputs import check_suffix

if TYPE_CHECKING:
    from ..finals.resolve import ResolvedShot


@with_settings("inputs", "mask", "ink")
def palette(
    settings: RenderSettings,
    as_json: Annotated[bool, typer.Option("--json", help="Print the list as JSON.")] = False,
) -> None:
    """List the flat colours of drawings.

    The colour with the most pixels comes first.

    Example: lampblack palette walk/
    """
    import msgspec
    from rich.console import Console
    from rich.table import Table

    from ..finals.resolve import resolve_shot

    counts = _count_colours(resolve_shot(settings))
    if as_json:
        rows = [{"colour": colour, "pixels": pixels} for colour, pixels in counts]
        sys.stdout.write(msgspec.json.encode(rows).decode() + "\n")
        return
    table = Table("colour", "", "pixels")
    for colour, pixels in counts:
        table.add_row(colour, f"[on {colour}]    [/]", str(pixels))
    Console().print(table)


@with_settings("inputs", "mask", "ink")
def scene(
    settings: RenderSettings,
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="JSON", help="Scene file to write.")
    ],
) -> None:
    """Write a scene file to start from.

    It holds one light, and a material for each flat colour of the drawings.

    Example: lampblack scene walk/ -o walk.json
    """
    from dataclasses import replace

    from ..atomic import atomic_file
    from ..finals.resolve import resolve_shot
    from ..scene import Canvas, Material, default_scene, encode_scene

    check_suffix(output, ".json")
    shot = resolve_shot(settings)
    canvas = shot.shot.canvas
    if canvas is None:
        height, width = shot.shot.cel(shot.frames[0]).pixels.shape[:2]
        canvas = Canvas(width, height)
    start = default_scene(canvas.width, canvas.height)
    materials = {colour: Material() for colour, _ in _count_colours(shot)}
    with atomic_file(output) as file:
        file.write(encode_scene(replace(start, materials=materials)))


def _count_colours(shot: ResolvedShot) -> list[tuple[str, int]]:
    """Flat colours and their numbers of pixels over all frames, most used first."""
    from ..shot import by_drawing

    counts: Counter[str] = Counter()
    for frames, drawing in each_drawing(shot, by_drawing(shot.frames), "Reading"):
        for swatch in drawing.palette.swatches:
            counts[swatch.colour] += swatch.pixels * len(frames)
    return counts.most_common()
