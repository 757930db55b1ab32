"""Options that several commands share, and how their text becomes values."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from ..cache import ArrayCache, user_cache_folder
from ..choices import LayerRole
from ..errors import LampblackError


class QualityName(StrEnum):
    """Presets of ``render/quality.py``."""

    LOW = "low"
    MEDIUM = "medium"
    FINAL = "final"


class FormatName(StrEnum):
    """Kinds of finals."""

    PNG = "png"
    EXR = "exr"


class Solver(StrEnum):
    """The exact minimiser, or the paper's gradient descent."""

    DIRECT = "direct"
    ADAM = "adam"


InputsArgument = Annotated[
    list[str], typer.Argument(metavar="INPUT", help="PNG, folder, walk.%04d.png, a .pclx or .ora.")
]
SceneOption = Annotated[
    Path | None,
    typer.Option("--scene", help="Scene file. Default of walk.pclx: walk.pclx.lampblack.json."),
]
QualityOption = Annotated[
    QualityName | None, typer.Option("--quality", help="Default: the scene's, or low.")
]
FramesOption = Annotated[
    str | None, typer.Option("--frames", help="Frame numbers, such as 1-20x2,25.")
]
FormatOption = Annotated[
    FormatName | None, typer.Option("--format", help="Default: the pattern's, or png.")
]
CharacterOption = Annotated[
    list[str] | None,
    typer.Option("--character", metavar="LAYER", help="Of a project: a layer to light."),
]
LineOption = Annotated[
    list[str] | None,
    typer.Option("--line", metavar="LAYER", help="Of a project: a layer of the characters' line."),
]
BackgroundOption = Annotated[
    list[str] | None,
    typer.Option("--background", metavar="LAYER", help="Of a project: a layer to leave unlit."),
]
CameraOption = Annotated[
    str | None,
    typer.Option("--camera", metavar="LAYER", help="Of a project; default: the first camera."),
]
MaskOption = Annotated[
    Path | None, typer.Option("--mask", help="Picture whose white or opaque part is the figure.")
]
InkOption = Annotated[
    Path | None, typer.Option("--ink", help="Picture whose dark or opaque part is the line.")
]
GridsOption = Annotated[
    int,
    typer.Option(
        "--grids", min=0, max=64, help="0: the whole figure at once; else the paper's grids."
    ),
]
SteadyOption = Annotated[
    bool,
    typer.Option(
        "--steady/--no-steady", help="Lay the drawings beside each one onto it, against flicker."
    ),
]
SolverOption = Annotated[Solver, typer.Option("--solver", help="How normals become a surface.")]


def layer_roles(
    character: list[str] | None, line: list[str] | None, background: list[str] | None
) -> dict[str, LayerRole]:
    """What the layers of a project are, by name.

    Raises:
        LampblackError: a layer was named twice.
    """
    named: list[tuple[str, LayerRole]] = [(name, "character") for name in character or []]
    named += [(name, "line") for name in line or []]
    named += [(name, "background") for name in background or []]
    roles = dict(named)
    if len(roles) < len(named):
        raise LampblackError("A layer was named twice.", "A layer is one thing only.")
    return roles


def open_cache() -> ArrayCache:
    """The cache that every command of this user shares."""
    return ArrayCache(user_cache_folder() / "surfaces")


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
