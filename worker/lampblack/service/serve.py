"""The life of a worker: from its socket's making to its leaving without a trace."""

from __future__ import annotations

import os
import select
from contextlib import suppress
from pathlib import Path

import zmq

from ..cache import surface_cache
from ..errors import LampblackError
from .endpoint import connection_file, private_endpoint
from .noticed import listen
from .server import Server, bind


def serve_forever(connection: Path, parent: int | None = None) -> None:
    """Serve until interrupted, or until the process ``parent`` is gone.

    Nothing stays behind: no socket, no file, no child.

    Raises:
        LampblackError: there is no such parent, or no place for the socket or the file.
    """
    watched = None if parent is None else _watch(parent)
    listen()
    context: zmq.Context[zmq.Socket[bytes]] = zmq.Context()
    try:
        with private_endpoint() as endpoint:
            router = bind(context, endpoint)
            try:
                server = Server(router, surface_cache())
                with connection_file(connection, endpoint):
                    server.run(lambda: watched is not None and _is_gone(watched), watched)
            finally:
                router.close(0)
    finally:
        context.term()
        if watched is not None:
            with suppress(OSError):
                os.close(watched)


def _watch(pid: int) -> int:
    """A descriptor that becomes readable when the process ends."""
    try:
        return os.pidfd_open(pid)
    except OSError as error:
        raise LampblackError(
            f"There is no process {pid} to serve.", "Name the drawing program's own.", str(error)
        ) from error


def _is_gone(descriptor: int) -> bool:
    return bool(select.select([descriptor], [], [], 0)[0])
