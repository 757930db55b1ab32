"""The commands of ``lampblack``."""

from __future__ import annotations

import os

import typer

from .. import __version__
from .console import for_people
from .lazy import Commands, group_of

COMMANDS: Commands = {
    "render": ("lampblack.cli.render:render", "Light drawings, or the frames of a project."),
    "estimate": ("lampblack.cli.estimate:estimate", "Estimate time and disk space of a render."),
    "job": ("lampblack.cli.job:job", "Write an OpenJD job template that lights a shot."),
    "serve": ("lampblack.cli.serve:serve", "Serve a drawing program with previews and renders."),
    "key": (
        "lampblack.cli.key:key",
        "Make a pair of keys, for a worker that serves other machines.",
    ),
    "normals": ("lampblack.cli.surface:normals", "Predict the normal maps of drawings."),
    "height": ("lampblack.cli.surface:height", "Inflate drawings into heights, as arrays."),
    "depth": ("lampblack.cli.surface:depth", "Show which parts of drawings are in front."),
    "mesh": ("lampblack.cli.surface:mesh", "Inflate drawings into closed relief meshes."),
    "turntable": ("lampblack.cli.turntable:turntable", "Show a drawing's relief from the sides."),
    "export": ("lampblack.cli.export:export", "Write one frame as a 3D scene for other programs."),
    "layers": ("lampblack.cli.layers:layers", "Write the layers of each frame as PNG files."),
    "palette": ("lampblack.cli.stages:palette", "List the flat colours of drawings."),
    "scene": ("lampblack.cli.stages:scene", "Write a scene file to start from."),
    "train": ("lampblack_research.cli.train:train", "Train a normal network."),
    "evaluate": (
        "lampblack_research.cli.evaluate:evaluate",
        "Compare predicted normals with the truth.",
    ),
    "flicker": (
        "lampblack_research.cli.flicker:flicker",
        "Measure how much normals and cuts change from drawing to drawing.",
    ),
    "bench": ("lampblack.cli.bench:bench", "Measure speed on this machine."),
    "doctor": ("lampblack.cli.doctor:doctor", "Check this installation part by part."),
}
DATASET_COMMANDS: Commands = {
    "build": ("lampblack_research.cli.dataset:build", "Draw models from many sides."),
}
RIG_COMMANDS: Commands = {
    "list": ("lampblack.cli.rig:list_rigs", "List the rigs that come with Lampblack."),
    "show": (
        "lampblack.cli.rig:show",
        "Print a rig as JSON, to change it and save it as your own.",
    ),
    "save": ("lampblack.cli.rig:save", "Write the lights of a scene as a rig."),
}

app = typer.Typer(
    cls=group_of(COMMANDS),
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)
app.add_typer(
    typer.Typer(
        cls=group_of(DATASET_COMMANDS),
        callback=lambda: None,
        no_args_is_help=True,
        help="Make data sets of drawings with exact truth.",
    ),
    name="dataset",
)
app.add_typer(
    typer.Typer(
        cls=group_of(RIG_COMMANDS),
        callback=lambda: None,
        no_args_is_help=True,
        help="Use lights again in other shots.",
    ),
    name="rig",
)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(__version__)
        raise typer.Exit


@app.callback()
def options(
    version: bool = typer.Option(
        False, "--version", callback=_version, is_eager=True, help="Show the version and exit."
    ),
) -> None:
    """Light hand-drawn animation with real global illumination."""


def main() -> None:
    """Entry point of the ``lampblack`` command."""
    # Python programs started from here find no modules in the current folder: it may be a
    # downloaded project. Those of ``multiprocessing`` would look there first.
    os.environ.setdefault("PYTHONSAFEPATH", "1")
    with for_people():
        app()
