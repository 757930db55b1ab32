"""``lampblack evaluate``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import msgspec
import typer
from PIL import Image
from rich.console import Console
from rich.table import Table

from lampblack.atomic import atomic_file
from lampblack.cli.console import progress_bar
from lampblack.errors import LampblackError
from lampblack.normals.predict_tiles import PAPER_GRIDS

from ..evaluation.evaluate import PEERS
from ..evaluation.evaluate import evaluate as measure
from ..evaluation.sheet import ComparisonSheet
from ..evaluation.surfaces import Method, NetworkMethod

COLUMNS = (
    *("mean", "median", "l1", "l2", "under_11", "under_22", "under_30"),
    *("tilt", "truth_tilt", "rim", "truth_rim", "curvature", "concave", "dented", "seconds"),
)
DEPTH_COLUMNS = (
    *("recovered", "recovered_median", "quarter", "sign", "over", "false", "cut"),
    *("height_angle", "rmse", "shadow_recall", "shadow_precision"),
)
MARK_COLUMNS = (
    *("marks_cut", "hatching_cut", "stripes_cut", "spots_cut"),
    *("marks_rise", "hatching_rise", "stripes_rise", "spots_rise"),
)


def evaluate(
    models: Annotated[
        Path, typer.Option("--models", metavar="DIR", help="Folder of meshes, with split.csv.")
    ],
    split: Annotated[
        str, typer.Option(help="Meshes to use: a part of split.csv, or all for every mesh.")
    ] = "val",
    methods: Annotated[
        str,
        typer.Option(
            "--methods",
            metavar="LIST",
            help="Methods to compare with the first: lampblack, paper, flat, laigter, "
            "laigter-tuned, inflate, lumo, lumo-mixed, or NAME=FILE.safetensors for your own "
            "weights, such as hudon2018=runs/first/network.safetensors.",
        ),
    ] = "lampblack,paper,flat,laigter,laigter-tuned,inflate,lumo,lumo-mixed",
    views: Annotated[int, typer.Option(min=1, max=64, help="Viewpoints for each mesh.")] = 8,
    resolution: Annotated[
        int,
        typer.Option(
            "--resolution", min=64, max=2048, help="Longest side of the character, in pixels."
        ),
    ] = 768,
    lines: Annotated[
        Literal["freestyle", "gbuffer"], typer.Option(help="Method that draws the ink lines.")
    ] = "freestyle",
    most: Annotated[
        int | None,
        typer.Option(
            "--most",
            metavar="N",
            min=1,
            help="Number of drawings at most, evenly chosen. Default: every viewpoint of every "
            "mesh.",
        ),
    ] = None,
    depth: Annotated[
        bool,
        typer.Option(
            "--depth",
            help="Measure also the surfaces: depth jumps and shadows between parts.",
        ),
    ] = False,
    marks: Annotated[
        bool,
        typer.Option(
            "--marks",
            help="With --depth: measure also what hatching, stripes and spots on the drawings "
            "do to normals and surfaces.",
        ),
    ] = False,
    clicks: Annotated[
        bool,
        typer.Option(
            "--clicks",
            help="With --depth: measure also the surfaces after the worst overlap of each "
            "drawing is corrected with one click, and the share of its largest wrong hollow "
            "that one stroke mends.",
        ),
    ] = False,
    as_json: Annotated[
        Path | None,
        typer.Option("--json", metavar="FILE", help="File to write the figures to, as JSON."),
    ] = None,
    sheet: Annotated[
        Path | None,
        typer.Option("--sheet", metavar="PNG", help="File to write a contact sheet to."),
    ] = None,
) -> None:
    """Compare predicted normals with the truth.

    The table lists the angle between them and other measures, for networks and other methods.
    With --depth a second table compares their surfaces with the true depth and its shadows. It
    has rows for the true normals and the true depth: the most that any method can reach.

    Example: lampblack evaluate --models meshes/ --split val --json val.json
    """
    if (marks or clicks) and not depth:
        raise LampblackError("Marks and clicks are measured on surfaces.", "Add --depth.")
    chosen = dict(_method(named) for named in methods.split(","))
    comparison = ComparisonSheet()
    with progress_bar() as bar:
        task = bar.add_task("Evaluating", total=100)
        table = measure(
            models,
            None if split == "all" else split,
            chosen,
            views=views,
            character_px=resolution,
            lines=lines,
            most=most,
            depth=depth,
            marks=marks,
            clicks=clicks,
            progress=lambda share: bar.update(task, completed=int(100 * share)),
            on_drawing=comparison.add if sheet else None,
        )
    if sheet:
        with atomic_file(sheet) as file:
            Image.fromarray(comparison.picture()).save(file, "PNG")
    if as_json:
        with atomic_file(as_json) as file:
            file.write(msgspec.json.format(msgspec.json.encode(table), indent=2) + b"\n")
    _show(table, COLUMNS)
    if depth:
        _show(table, DEPTH_COLUMNS)
    if depth and marks:
        _show(table, MARK_COLUMNS)
    if depth and clicks:
        _show(table, ("mended",))


def _show(table: dict[str, dict[str, float]], columns: tuple[str, ...]) -> None:
    shown = Table("method", *columns)
    for name, row in table.items():
        if columns[0] in row:
            shown.add_row(name, *(f"{row[column]:.3g}" for column in columns))
    Console(width=160).print(shown)


def _method(named: str) -> tuple[str, Method]:
    name, _, file = named.strip().partition("=")
    if file:
        return name, NetworkMethod(Path(file))
    if name == "lampblack":
        return name, NetworkMethod(None)
    if name == "paper":
        return name, NetworkMethod(None, PAPER_GRIDS)
    if name not in PEERS:
        raise LampblackError(
            f"There is no method {name!r}.",
            f"Known: lampblack, paper, {', '.join(PEERS)}; and NAME=FILE for weights of your own.",
        )
    return name, PEERS[name]
