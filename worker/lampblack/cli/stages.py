"""``lampblack palette`` and ``scene``: what a scene is set up from."""

from __future__ import annotations

import sys
import warnings
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import msgspec
import typer
from rich.console import Console
from rich.table import Table

from ..atomic import atomic_file
from ..drawing import take_apart
from ..errors import DrawingError, LampblackWarning, NothingDrawnError
from ..finals.resolve import ResolvedShot, resolve_shot
from ..finals.settings import RenderSettings
from ..scene import Canvas, Material, default_scene, encode_scene
from ..shot import by_drawing
from .console import progress_bar
from .options import (
    InkOption,
    InputsArgument,
    MaskOption,
    check_suffix,
)


def palette(
    inputs: InputsArgument,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    mask: MaskOption = None,
    ink: InkOption = None,
) -> None:
    """List the flat colours of drawings, most used first.

    Example: lampblack palette walk/
    """
    counts = _count_colours(_open(inputs, mask, ink))
    if as_json:
        rows = [{"colour": colour, "pixels": pixels} for colour, pixels in counts]
        sys.stdout.write(msgspec.json.encode(rows).decode() + "\n")
        return
    table = Table("colour", "", "pixels")
    for colour, pixels in counts:
        table.add_row(colour, f"[on {colour}]    [/]", str(pixels))
    Console().print(table)


def scene(
    inputs: InputsArgument,
    output: Annotated[Path, typer.Option("-o", "--output", help="A .json file.")],
    mask: MaskOption = None,
    ink: InkOption = None,
) -> None:
    """Write a scene to start from: one light, and a material for each flat colour.

    Example: lampblack scene walk/ -o walk.json
    """
    check_suffix(output, ".json")
    shot = _open(inputs, mask, ink)
    canvas = shot.shot.canvas
    if canvas is None:
        height, width = shot.shot.cel(shot.frames[0]).pixels.shape[:2]
        canvas = Canvas(width, height)
    start = default_scene(canvas.width, canvas.height)
    materials = {colour: Material() for colour, _ in _count_colours(shot)}
    with atomic_file(output) as file:
        file.write(encode_scene(replace(start, materials=materials)))


def _open(inputs: list[str], mask: Path | None, ink: Path | None) -> ResolvedShot:
    mask_path, ink_path = (None if path is None else str(path) for path in (mask, ink))
    return resolve_shot(
        RenderSettings(inputs=tuple(inputs), output="", mask=mask_path, ink=ink_path)
    )


def _count_colours(shot: ResolvedShot) -> list[tuple[str, int]]:
    """Flat colours and their pixels over all frames, most used first."""
    counts: Counter[str] = Counter()
    with progress_bar() as bar:
        for group in bar.track(by_drawing(shot.frames), description="Reading"):
            name = group[0].name
            try:
                cel = shot.shot.cel(group[0])
                drawing = take_apart(cel.pixels, mask=cel.mask, ink=cel.ink)
            except NothingDrawnError as error:
                if shot.single:
                    raise
                warnings.warn(f"{name}: {error.what}", LampblackWarning, stacklevel=2)
                continue
            except DrawingError as error:
                raise DrawingError(f"{name}: {error.what}", error.remedy, error.details) from error
            for swatch in drawing.palette.swatches:
                counts[swatch.colour] += swatch.pixels * len(group)
    return counts.most_common()
