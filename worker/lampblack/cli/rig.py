"""``lampblack rig list``, ``show`` and ``save``: lights to use again."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from .outputs import check_suffix

Named = Annotated[str, typer.Argument(metavar="RIG", help="Name or file of a rig.")]


def list_rigs() -> None:
    """List the rigs that come with Lampblack.

    Example: lampblack rig list
    """
    from ..rigs import PRESETS, preset

    for name in PRESETS:
        lights = ", ".join(light.name.lower() for light in preset(name).lights)
        sys.stdout.write(f"{name:<12} {lights}\n")


def show(rig: Named) -> None:
    """Print a rig as JSON, to change it and save it as your own.

    Example: lampblack rig show sunset > my-sunset.json
    """
    from ..rigs import find_rig
    from ..scene import encode_rig

    sys.stdout.write(encode_rig(find_rig(rig)).decode())


def save(
    scene: Annotated[Path, typer.Argument(metavar="SCENE", help="Scene file with the lights.")],
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="JSON", help="Rig file to write.")
    ],
    name: Annotated[str, typer.Option("--name", help="Name of the rig, for people.")] = "",
) -> None:
    """Write the lights of a scene as a rig.

    The scene of a Pencil2D project lies next to it: walk.pclx.lampblack.json.

    Example: lampblack rig save walk.pclx.lampblack.json -o night.json --name Night
    """
    from ..atomic import atomic_file
    from ..finals.scene_overrides import read_scene
    from ..rigs import rig_of
    from ..scene import encode_rig

    check_suffix(output, ".json")
    with atomic_file(output) as file:
        file.write(encode_rig(rig_of(read_scene(scene), name)))
