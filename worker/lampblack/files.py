"""Reading files from outside: regular files only, and never more than a limit.

A device, a pipe or a socket under a file's name could be read for ever.
"""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from io import BufferedReader
from pathlib import Path

from .errors import LampblackError

# Opening a pipe that nobody writes to waits for ever without it. Windows has no such pipes.
_FLAGS = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)


def open_regular(path: Path) -> BufferedReader:
    """Open a regular file for reading; links are followed.

    Raises:
        OSError: it cannot be opened, or is something else; IsADirectoryError if it is a folder.
    """
    descriptor = os.open(path, _FLAGS)
    mode = os.fstat(descriptor).st_mode
    if not stat.S_ISREG(mode):
        os.close(descriptor)
        if stat.S_ISDIR(mode):
            raise IsADirectoryError(errno.EISDIR, "Is a directory", str(path))
        raise OSError(errno.EINVAL, "Not a regular file", str(path))
    return os.fdopen(descriptor, "rb")


def read_bounded(path: Path, limit: int) -> bytes:
    """All bytes of a regular file.

    Raises:
        OSError: see ``open_regular``; or it is longer than ``limit`` bytes.
    """
    with open_regular(path) as file:
        # A file that is larger is not read at all; it may still grow meanwhile.
        large = os.fstat(file.fileno()).st_size > limit
        data = b"" if large else file.read(limit + 1)
    if large or len(data) > limit:
        raise OSError(errno.EFBIG, f"Larger than {limit >> 10} KiB", str(path))
    return data


@contextmanager
def understood(error: LampblackError) -> Iterator[None]:
    """The boundary around a library that reads data from outside: whatever it raises there is
    raised as ``error``, with the library's words as details. Errors for people pass, and so does
    an exhausted memory."""
    try:
        yield
    except (LampblackError, MemoryError):
        raise
    except Exception as fault:
        error.details = error.details or f"{type(fault).__name__}: {fault}"[:400]
        raise error from fault
