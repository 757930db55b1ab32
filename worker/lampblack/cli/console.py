"""What people read: progress, warnings and errors, all on stderr."""

from __future__ import annotations

import signal
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import NoReturn

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from ..errors import LampblackError, LampblackWarning

console = Console(stderr=True, highlight=False, soft_wrap=True)

EXIT_FAILED = 1
EXIT_UNLIT = 3
"""Finished, but at least one frame was passed through unlit."""
EXIT_INTERRUPTED = 130


def print_error(error: LampblackError, subject: str = "") -> None:
    """What happened, what to do, and details to copy."""
    console.print("[bold red]error:[/] ", end="")
    console.print(subject + error.what, markup=False)
    if error.remedy:
        console.print(f"  {error.remedy}", markup=False)
    if error.details:
        console.print(f"  details: {error.details}", markup=False, style="dim")


def _print_warning(
    message: Warning | str, category: type[Warning], *_: object, **__: object
) -> None:
    console.print("[bold yellow]warning:[/] ", end="")
    console.print(str(message), markup=False)


def _terminate(number: int, frame: FrameType | None) -> NoReturn:
    raise SystemExit(128 + number)


@contextmanager
def for_people() -> Iterator[None]:
    """Run a command: warnings and faults are told in sentences, and the exit code says which.

    SIGTERM and a closed terminal unwind like Ctrl-C does, so that no half-written file and no
    child stay behind.
    """
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, _terminate)
    warnings.simplefilter("ignore")
    warnings.simplefilter("always", LampblackWarning)
    warnings.showwarning = _print_warning
    try:
        yield
    except LampblackError as error:
        print_error(error)
        sys.exit(EXIT_FAILED)
    except MemoryError:
        print_error(LampblackError("There is not enough memory.", "Close other programs."))
        sys.exit(EXIT_FAILED)


def progress_bar() -> Progress:
    """A bar that leaves no trace when it is done; silent where there is no terminal."""
    return Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        console=console,
        transient=True,
        disable=not console.is_terminal,
    )
