"""``lampblack bench``: named figures with units, as one JSON object."""

from __future__ import annotations

import sys
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import msgspec
import typer

from ..drawing import load_picture, take_apart
from ..errors import LampblackError
from ..finals.scene_overrides import read_scene
from ..scene import Scene, default_scene

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"


class Benchmark(StrEnum):
    """What can be measured."""

    INFLATE = "inflate"
    NORMALS = "normals"
    FINAL = "final"
    RELIGHT = "relight"
    ANIMATION = "animation"


def bench(
    what: Benchmark,
    drawing: Annotated[
        Path | None,
        typer.Argument(metavar="[DRAWING]", help="Default: an example. Of animation: a shot."),
    ] = None,
    scene: Annotated[
        Path | None, typer.Option("--scene", help="For all but inflate, normals.")
    ] = None,
    reference: Annotated[
        bool, typer.Option("--reference", help="final: also measure noise (minutes).")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Measure speed on this machine.

    Example: lampblack bench inflate --json
    """
    if what is Benchmark.ANIMATION:
        from ..bench.animation import bench_animation

        _show(bench_animation(drawing or _example("lamplighter.pclx"), scene), as_json)
        return
    picture = load_picture(drawing or _example("character.png"))
    if what is Benchmark.INFLATE:
        from ..bench.inflate import bench_inflate
        from ..normals.predict import NormalPredictor

        taken = take_apart(picture)
        figures = bench_inflate(NormalPredictor().predict(taken.lines, taken.mask), taken.mask)
    elif what is Benchmark.NORMALS:
        from ..bench.normals import bench_normals

        figures = bench_normals(picture)
    elif what is Benchmark.RELIGHT:
        from ..bench.relight import bench_relight

        figures = bench_relight(picture, _scene(scene, drawing, picture.shape))
    else:
        from ..bench.final import bench_final

        figures = bench_final(picture, _scene(scene, drawing, picture.shape), reference=reference)
    _show(figures, as_json)


def _show(figures: dict[str, float], as_json: bool) -> None:
    figures = {n: float(f"{v:.4g}") if isinstance(v, float) else v for n, v in figures.items()}
    if as_json:
        sys.stdout.write(msgspec.json.encode(figures).decode() + "\n")
        return
    for name, value in figures.items():
        sys.stdout.write(f"{name:32} {value:,}\n")


def _scene(path: Path | None, drawing: Path | None, shape: tuple[int, ...]) -> Scene:
    if path is not None:
        return read_scene(path)
    if drawing is None:
        return read_scene(_example("character.scene.json"))
    return default_scene(shape[1], shape[0])


def _example(name: str) -> Path:
    path = EXAMPLES / name
    if not path.exists():
        raise LampblackError("The example drawing is not installed here.", "Name a drawing.")
    return path
