"""Commands that are listed without their modules, which take seconds to import."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any

import typer
from typer.core import TyperCommand, TyperGroup

from ..errors import LampblackError
from .console import EXIT_INTERRUPTED, say

Commands = Mapping[str, tuple[str, str]]
"""By name: ``module:function``, and the first line of the function's docstring."""


class LazyCommand(TyperCommand):
    """A command whose module is imported when it is called."""

    def __init__(self, name: str, where: str, summary: str) -> None:
        super().__init__(name, short_help=summary)
        self._where = where

    def make_context(self, *arguments: Any, **options: Any) -> Any:
        return self.load().make_context(*arguments, **options)

    def load(self) -> Any:
        """The command itself.

        Raises:
            LampblackError: it belongs to a part that is not installed.
        """
        module, _, function = self._where.partition(":")
        try:
            command = getattr(import_module(module), function)
        except ModuleNotFoundError as error:
            if (error.name or "").partition(".")[0] != module.partition(".")[0]:
                raise
            raise LampblackError(
                f"The command {self.name} is not part of this installation.",
                "Install Lampblack from its source tree.",
                str(error),
            ) from error
        own = typer.Typer(add_completion=False, rich_markup_mode=None)
        own.command(self.name)(_interruptible(command))
        return typer.main.get_command(own)


def group_of(commands: Commands) -> type[TyperGroup]:
    """A kind of group that has ``commands``, for ``typer.Typer(cls=...)``."""

    class Group(TyperGroup):
        def __init__(self, **options: Any) -> None:
            super().__init__(**options)
            lazy = {name: LazyCommand(name, *listed) for name, listed in commands.items()}
            self.commands = {**lazy, **self.commands}

    return Group


def _interruptible(command: Callable[..., None]) -> Callable[..., None]:
    """Ctrl-C ends ``command`` with a sentence, before typer ends it without one."""

    @functools.wraps(command)
    def call(*arguments: object, **options: object) -> None:
        try:
            command(*arguments, **options)
        except KeyboardInterrupt:
            say("Interrupted. Finished files are kept.")
            raise typer.Exit(EXIT_INTERRUPTED) from None

    return call
