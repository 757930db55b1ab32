"""Running a worker: creates its socket, serves, and cleans up."""

from __future__ import annotations

import os
import select
from contextlib import suppress
from pathlib import Path

import zmq

from ..cache import surface_cache
from ..choices import DeviceChoice
from ..errors import LampblackError
from ..pipeline import Pipeline
from ..render import RenderChild
from ..warning_collector import install_warning_collector
from .endpoint import connection_file, private_endpoint
from .jobs import NICENESS
from .server import Server
from .service import Service
from .socket import RouterSocket


def serve_forever(
    connection: Path, parent: int | None = None, device: DeviceChoice = "auto"
) -> None:
    """Serve until interrupted, or until the process ``parent`` ends.

    Socket, file and child processes are removed at the end. ``device`` traces previews and jobs.

    Raises:
        LampblackError: there is no such parent, or the socket or the file cannot be made.
    """
    watched = None if parent is None else _watch(parent)
    install_warning_collector()
    context: zmq.Context[zmq.Socket[bytes]] = zmq.Context()
    try:
        with private_endpoint() as endpoint:
            socket = RouterSocket(context, endpoint)
            try:
                cache = surface_cache()
                previews, finals = RenderChild(device=device), RenderChild(NICENESS, device)
                jobs = Pipeline(cache, renderer=finals)
                service = Service(socket, previews, Pipeline(cache), jobs)
                previews.on_slow = finals.on_slow = service.tell_slow
                with connection_file(connection, endpoint):
                    Server(socket, service).run(lambda: _is_gone(watched), watched)
            finally:
                socket.close()
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
            f"There is no process {pid} to serve.",
            "Give the process number of the drawing program.",
            str(error),
        ) from error


def _is_gone(descriptor: int | None) -> bool:
    return descriptor is not None and bool(select.select([descriptor], [], [], 0)[0])
