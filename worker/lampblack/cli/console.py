"""Progress, warnings and errors for people, all on stderr.

``rich`` is imported only when there is something to show, so that ``--help`` is fast.
"""

from __future__ import annotations

import functools
import re
import signal
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import TYPE_CHECKING, NoReturn

from ..errors import LampblackError, LampblackWarning

if TYPE_CHECKING:
    from rich.console import Console
    from rich.progress import Progress

EXIT_FAILED = 1
EXIT_UNLIT = 3
"""Finished, but at least one frame was passed through unlit."""
EXIT_INTERRUPTED = 130

_CONTROLS = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")


@functools.cache
def _console() -> Console:
    from rich.console import Console

    return Console(stderr=True, highlight=False, soft_wrap=True)


def say(text: str, style: str = "") -> None:
    """Print a line. What would steer the terminal, which names may hold, is spelt out."""
    sound = text.encode("utf-8", "backslashreplace").decode()
    spelt = _CONTROLS.sub(lambda control: f"\\x{ord(control[0]):02x}", sound)
    _console().print(spelt, style=style, markup=False)


def print_error(error: LampblackError, subject: str = "") -> None:
    """Print an error: what happened, what to do, and details to copy."""
    _console().print("[bold red]error:[/] ", end="")
    say(subject + error.what)
    if error.remedy:
        say(f"  {error.remedy}")
    if error.details:
        say(f"  details: {error.details}", "dim")


def _warning_printer() -> Callable[..., None]:
    """Prints warnings, each sentence once."""
    told = set[str]()

    def print_warning(message: Warning | str, *_: object, **__: object) -> None:
        sentence = str(message)
        if sentence not in told:
            told.add(sentence)
            _console().print("[bold yellow]warning:[/] ", end="")
            say(sentence)

    return print_warning


_ENDING = {signal.SIGTERM, getattr(signal, "SIGHUP", signal.SIGTERM)}


def _terminate(number: int, frame: FrameType | None) -> NoReturn:
    for each in _ENDING:  # make passes on what its whole group was sent: the end is not to be ended
        signal.signal(each, signal.SIG_IGN)
    raise SystemExit(128 + number)


@contextmanager
def for_people() -> Iterator[None]:
    """Run a command: warnings and errors are printed as sentences, and set the exit code.

    SIGTERM and a closed terminal act like Ctrl-C, so that no incomplete file and no child process
    remain.
    """
    for number in _ENDING:
        signal.signal(number, _terminate)
    warnings.simplefilter("ignore")
    warnings.simplefilter("always", LampblackWarning)
    warnings.showwarning = _warning_printer()
    try:
        yield
    except LampblackError as error:
        print_error(error)
        sys.exit(EXIT_FAILED)
    except OSError as error:
        print_error(
            LampblackError(
                f"The system refused: {error.strerror or error}.",
                "Check the names and folders that you gave.",
                f"{error.filename or ''}"[:300],
            )
        )
        sys.exit(EXIT_FAILED)
    except MemoryError:
        print_error(LampblackError("There is not enough memory.", "Close other programs."))
        sys.exit(EXIT_FAILED)


def progress_bar() -> Progress:
    """A progress bar that is removed at the end; invisible without a terminal."""
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    return Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        console=_console(),
        transient=True,
        disable=not _console().is_terminal,
    )
