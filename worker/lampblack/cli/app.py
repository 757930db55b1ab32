"""The commands of ``lampblack``."""

from __future__ import annotations

import functools
from collections.abc import Callable
from importlib import import_module

import typer

from .. import __version__
from .bench import bench
from .console import EXIT_INTERRUPTED, console, for_people
from .doctor import doctor
from .export import export
from .job import job
from .render import render
from .serve import serve
from .stages import palette, scene
from .surface import mesh, normals
from .turntable import turntable

research = import_module("lampblack_research.cli")
"""Named only here: nothing imports it."""

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    help="Light hand-drawn animation with real global illumination.",
)


def _interruptible(command: Callable[..., None]) -> Callable[..., None]:
    """Ctrl-C ends ``command`` with a sentence, before typer ends it without one."""

    @functools.wraps(command)
    def call(*arguments: object, **options: object) -> None:
        try:
            command(*arguments, **options)
        except KeyboardInterrupt:
            console.print("Interrupted; what was finished is kept.")
            raise typer.Exit(EXIT_INTERRUPTED) from None

    return call


for command in (
    render,
    job,
    serve,
    normals,
    mesh,
    turntable,
    export,
    palette,
    scene,
    research.train,
    research.evaluate,
    research.flicker,
    bench,
    doctor,
):
    app.command()(_interruptible(command))
dataset = typer.Typer(no_args_is_help=True, help="Drawings of models, with exact truth.")
dataset.command()(_interruptible(research.build))
app.add_typer(dataset, name="dataset")


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(__version__)
        raise typer.Exit


@app.callback()
def options(
    version: bool = typer.Option(False, "--version", callback=_version, is_eager=True),
) -> None:
    """Light hand-drawn animation with real global illumination."""


def main() -> None:
    """Entry point of the ``lampblack`` command."""
    with for_people():
        app()
