"""The worker's private socket address, and the connection file."""

from __future__ import annotations

import os
import secrets
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import msgspec

from ..atomic import atomic_file
from ..errors import OutputError
from ..own_folder import NAME_BYTES, own_folder
from ..protocol import MAJOR, MINOR
from ..protocol.connection import Connection

MAX_PATH_BYTES = 107
"""Longest path of a UNIX socket (sun_path, with its final zero)."""


@contextmanager
def private_endpoint() -> Iterator[str]:
    """An ``ipc://`` address in a new directory that only this user can enter. The directory is
    removed when the block ends.

    Raises:
        OutputError: the directory cannot be made.
    """
    folder = _fresh_folder()
    try:
        yield f"ipc://{folder / secrets.token_hex(8)}"
    finally:
        shutil.rmtree(folder, ignore_errors=True)


@contextmanager
def connection_file(path: Path, endpoint: str) -> Iterator[None]:
    """Write the connection file of ``endpoint``, readable by this user only. It appears whole. It
    is removed when the block ends, unless another worker has replaced it.

    Raises:
        OutputError: it cannot be written.
    """
    text = msgspec.json.encode(
        Connection(lampblack=MAJOR, minor=MINOR, endpoint=endpoint, pid=os.getpid())
    )
    before = os.umask(0o077)
    try:
        with atomic_file(path) as file:
            file.write(text)
    finally:
        os.umask(before)
    try:
        yield
    finally:
        with suppress(OSError):
            if path.read_bytes() == text:
                path.unlink()


def read_connection(path: Path) -> Connection:
    """Read a connection file.

    Raises:
        OSError: there is no such file. msgspec.DecodeError: it is malformed.
    """
    return msgspec.json.decode(path.read_bytes(), type=Connection)


def _fresh_folder() -> Path:
    places = [os.environ.get("XDG_RUNTIME_DIR"), tempfile.gettempdir(), "/tmp"]
    trouble = "its path would be too long"
    for place in places:
        # The socket's own name takes 16 bytes, and there are two strokes.
        if not place or len(os.fsencode(place)) + NAME_BYTES + 18 > MAX_PATH_BYTES:
            continue
        try:
            return own_folder(Path(place))
        except OSError as error:
            trouble = str(error)
    raise OutputError(
        "No private directory can be made for the socket.",
        "Set XDG_RUNTIME_DIR to a folder of your own with a short path.",
        trouble,
    )
