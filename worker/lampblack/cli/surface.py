"""``lampblack normals``, ``height``, ``depth`` and ``mesh``: normal maps, heights and meshes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..choices import Engine, NormalsAxis
from ..finals.settings import RenderSettings
from .drawings import each_drawing, each_prepared
from .options import with_settings
from .outputs import check_suffix, keep_inputs
from .overviews import SpriteSheet

if TYPE_CHECKING:
    from ..finals.resolve import ResolvedShot
    from ..finals.targets import Targets


@with_settings("inputs", "sheet", "frames", "grids", "layer_body", "steady", "mask", "ink")
def normals(
    settings: RenderSettings,
    output: Annotated[
        str,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE|DIR|PATTERN",
            help="A .png or .npy file, a pattern (n.%04d.npy) or a folder.",
        ),
    ],
    y: Annotated[
        NormalsAxis | None,
        typer.Option(
            "--y", help="Where green points: up (OpenGL) or down (DirectX). Default: the engine's."
        ),
    ] = None,
    engine: Annotated[
        Engine | None,
        typer.Option(
            "--engine",
            help="Game engine: its names in a folder (godot hero_n, unity hero_NormalMap, unreal "
            "hero_N), its y (unreal: down), and flat normals around the character.",
        ),
    ] = None,
    sprite_sheet: SpriteSheet = None,
) -> None:
    """Predict the normal maps of drawings.

    A .npy holds (H, W, 3) float32: x right, y up, z to the viewer, length 1 in the character mask
    and 0 outside. A .png holds the same with -1..1 as 0..255, transparent outside.

    Example: lampblack normals hero.png -o hero.normals.png
    """
    import numpy as np

    from ..atomic import atomic_file
    from ..cache import surface_cache
    from ..choices import PipelineOptions
    from ..drawing import load_picture, save_picture
    from ..finals.neighbours import NeighbourLoader
    from ..finals.normal_map import engine_of, normal_map, pointing
    from ..finals.sheet import cells_of, save_sheet
    from ..pipeline import Pipeline
    from ..shot import by_drawing

    habits = engine_of(engine)
    shot, targets = _resolve(settings, output, "png", "npy", ending=habits.ending)
    if sprite_sheet is not None:
        check_suffix(sprite_sheet, ".png")
        keep_inputs(sprite_sheet, [*shot.sources, *map(targets.path, shot.frames)])
        check_suffix(Path(f"frames.{targets.kind}"), ".png")
    with Pipeline(surface_cache(), PipelineOptions(settings.grids)) as pipeline:
        around = NeighbourLoader(
            shot.shot, pipeline, shot.reach, choices=shot.overrides.layer_bodies
        )
        groups = by_drawing(shot.frames)
        for frames, drawing in each_drawing(shot, groups, "Predicting", around.drawing):
            found = pipeline.surfaces.normals(drawing, around.neighbours(frames[0]))
            for frame in frames:
                if targets.kind == "npy":
                    with atomic_file(targets.path(frame)) as file:
                        np.save(file, pointing(found, y or habits.y), allow_pickle=False)
                else:
                    picture = normal_map(found, drawing.mask, y or habits.y, flat=habits.flat)
                    save_picture(targets.path(frame), picture)
    if sprite_sheet is not None:
        columns = 0 if settings.sheet is None else cells_of(settings.sheet)[0]
        paths = [targets.path(frame) for frame in shot.frames]
        written = [load_picture(path) if path.exists() else None for path in paths]
        save_sheet(sprite_sheet, written, columns)


@with_settings(
    *("inputs", "frames", "solver", "grids", "depth_hints", "layer_body", "steady", "mask", "ink")
)
def mesh(
    settings: RenderSettings,
    output: Annotated[
        str,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE|DIR|PATTERN",
            help="A .glb, .obj or .ply file, a pattern (m.%04d.glb) or a folder.",
        ),
    ],
    stride: Annotated[
        int, typer.Option(metavar="PIXELS", min=1, max=64, help="Distance between vertices.")
    ] = 1,
    relief_scale: Annotated[
        float,
        typer.Option(metavar="FACTOR", min=0.01, max=10, help="Factor on the depth of the relief."),
    ] = 1.0,
) -> None:
    """Inflate drawings into closed relief meshes.

    Vertices are in pixels: x right, y up, z to the viewer.

    Example: lampblack mesh hero.png -o hero.glb
    """
    from ..cache import surface_cache
    from ..choices import PipelineOptions
    from ..pipeline import Pipeline
    from ..surface.export import save_mesh

    shot, targets = _resolve(settings, output, "glb", "obj", "ply")
    with Pipeline(surface_cache(), PipelineOptions(settings.grids, settings.solver)) as pipeline:
        for frames, prepared in each_prepared(shot, pipeline, "Inflating"):
            relief = prepared.relief(stride=stride, relief_scale=relief_scale)
            for frame in frames:
                save_mesh(relief, targets.path(frame))


@with_settings("inputs", "frames", "depth_hints", "layer_body", "steady", "mask", "ink")
def height(
    settings: RenderSettings,
    output: Annotated[
        str,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE|DIR|PATTERN",
            help="A .npy file, a pattern (h.%04d.npy) or a folder.",
        ),
    ],
) -> None:
    """Inflate drawings into heights, as arrays.

    A .npy holds (H, W) float32: pixels towards the viewer, NaN outside the character.

    Example: lampblack height hero.png -o hero.height.npy
    """
    _write_heights(settings, output, "npy")


@with_settings("inputs", "sheet", "frames", "depth_hints", "layer_body", "steady", "mask", "ink")
def depth(
    settings: RenderSettings,
    output: Annotated[
        str,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE|DIR|PATTERN",
            help="A .png or .npy file, a pattern (d.%04d.png) or a folder.",
        ),
    ],
) -> None:
    """Show which parts of drawings are in front.

    A .png is grey: nearer is brighter. A .npy holds the heights, as those of lampblack height.

    Example: lampblack depth hero.png -o hero.depth.png
    """
    _write_heights(settings, output, "png", "npy")


def _write_heights(settings: RenderSettings, output: str, *kinds: str) -> None:
    import numpy as np

    from ..atomic import atomic_file
    from ..cache import surface_cache
    from ..drawing import save_picture
    from ..pipeline import Pipeline
    from ..surface import depth_picture, full_size

    shot, targets = _resolve(settings, output, *kinds)
    with Pipeline(surface_cache()) as pipeline:
        for frames, prepared in each_prepared(shot, pipeline, "Inflating"):
            found = full_size(prepared.height, prepared.mask, prepared.size)
            for frame in frames:
                if targets.kind == "npy":
                    with atomic_file(targets.path(frame)) as file:
                        np.save(file, found, allow_pickle=False)
                else:
                    inside = np.isfinite(found)
                    picture = depth_picture(np.nan_to_num(found), inside)
                    save_picture(targets.path(frame), picture)


def _resolve(
    settings: RenderSettings, output: str, *kinds: str, ending: str = ""
) -> tuple[ResolvedShot, Targets]:
    """The shot and its target files. Jobs that would lose a file are refused."""
    from ..finals.resolve import resolve_shot
    from ..finals.targets import Targets

    path = Path(output)
    if path.suffix and not path.is_dir():
        check_suffix(path, *(f".{kind}" for kind in kinds))
    own = [Path(given) for given in (settings.mask, settings.ink) if given is not None]
    keep_inputs(path, [*settings.inputs, *own])
    shot = resolve_shot(settings)
    targets = Targets(output, kinds=kinds, ending=ending)
    targets.prepare(shot.frames, [*shot.sources, *own])
    return shot, targets
