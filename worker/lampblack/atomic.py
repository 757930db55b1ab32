"""Files that appear whole or not at all."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from .errors import OutputError


@contextmanager
def atomic_file(path: Path) -> Iterator[BinaryIO]:
    """Write to a temporary name beside ``path``; renamed when the block ends well, removed
    when it does not.

    Raises:
        OutputError: the folder is missing or not writable, or the disk is full.
    """
    with atomic_path(path) as temporary, temporary.open("wb") as file:
        yield file


@contextmanager
def atomic_path(path: Path) -> Iterator[Path]:
    """As ``atomic_file``, for libraries that want the temporary name itself."""
    temporary = ""
    try:
        handle, temporary = tempfile.mkstemp(
            prefix=f".{path.stem[:40]}.", suffix=f".part{path.suffix}", dir=path.parent
        )
        os.close(handle)
        yield Path(temporary)
        umask = os.umask(0)
        os.umask(umask)
        Path(temporary).chmod(0o666 & ~umask)  # mkstemp's own files are private
        Path(temporary).replace(path)
        temporary = ""
    except OSError as error:
        raise OutputError(
            f"{path} could not be written: {error.strerror or error}.",
            "Check that the folder exists, may be written to and has room.",
            str(error),
        ) from error
    finally:
        if temporary:
            with suppress(OSError):
                Path(temporary).unlink()
