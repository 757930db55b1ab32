"""The connection file: how a client finds its worker."""

from __future__ import annotations

from typing import Annotated

import msgspec
from msgspec import Meta


class Connection(msgspec.Struct, frozen=True, kw_only=True):
    """Written by the worker when it is ready for clients; readable by its user only."""

    lampblack: Annotated[int, Meta(ge=1, le=999, description="major version of the protocol")]
    minor: Annotated[int, Meta(ge=0, le=999, description="minor version of the protocol")]
    endpoint: Annotated[
        str,
        Meta(
            pattern=r"^ipc:///[^\x00-\x1f\x7f]+$(?!\n)",
            max_length=113,
            description="address for zmq_connect; the socket's path has at most 107 bytes",
        ),
    ]
    pid: Annotated[int, Meta(ge=1, le=(1 << 31) - 1, description="process ID of the worker")]
