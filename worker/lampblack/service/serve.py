"""Running a worker: creates its socket, serves, and cleans up."""

from __future__ import annotations

import os
import select
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext, suppress
from dataclasses import dataclass
from pathlib import Path

import zmq

from ..cache import surface_cache
from ..choices import DeviceChoice
from ..errors import LampblackError
from ..pipeline import Pipeline
from ..render.client import RenderChild
from ..warning_collector import install_warning_collector
from .endpoint import connection_file, private_endpoint
from .jobs import NICENESS
from .keys import only_admitted, read_keys
from .server import Server
from .service import Service
from .socket import RouterSocket


@dataclass(frozen=True)
class Listening:
    """What a worker listens on for other machines: an address such as ``10.0.0.5:7100``, the file
    of its secret key, and the folder of the public keys of those that it admits."""

    address: str
    key: Path
    admitted: Path


def serve_forever(
    where: Path | Listening,
    previews: RenderChild,
    parent: int | None = None,
    device: DeviceChoice = "auto",
) -> None:
    """Serve until interrupted, or until the process ``parent`` ends.

    Socket, file and child processes are removed at the end.

    Args:
        where: the connection file of a worker for this user on this machine; or what to listen on.
        previews: traces previews, on ``device``; it may have been started.
        parent: ID of a process. device: what traces jobs.

    Raises:
        LampblackError: there is no such parent, or the socket, the file or the keys cannot be used.
    """
    watched = None if parent is None else _watch(parent)
    install_warning_collector()
    context: zmq.Context[zmq.Socket[bytes]] = zmq.Context()
    try:
        with _bound(context, where) as (socket, endpoint):
            try:
                cache = surface_cache()
                finals = RenderChild(NICENESS, device)
                jobs = Pipeline(cache, renderer=finals)
                elsewhere = isinstance(where, Listening)
                service = Service(socket, previews, Pipeline(cache), jobs, for_others=elsewhere)
                previews.on_slow = finals.on_slow = service.tell_slow
                with connection_file(where, endpoint) if isinstance(where, Path) else nullcontext():
                    Server(socket, service).run(lambda: _is_gone(watched), watched)
            finally:
                socket.close()
    finally:
        context.term()
        if watched is not None:
            with suppress(OSError):
                os.close(watched)


@contextmanager
def _bound(
    context: zmq.Context[zmq.Socket[bytes]], where: Path | Listening
) -> Iterator[tuple[RouterSocket, str]]:
    """A socket that the caller closes, and its address."""
    if not isinstance(where, Listening):
        with private_endpoint() as endpoint:
            yield RouterSocket(context, endpoint), endpoint
        return
    keys, endpoint = read_keys(where.key), f"tcp://{where.address}"
    with only_admitted(context, where.admitted):
        try:
            socket = RouterSocket(context, endpoint, keys)
        except zmq.ZMQError as error:
            raise LampblackError(
                f"The worker cannot listen on {where.address}.",
                "Give an address of this machine and a free port: --listen 10.0.0.5:7100",
                str(error),
            ) from error
        yield socket, endpoint


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
