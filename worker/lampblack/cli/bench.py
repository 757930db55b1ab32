"""``lampblack bench``: named figures with units, as one JSON object."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from ..errors import LampblackError

if TYPE_CHECKING:
    from ..scene import Scene

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"

Benchmark = Literal["inflate", "normals", "final", "relight", "animation", "scale"]


def bench(
    what: Annotated[Benchmark, typer.Argument(metavar="STAGE", help="The stage to measure.")],
    drawing: Annotated[
        Path | None,
        typer.Argument(
            metavar="DRAWING",
            help="A PNG; for animation a project or folder. Default: an example.",
        ),
    ] = None,
    scene: Annotated[
        Path | None,
        typer.Option(
            "--scene", metavar="FILE", help="Scene file for final, relight and animation."
        ),
    ] = None,
    reference: Annotated[
        bool,
        typer.Option("--reference", help="For final: measure the noise too; takes minutes."),
    ] = False,
    compare: Annotated[
        Path | None,
        typer.Option(
            "--compare",
            metavar="DIR",
            help="Virtual environment of another version: run both in turns, and print the "
            "ratios, this version to the other.",
        ),
    ] = None,
    rounds: Annotated[
        int, typer.Option(min=2, max=100, help="For --compare: how often both are run.")
    ] = 5,
    as_json: Annotated[bool, typer.Option("--json", help="Print the figures as JSON.")] = False,
) -> None:
    """Measure speed on this machine.

    Example: lampblack bench inflate --json
    """
    from ..drawing import decompose_drawing, load_picture

    if compare is not None:
        arguments = [what, *([str(drawing)] if drawing else [])]
        arguments += ["--scene", str(scene)] if scene else []
        _compare(compare, [*arguments, *(["--reference"] if reference else [])], rounds, as_json)
        return
    if what == "animation":
        from ..bench.animation import bench_animation

        _show(bench_animation(drawing or _example("lamplighter.pclx"), scene), as_json)
        return
    picture = load_picture(drawing or _example("character.png"))
    if what == "inflate":
        from ..bench.inflate import bench_inflate
        from ..normals.predict import NormalPredictor

        taken = decompose_drawing(picture)
        figures = bench_inflate(
            NormalPredictor().predict(taken.lines, taken.mask).normals, taken.mask
        )
    elif what == "scale":
        from ..bench.scale import bench_scale
        from .console import progress_bar

        with progress_bar() as bar:
            task = bar.add_task("Measuring", total=1.0)
            figures = bench_scale(picture, lambda share: bar.update(task, completed=share))
    elif what == "normals":
        from ..bench.normals import bench_normals

        figures = bench_normals(picture)
    elif what == "relight":
        from ..bench.relight import bench_relight

        figures = bench_relight(picture, _scene(scene, drawing, picture.shape))
    else:
        from ..bench.final import bench_final

        figures = bench_final(picture, _scene(scene, drawing, picture.shape), reference=reference)
    _show(figures, as_json)


def _compare(other: Path, arguments: list[str], rounds: int, as_json: bool) -> None:
    import msgspec
    from rich.console import Console
    from rich.table import Table

    from ..bench.compare import alternate, installed, ratios
    from .console import progress_bar

    here, there = (installed(where, arguments) for where in (Path(sys.prefix), other))
    pairs = []
    with progress_bar() as bar:
        task = bar.add_task("Comparing", total=rounds)
        for pair in alternate(here, there, rounds):
            pairs.append(pair)
            bar.advance(task)
    found = ratios(pairs)
    if as_json:
        sys.stdout.write(msgspec.json.encode(found).decode() + "\n")
        return
    table = Table("figure", "here", "there", "here / there", "95 % interval")
    for name, each in found.items():
        interval = f"{each.low:.3f} to {each.high:.3f}"
        table.add_row(
            name, f"{each.here:,.4g}", f"{each.there:,.4g}", f"{each.ratio:.3f}", interval
        )
    Console(width=120).print(table)


def _show(figures: dict[str, float], as_json: bool) -> None:
    import msgspec

    figures = {n: float(f"{v:.4g}") if isinstance(v, float) else v for n, v in figures.items()}
    if as_json:
        sys.stdout.write(msgspec.json.encode(figures).decode() + "\n")
        return
    for name, value in figures.items():
        sys.stdout.write(f"{name:32} {value:,}\n")


def _scene(path: Path | None, drawing: Path | None, shape: tuple[int, ...]) -> Scene:
    from ..finals.scene_overrides import read_scene
    from ..scene import default_scene

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
