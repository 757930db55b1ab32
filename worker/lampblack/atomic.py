"""Atomic writing: a file appears whole or not at all."""

from __future__ import annotations

import secrets
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from .errors import OutputError


@contextmanager
def atomic_file(path: Path) -> Iterator[BinaryIO]:
    """Write to a temporary name beside ``path``. It is renamed to ``path`` when the block
    succeeds, and removed when it fails.

    Raises:
        OutputError: the folder is missing or not writable, or the disk is full.
    """
    with atomic_path(path) as temporary, temporary.open("wb") as file:
        yield file


@contextmanager
def atomic_path(path: Path) -> Iterator[Path]:
    """Like ``atomic_file``, for libraries that need the temporary name."""
    # Named before it is created, so that it is removed after an interruption at any moment.
    temporary = path.parent / f".{path.stem[:40]}.{secrets.token_hex(8)}.part{path.suffix}"
    try:
        temporary.open("xb").close()
        yield temporary
        temporary.replace(path)
    except OSError as error:
        raise OutputError(
            f"{path} could not be written: {error.strerror or error}.",
            "Check that the folder exists, may be written to and has room.",
            str(error),
        ) from error
    finally:
        with suppress(OSError):
            temporary.unlink()


def make_folder(folder: Path) -> None:
    """Make a folder for results, and those around it, unless it is there.

    Raises:
        OutputError: it cannot be made.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(
            f"The folder {folder} cannot be made.", "Choose another.", str(error)
        ) from error
