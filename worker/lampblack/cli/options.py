"""Options that several commands share, and how their text becomes values."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from numpy.typing import NDArray

from ..cache import ArrayCache, user_cache_folder
from ..drawing import Drawing, load_picture, take_apart
from ..errors import LampblackError, SceneError
from ..scene import MAX_LIGHTS, AreaLight, Canvas, Floor, Scene, decode_scene, default_light


class QualityName(StrEnum):
    """Presets of ``render/quality.py``."""

    LOW = "low"
    MEDIUM = "medium"
    FINAL = "final"


class Solver(StrEnum):
    """The exact minimiser, or the paper's gradient descent."""

    DIRECT = "direct"
    ADAM = "adam"


MaskOption = Annotated[
    Path | None, typer.Option("--mask", help="Picture whose white or opaque part is the figure.")
]
InkOption = Annotated[
    Path | None, typer.Option("--ink", help="Picture whose dark or opaque part is the line.")
]
GridsOption = Annotated[
    int, typer.Option("--grids", min=1, max=64, help="Grids of tiles averaged for the normals.")
]
SolverOption = Annotated[Solver, typer.Option("--solver", help="How normals become a surface.")]


def open_cache() -> ArrayCache:
    """The cache that every command of this user shares."""
    return ArrayCache(user_cache_folder() / "surfaces")


def read_drawing(path: Path, mask: Path | None, ink: Path | None) -> Drawing:
    """Load a drawing and take it apart, with the artist's own mask or ink if named."""
    return take_apart(load_picture(path), mask=_optional(mask), ink=_optional(ink))


def _optional(path: Path | None) -> NDArray[np.uint8] | None:
    return None if path is None else load_picture(path)


def read_scene(path: Path) -> Scene:
    """Load a scene file.

    Raises:
        SceneError: it cannot be read, or is no scene.
    """
    try:
        return decode_scene(path.read_bytes())
    except OSError as error:
        raise SceneError(
            f"The scene {path} cannot be read.", "Write one: lampblack scene.", str(error)
        ) from error


def parse_light(text: str) -> tuple[float, float, float]:
    """``X,Y,Z`` in canvas pixels.

    Raises:
        SceneError: not three finite numbers within a canvas's reach.
    """
    try:
        x, y, z = (float(part) for part in text.split(","))
    except ValueError:
        raise SceneError(
            f"{text!r} is not a light.", "Write it as X,Y,Z in pixels: --light 250,150,400."
        ) from None
    if not all(abs(value) <= 1e5 for value in (x, y, z)):
        raise SceneError(f"The light {text!r} is out of range.", "Stay within 100000 pixels.")
    return x, y, z


def lights_at(texts: list[str], canvas: Canvas) -> tuple[AreaLight, ...]:
    """A default light at each ``X,Y,Z``."""
    if len(texts) > MAX_LIGHTS:
        raise SceneError(f"{len(texts)} lights were named; {MAX_LIGHTS} is the most.")
    return tuple(default_light(canvas, *parse_light(text)) for text in texts)


def floor_at(line: float) -> Floor:
    """The default floor at this canvas line.

    Raises:
        SceneError: not finite, or beyond a canvas's reach.
    """
    if not abs(line) <= 1e5:
        raise SceneError(f"The floor {line} is out of range.", "Stay within 100000 pixels.")
    return Floor(line)


def keep_inputs(output: Path, inputs: Iterable[Path]) -> None:
    """Refuse an output that would replace one of the inputs."""
    if output.exists() and any(path.exists() and path.samefile(output) for path in inputs):
        raise LampblackError(f"{output} is one of the inputs; it would be lost.", "Choose another.")


def check_suffix(path: Path, *suffixes: str) -> None:
    """Refuse an output whose kind is unknown, before any work is done."""
    if path.suffix.lower() not in suffixes:
        raise LampblackError(
            f"{path} is of no kind that can be written here.", f"Known: {', '.join(suffixes)}."
        )
